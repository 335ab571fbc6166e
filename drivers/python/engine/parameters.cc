#include "drivers/python/engine/parameters.h"

#include "drivers/python/engine/arrays.h"

namespace py = pybind11;

namespace bergamo::python
{

dem::SimulationParameters parameters_of(const py::handle &object)
{
  dem::SimulationParameters p;
  const auto materials = rows_of<dem::Material>(py::cast<Doubles>(object.attr("_materials")), "table of materials");
  require(materials.size() >= 1, "number of materials", static_cast<double>(materials.size()), "at least 1");
  p.materials = dem::MaterialTable(materials);
  const auto pairs = rows_of<dem::SurfacePair>(py::cast<Doubles>(object.attr("_pairs")), "table of laws");
  require(pairs.size() == p.materials.surface_pairs().size(), "number of laws", static_cast<double>(pairs.size()),
          "one for each pair of materials");
  p.materials.surface_pairs() = pairs;
  p.gravity = vector_of(object.attr("gravity"), "gravity");
  p.time_step = py::cast<double>(object.attr("time_step"));
  p.verlet_distance = py::cast<double>(object.attr("verlet_distance"));
  p.sort_interval = py::cast<int>(object.attr("sort_interval"));
  p.contact.overlap_tolerance = py::cast<double>(object.attr("overlap_tolerance"));
  p.contact.curvature_bound = py::cast<double>(object.attr("curvature_bound"));
  p.validate();
  return p;
}

dem::PlaneWall wall_of(const py::handle &plane)
{
  dem::PlaneWall wall;
  wall.point = vector_of(plane.attr("point"), "point of a plane");
  wall.normal = vector_of(plane.attr("normal"), "normal of a plane");
  wall.velocity = vector_of(plane.attr("velocity"), "velocity of a plane");
  wall.material = py::cast<std::int32_t>(plane.attr("material"));
  return wall;
}

py::dict dict_of(const dem::SimulationParameters &p)
{
  std::vector<dem::Material> materials;
  for (std::int32_t m = 0; m < p.materials.size(); ++m)
    materials.push_back(p.materials[m]);
  using namespace py::literals;
  return py::dict("materials"_a = array_of(materials), "pairs"_a = array_of(p.materials.surface_pairs()),
                  "gravity"_a = array_of(p.gravity), "time_step"_a = p.time_step,
                  "verlet_distance"_a = p.verlet_distance, "sort_interval"_a = p.sort_interval,
                  "overlap_tolerance"_a = p.contact.overlap_tolerance, "curvature_bound"_a = p.contact.curvature_bound);
}

} // namespace bergamo::python
