#include "drivers/two_scale_triaxial/packing_stage.h"

#include "coupling/adapter/stress_profile.h"
#include "dem/measure/coordination.h"
#include "dem/measure/solid_fraction.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/state/positions_by_id.h"
#include "drivers/common/run/visit_models.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{
namespace
{

/// Takes out the grains whose centre lies below the overlap, and the floor.
void remove_below(dem::Simulation &grains, const Interface &interface)
{
  std::vector<std::int32_t> below;
  for (std::size_t i = 0; i < grains.particles.size(); ++i)
    if (const Vec3 &centre = grains.particles.position[i]; centre[2] < interface.bottom(centre[0]))
      below.push_back(static_cast<std::int32_t>(i));
  grains.remove_wall(4);
  grains.remove(below);
  grains.integrate(); // one step: the forces to come are those without them
}

std::vector<Vec3> stress_by_layer(const dem::Simulation &grains, const dem::Box &box, const unsigned int n_layers)
{
  std::vector<Vec3> stress;
  double sum = 0.;
  for (const coupling::SlabStress &slab : coupling::stress_profile(grains, box, n_layers))
  {
    stress.push_back(slab.grains);
    sum += slab.grains[2];
  }
  for (Vec3 &layer : stress)
    layer[2] = sum / n_layers;
  return stress;
}

} // namespace

PackingStage begin_packing(const TriaxialParameters &parameters)
{
  std::mt19937_64 generator(parameters.seed);
  const Vec3 edges = Vec3::Constant(parameters.edge);
  const std::vector<dem::Superquadric> shapes =
      dem::draw_grains(parameters.distribution, parameters.expected_solid_fraction * edges.prod(), generator);

  const double widening = std::cbrt(parameters.expected_solid_fraction / parameters.initial_solid_fraction);
  const dem::Box box{Vec3::Zero(), std::max(widening, 1.) * edges};
  dem::Particles particles = dem::add_at_random(shapes, box, parameters.simulation.grain().density, generator());
  return {std::make_unique<dem::Simulation>(parameters.packing_simulation(), std::move(particles), dem::box_walls(box)),
          dem::Compression(parameters.compression)};
}

void visit_packing(StateVisitor &visit, std::optional<PackingStage> &packing, const TriaxialParameters &parameters)
{
  auto grains = visit_grains(visit, packing ? packing->grains.get() : nullptr, parameters.packing_simulation());
  if (visit.is_reading())
    packing.emplace(PackingStage{std::move(grains), dem::Compression(parameters.compression)});
  visit("compression", packing->compression);
}

Stage stage_of(PackingStage &packing, const double aim)
{
  dem::Simulation &grains = *packing.grains;
  const double solid = dem::solid_volume(grains.particles);
  Stage stage;
  stage.name = "packing";
  stage.n_particles = static_cast<std::int64_t>(grains.particles.size());
  stage.time = [&grains] { return grains.time; };
  stage.is_last = [&packing] { return packing.compression.is_finished(); };
  stage.compute = [&packing] { packing.compression.step(*packing.grains); };
  stage.fraction = [&grains, solid, aim] // tells how far the compression is until the pressure rises
  { return std::min(0.99, solid / dem::box_between(grains.walls).volume() / aim); };
  return stage;
}

LoadingStart end_packing(dem::Simulation &grains, const TriaxialParameters &parameters)
{
  LoadingStart start;
  start.box = dem::box_between(grains.walls);
  start.solid_fraction = dem::solid_fraction(grains.particles, start.box.volume());
  start.coordination_number = dem::mean_coordination(grains.contacts, grains.particles.size());
  start.stress_by_layer = stress_by_layer(grains, start.box, parameters.layers.per_edge);
  for (dem::PlaneWall &wall : grains.walls)
    wall.velocity.setZero();
  grains.rest();
  grains.change(parameters.simulation);
  start.reference_by_id = dem::positions_by_id(grains.particles);
  if (parameters.kind == ModelKind::two_scale)
    remove_below(grains, parameters.interface(start.box));
  return start;
}

} // namespace bergamo::driver
