#include "drivers/python/engine/arrays.h"
#include "drivers/python/engine/bindings.h"
#include "drivers/python/engine/model.h"
#include "drivers/python/engine/parameters.h"

namespace py = pybind11;

namespace bergamo::python
{
namespace
{

void add_plane(Model &model, const py::handle &plane)
{
  const Work work(model);
  model.simulation().add_wall(wall_of(plane));
}

template <class Bodies>
auto &body_of(Bodies &bodies, const std::int64_t number, const std::string &what)
{
  const auto n = static_cast<std::int64_t>(bodies.size());
  require(number >= 0 && number < n, "number of the " + what, static_cast<double>(number),
          "that of one of the " + std::to_string(n) + ' ' + what + "s, counted from 0");
  return bodies[number];
}

py::dict plane_of(Model &model, const std::int64_t number)
{
  model.require_free();
  const dem::PlaneWall &wall = body_of(model.simulation().walls, number, "plane");
  using namespace py::literals;
  return py::dict("point"_a = array_of(wall.point), "normal"_a = array_of(wall.normal),
                  "velocity"_a = array_of(wall.velocity), "material"_a = wall.material);
}

/// Force [N] and work [J] at the present step.
py::tuple load_of_plane(Model &model, const std::int64_t number)
{
  const Work work(model);
  model.simulation().compute_forces();
  const dem::PlaneWall &wall = body_of(model.simulation().walls, number, "plane");
  return py::make_tuple(array_of(wall.force), wall.work);
}

void set_plane_velocity(Model &model, const std::int64_t number, const py::handle &velocity)
{
  const Work work(model);
  const Vec3 v = vector_of(velocity, "velocity of a plane");
  require(v.allFinite(), "velocity of a plane", v.sum(), "finite [m/s]");
  body_of(model.simulation().walls, number, "plane").velocity = v;
}

/// @param velocity by node [m/s]; (0, 3): at rest
void set_surface_velocity(Model &model, const std::int64_t number, const Doubles &velocity)
{
  const Work work(model);
  dem::Surface &surface = body_of(model.simulation().surfaces, number, "surface");
  std::vector<Vec3> rows = rows_of<Vec3>(velocity, "velocity of a surface");
  require(rows.empty() || rows.size() == surface.node.size(), "number of velocities of a surface",
          static_cast<double>(rows.size()), "that of its nodes, " + std::to_string(surface.node.size()));
  for (const Vec3 &v : rows)
    require(v.allFinite(), "velocity of a surface's node", v.sum(), "finite [m/s]");
  surface.velocity = std::move(rows);
}

} // namespace

void bind_bodies(py::object &object)
{
  py::class_<Model, std::shared_ptr<Model>> model = object;
  model.def("add_plane", &add_plane)
      .def("plane", &plane_of)
      .def("load_of_plane", &load_of_plane)
      .def("set_plane_velocity", &set_plane_velocity)
      .def("remove_plane",
           [](Model &model, const std::int32_t number)
           {
             const Work work(model);
             model.simulation().remove_wall(number);
           })
      .def("add_surface",
           [](Model &model, const dem::Surface &surface)
           {
             const Work work(model);
             model.simulation().add_surface(surface);
           })
      .def("remove_surface",
           [](Model &model, const std::int32_t number)
           {
             const Work work(model);
             model.simulation().remove_surface(number);
           })
      .def("surface",
           [](Model &model, const std::int64_t number) -> dem::Surface
           {
             model.require_free();
             return body_of(model.simulation().surfaces, number, "surface");
           })
      .def("set_surface_velocity", &set_surface_velocity)
      .def_property_readonly("n_planes", [](Model &model) { return model.simulation().walls.size(); })
      .def_property_readonly("n_surfaces", [](Model &model) { return model.simulation().surfaces.size(); });
}

} // namespace bergamo::python
