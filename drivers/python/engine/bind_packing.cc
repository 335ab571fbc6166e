#include "drivers/python/engine/arrays.h"
#include "drivers/python/engine/bindings.h"

#include "dem/packing/pack_grains.h"
#include "drivers/python/engine/team.h"

#include <pybind11/stl.h>

#include <array>
#include <limits>

namespace py = pybind11;

namespace bergamo::python
{
namespace
{

dem::GrainShapes shapes_of(const py::handle &grading)
{
  return {py::cast<double>(grading.attr("elongation")), py::cast<double>(grading.attr("angularity"))};
}

/// From one of the gradings of bergamo.engine.packing.
dem::Grading grading_of(const py::handle &grading)
{
  const auto kind = py::cast<std::string>(grading.attr("kind"));
  const auto number = [&](const char *name) { return py::cast<double>(grading.attr(name)); };
  if (kind == "gaussian")
    return dem::GrainDistribution{vector_of(grading.attr("mean_half_axes"), "mean half-axes"),
                                  number("relative_deviation"),
                                  number("smallest_half_axis"),
                                  number("largest_half_axis"),
                                  number("smallest_exponent"),
                                  number("largest_exponent")};
  if (kind == "uniform")
    return dem::UniformSizes{number("smallest_diameter"), number("largest_diameter"), shapes_of(grading)};
  dem::SieveCurve curve;
  for (const auto &[size, passing] : py::cast<std::vector<std::pair<double, double>>>(grading.attr("points")))
    curve.points.push_back({size, passing});
  curve.shapes = shapes_of(grading);
  return curve;
}

/// From (kind, ...): box (low, high), periodic (low, high, repeats), cylinder (base, radius, height), polyhedron
/// (normals, offsets).
dem::PackingSpace space_of(const py::tuple &space)
{
  const auto kind = py::cast<std::string>(space[0]);
  if (kind == "cylinder")
    return dem::PackingSpace::cylinder(vector_of(space[1], "base of a cylinder"), py::cast<double>(space[2]),
                                       py::cast<double>(space[3]));
  if (kind == "polyhedron")
  {
    const auto normals = rows_of<Vec3>(py::cast<Doubles>(space[1]), "normals of a polyhedron");
    const auto offsets = py::cast<std::vector<double>>(space[2]);
    require(offsets.size() == normals.size(), "number of offsets of a polyhedron", static_cast<double>(offsets.size()),
            "that of its normals, " + std::to_string(normals.size()));
    std::vector<dem::HalfSpace> planes;
    for (std::size_t k = 0; k < normals.size(); ++k)
      planes.push_back({normals[k], offsets[k]});
    return dem::PackingSpace::polyhedron(std::move(planes));
  }
  const dem::Box box{vector_of(space[1], "lower corner of a box"), vector_of(space[2], "upper corner of a box")};
  return kind == "periodic" ? dem::PackingSpace::periodic(box, py::cast<std::array<bool, 3>>(space[3]))
                            : dem::PackingSpace(box);
}

/// The cell of grains that were packed in a periodic box.
dem::PeriodicCell cell_of(const dem::PackingSpace &room)
{
  Vec3 edges = room.bounds().edges();
  for (int d = 0; d < 3; ++d)
    if (!room.is_periodic(d))
      edges[d] = std::numeric_limits<double>::infinity();
  return dem::PeriodicCell(edges);
}

/// Ends a tightening where a signal has come, whose exception stays set.
class Interruption
{
public:
  bool has_come()
  {
    const py::gil_scoped_acquire lock;
    return is_set_ = is_set_ || PyErr_CheckSignals() != 0;
  }
  void raise() const
  {
    if (is_set_)
      throw py::error_already_set();
  }

private:
  bool is_set_ = false;
};

py::dict report_of(const dem::PackingReport &report)
{
  using namespace py::literals;
  return py::dict("solid_fraction"_a = report.solid_fraction, "has_reached_target"_a = report.has_reached_target,
                  "size_factor"_a = report.size_factor, "smallest_size"_a = report.smallest_size,
                  "iterations"_a = report.tightening.size());
}

/// @param options of bergamo.engine.packing.pack(); its clump may be none
py::tuple pack(const py::handle &grading, const py::tuple &space, const py::object &options, const std::uint64_t seed)
{
  const dem::Grading sizes = grading_of(grading);
  const dem::PackingSpace room = space_of(space);
  dem::PackingParameters parameters;
  parameters.solid_fraction = py::cast<double>(options["solid_fraction"]);
  parameters.start_solid_fraction = py::cast<double>(options["start_solid_fraction"]);
  parameters.density = py::cast<double>(options["density"]);
  parameters.tightening.max_iterations = py::cast<int>(options["max_iterations"]);
  Interruption interruption;
  parameters.tightening.is_stopped = [&] { return interruption.has_come(); };
  const py::object clump = options["clump"];
  const auto *unit = clump.is_none() ? nullptr : py::cast<const dem::Clump *>(clump);
  take_team();
  dem::PackedGrains packed;
  {
    const py::gil_scoped_release unlocked;
    packed = unit ? dem::pack_clumps({*unit, sizes}, room, parameters, seed)
                  : dem::pack_grains(sizes, room, parameters, seed);
  }
  interruption.raise();
  if (room.is_periodic())
    packed.particles.cell = cell_of(room);
  return py::make_tuple(std::move(packed.particles), report_of(packed.report));
}

} // namespace

void bind_packing(py::module_ &module)
{
  module.def("pack", &pack);
}

} // namespace bergamo::python
