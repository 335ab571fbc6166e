#include "drivers/python/engine/arrays.h"
#include "drivers/python/engine/bindings.h"

#include "dem/io/surface_file.h"
#include "dem/state/surface.h"

#include <array>
#include <map>

namespace py = pybind11;

namespace bergamo::python
{
namespace
{

dem::Surface surface_of(const Doubles &nodes, const Integers &triangles)
{
  require_rows(triangles, 3, "triangles");
  std::vector<dem::Triangle> corners(triangles.shape(0));
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (int k = 0; k < 3; ++k)
      corners[t][k] = static_cast<std::int32_t>(triangles.at(t, k));
  return {rows_of<Vec3>(nodes, "nodes"), std::move(corners)};
}

py::array_t<std::int64_t> triangles_of(const dem::Surface &surface)
{
  const std::vector<dem::Triangle> &triangles = surface.topology.triangle;
  py::array_t<std::int64_t> numbers({static_cast<py::ssize_t>(triangles.size()), py::ssize_t(3)});
  auto entry = numbers.mutable_unchecked<2>();
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      entry(t, k) = triangles[t][k];
  return numbers;
}

dem::Surface read(const std::string &path, const std::string &use, const py::dict &how)
{
  static const std::map<std::string, dem::SurfaceUse> uses{
      {"sheet", dem::SurfaceUse::sheet}, {"body", dem::SurfaceUse::body}, {"vessel", dem::SurfaceUse::vessel}};
  if (!uses.contains(use))
    throw ConfigError("the use of a surface is '" + use + "': it must be 'sheet', 'body' or 'vessel'");
  dem::SurfaceFileParameters parameters;
  parameters.use = uses.at(use);
  parameters.unit = py::cast<double>(how["unit"]);
  parameters.flip = py::cast<bool>(how["flip"]);
  parameters.merge_tolerance = py::cast<double>(how["merge_tolerance"]);
  return dem::read_surface(path, parameters);
}

} // namespace

void bind_surfaces(py::module_ &module)
{
  py::class_<dem::Surface>(module, "Surface")
      .def(py::init(&surface_of))
      .def_property_readonly("nodes", [](const dem::Surface &surface) { return array_of(surface.node); })
      .def_property_readonly("triangles", &triangles_of)
      .def_property_readonly("motion", [](const dem::Surface &surface) { return surface.motion; })
      .def_property_readonly("work", [](const dem::Surface &surface) { return surface.work; })
      .def_property_readonly("velocity", [](const dem::Surface &surface) { return array_of(surface.velocity); })
      .def_readwrite("offset", &dem::Surface::offset)
      .def_readwrite("material", &dem::Surface::material)
      .def_readwrite("is_rigid", &dem::Surface::is_rigid);
  module.def("read_surface", &read);
}

} // namespace bergamo::python
