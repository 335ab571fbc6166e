#include "drivers/two_scale_triaxial/continuum_body.h"

#include "drivers/common/bearable_stress.h"
#include "fe_dealii/mesh/pit_mesh.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bergamo::driver
{
namespace
{

/// Each layer with its own stress; with none given, all under the packing's pressure.
fe::InitialStress initial_stress(const TriaxialParameters &parameters, const LoadingStart &start)
{
  if (start.stress_by_layer.empty())
    return fe::uniform_pressure(parameters.compression.pressure);
  std::vector<Vec3> layers;
  for (const Vec3 &stress : start.stress_by_layer)
    layers.push_back(bearable(parameters.continuum.material(), stress));
  return [layers, low = start.box.low[2],
          height = start.box.edges()[2] / static_cast<double>(start.stress_by_layer.size())](const auto &place)
  {
    const auto layer = static_cast<std::ptrdiff_t>(std::floor((place[2] - low) / height));
    const Vec3 &stress = layers[std::clamp<std::ptrdiff_t>(layer, 0, std::ssize(layers) - 1)];
    return fe::Stress{stress[0], stress[1], stress[2], 0., 0., 0.};
  };
}

/// The bricks of some layers. @param low height of the lowest one [m]
fe::PitMeshParameters bricks(const ElementLayers &layers, const dem::Box &specimen, const double low,
                             const unsigned int n_layers)
{
  fe::PitMeshParameters bricks;
  const Vec3 edges = specimen.edges();
  for (int axis = 0; axis < 2; ++axis)
    for (unsigned int k = 0; k <= layers.per_edge; ++k)
      bricks.planes[axis].push_back(specimen.low[axis] + edges[axis] * k / layers.per_edge);
  for (unsigned int k = 0; k <= n_layers; ++k)
    bricks.planes[2].push_back(low + edges[2] * k / layers.high());
  return bricks;
}

/// Bricks up to a flat face, less those above a step, stretched to the face.
void make_mesh(const ElementLayers &layers, const dem::Box &cube, const Interface &interface,
               dealii::Triangulation<3> &mesh)
{
  fe::PitMeshParameters flat = bricks(layers, cube, cube.low[2], layers.continuum);
  if (interface.step() < cube.high[0])
  {
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    flat.hole_minimum = {interface.step(), -everywhere, interface.top(cube.high[0])};
    flat.hole_maximum = {everywhere, everywhere, everywhere};
  }
  fe::make_pit(flat, mesh);
  dealii::GridTools::transform(
      [&](const dealii::Point<3> &x)
      { return dealii::Point<3>(x[0], x[1], cube.low[2] + interface.stretch(x[0]) * (x[2] - cube.low[2])); },
      mesh);
}

void make_mesh(const ElementLayers &layers, const dem::Box &cell, const Interlayer &interlayer,
               dealii::Triangulation<3> &mesh)
{
  fe::make_pit(bricks(layers, cell, interlayer.bottom(), layers.continuum), mesh);
}

} // namespace

std::unique_ptr<fe::ExplicitBody> make_continuum(const TriaxialParameters &parameters, const LoadingStart &start)
{
  if (!parameters.has_continuum())
    return nullptr;
  dealii::Triangulation<3> mesh;
  if (parameters.kind == ModelKind::continuum)
    fe::make_pit(bricks(parameters.layers, start.box, start.box.low[2], parameters.layers.high()), mesh);
  else
    std::visit([&](const auto &layout) { make_mesh(parameters.layers, start.box, layout, mesh); },
               parameters.layout(start.box));
  fe::ExplicitBodyParameters body;
  body.material = parameters.continuum.material();
  body.kind.hourglass = parameters.bending_elements ? fe::Hourglass::bending : fe::Hourglass::at_points;
  body.kind.kinematics = parameters.large_strain ? fe::Kinematics::large_strain : fe::Kinematics::small_strain;
  body.damping = parameters.continuum_damping;
  body.initial_stress = initial_stress(parameters, start);
  return std::make_unique<fe::ExplicitBody>(mesh, body);
}

} // namespace bergamo::driver
