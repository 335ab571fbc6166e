#include "drivers/python/engine/arrays.h"
#include "drivers/python/engine/bindings.h"

#include "dem/core/error.h"
#include "dem/geometry/rigid_clump.h"
#include "dem/state/particles.h"

#include <array>
#include <span>

namespace py = pybind11;

namespace bergamo::python
{
namespace
{

/// Poses as Python has them: place, quaternion (x, y, z, w).
struct Pose
{
  double place[3], quaternion[4];

  Vec3 position() const { return Vec3(place[0], place[1], place[2]); }
  Quaternion orientation() const { return {quaternion[3], quaternion[0], quaternion[1], quaternion[2]}; }
};

/// Half-axes and exponents as Python has them.
struct Shape
{
  double half_axes[3], exponents[2];

  dem::Superquadric superquadric() const
  {
    return {Vec3(half_axes[0], half_axes[1], half_axes[2]), exponents[0], exponents[1]};
  }
};

/// Grains that a builder has, one after the other.
void append(dem::Particles &grains, const dem::Particles &others)
{
  for (std::size_t i = 0; i < others.size(); ++i)
    grains.append(others, i, static_cast<std::int64_t>(grains.size()));
}

/// A row each: poses (n, 7), shapes (n, 5), density and material (n, 2). All or none.
void add(dem::Particles &grains, const Doubles &poses, const Doubles &shapes, const Doubles &matter)
{
  const auto pose = rows_of<Pose>(poses, "poses");
  const auto shape = rows_of<Shape>(shapes, "shapes");
  const auto of_matter = rows_of<std::array<double, 2>>(matter, "density and material");
  dem::Particles added;
  for (std::size_t i = 0; i < pose.size(); ++i)
    added.add(shape.at(i).superquadric(), of_matter.at(i)[0], pose[i].position(), pose[i].orientation(),
              static_cast<std::int32_t>(of_matter[i][1]));
  append(grains, added);
}

void add_clumps(dem::Particles &grains, const dem::Clump &clump, const Doubles &poses, const Doubles &matter)
{
  const auto pose = rows_of<Pose>(poses, "poses");
  const auto of_matter = rows_of<std::array<double, 2>>(matter, "density and material");
  dem::Particles added;
  for (std::size_t i = 0; i < pose.size(); ++i)
    added.add(clump, of_matter.at(i)[0], pose[i].position(), pose[i].orientation(),
              static_cast<std::int32_t>(of_matter[i][1]));
  append(grains, added);
}

void fix(dem::Particles &grains, const Integers &rows)
{
  const std::span<const std::int64_t> wanted(rows.data(), rows.size());
  const auto n = static_cast<std::int64_t>(grains.size());
  for (const std::int64_t row : wanted)
    require(row >= 0 && row < n, "row of a grain to be fixed", static_cast<double>(row),
            "below the number of grains, " + std::to_string(n) + ", counted from 0");
  for (const std::int64_t row : wanted)
    grains.fix(row);
}

py::object copy_of(const dem::Particles &grains, const std::string &name)
{
  py::object found;
  dem::Particles::visit_fields(grains,
                               [&](const std::string &field, const auto &values)
                               {
                                 if (field == name)
                                   found = array_of(values);
                               });
  if (!found)
    throw ConfigError("grains have no array '" + name + "'");
  return found;
}

/// Velocities and angular momenta, a row a grain.
void set_motion(dem::Particles &grains, const Doubles &velocity, const Doubles &angular_momentum)
{
  grains.velocity = rows_of<Vec3>(velocity, "velocity");
  grains.angular_momentum = rows_of<Vec3>(angular_momentum, "angular_momentum");
}

dem::Clump clump_of(const Doubles &poses, const Doubles &shapes, const double tolerance)
{
  const auto pose = rows_of<Pose>(poses, "poses of a clump's parts");
  const auto shape = rows_of<Shape>(shapes, "shapes of a clump's parts");
  dem::ClumpShape body;
  for (std::size_t k = 0; k < pose.size(); ++k)
    body.parts.push_back({shape.at(k).superquadric(), pose[k].position(), pose[k].orientation()});
  return dem::Clump(body, tolerance);
}

} // namespace

void bind_grains(py::module_ &module)
{
  py::class_<dem::Clump>(module, "Clump")
      .def(py::init(&clump_of))
      .def_property_readonly("volume", &dem::Clump::volume)
      .def_property_readonly("bounding_radius", &dem::Clump::bounding_radius)
      .def_property_readonly("inertia_per_density",
                             [](const dem::Clump &clump) { return array_of(clump.inertia_per_density()); })
      .def("scaled", &dem::Clump::scaled);

  py::class_<dem::Particles>(module, "Particles")
      .def(py::init<>())
      .def("__len__", &dem::Particles::size)
      .def("add", &add)
      .def("add_clumps", &add_clumps)
      .def("append", &append)
      .def("fix", &fix)
      .def("copy_of", &copy_of)
      .def("set_motion", &set_motion)
      .def_property(
          "cell",
          [](const dem::Particles &grains) -> py::object
          { return grains.cell.is_periodic() ? py::object(array_of(grains.cell.edges)) : py::none(); },
          [](dem::Particles &grains, const py::object &edges)
          {
            const dem::PeriodicCell cell =
                edges.is_none() ? dem::PeriodicCell() : dem::PeriodicCell(vector_of(edges, "periodic cell"));
            cell.validate();
            grains.cell = cell;
          });
}

} // namespace bergamo::python
