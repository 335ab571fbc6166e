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

/// Bricks up to a flat face, less those above a step, stretched to the face.
void make_mesh(const TriaxialParameters &parameters, const dem::Box &cube, dealii::Triangulation<3> &mesh)
{
  const bool is_joined = parameters.kind == ModelKind::two_scale;
  const unsigned int n = parameters.layers.per_edge, n_layers = is_joined ? parameters.layers.continuum : n;
  fe::PitMeshParameters bricks;
  for (int axis = 0; axis < 3; ++axis)
    for (unsigned int k = 0; k <= (axis == 2 ? n_layers : n); ++k)
      bricks.planes[axis].push_back(cube.low[axis] + cube.edges()[axis] * k / n);
  const Interface interface = parameters.interface(cube);
  if (is_joined && interface.step() < cube.high[0])
  {
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    bricks.hole_minimum = {interface.step(), -everywhere, interface.top(cube.high[0])};
    bricks.hole_maximum = {everywhere, everywhere, everywhere};
  }
  fe::make_pit(bricks, mesh);
  if (is_joined && parameters.interface_shape != InterfaceShape::flat)
    dealii::GridTools::transform(
        [&](const dealii::Point<3> &x)
        { return dealii::Point<3>(x[0], x[1], cube.low[2] + interface.stretch(x[0]) * (x[2] - cube.low[2])); },
        mesh);
}

} // namespace

std::unique_ptr<fe::ExplicitBody> make_continuum(const TriaxialParameters &parameters, const LoadingStart &start)
{
  if (!parameters.has_continuum())
    return nullptr;
  dealii::Triangulation<3> mesh;
  make_mesh(parameters, start.box, mesh);
  fe::ExplicitBodyParameters body;
  body.material = parameters.continuum.material();
  body.kind.hourglass = parameters.bending_elements ? fe::Hourglass::bending : fe::Hourglass::at_points;
  body.kind.kinematics = parameters.large_strain ? fe::Kinematics::large_strain : fe::Kinematics::small_strain;
  body.damping = parameters.continuum_damping;
  body.initial_stress = initial_stress(parameters, start);
  return std::make_unique<fe::ExplicitBody>(mesh, body);
}

} // namespace bergamo::driver
