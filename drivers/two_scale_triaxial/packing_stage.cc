#include "drivers/two_scale_triaxial/packing_stage.h"

#include "coupling/adapter/stress_profile.h"
#include "dem/measure/coordination.h"
#include "dem/measure/solid_fraction.h"
#include "dem/neighbour/sphere_rows.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/state/positions_by_id.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/packing_target.h"
#include "drivers/common/run/snapshot.h"
#include "drivers/common/run/visit_models.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{
namespace
{

/// Takes out the grains where the continuum will be alone, and the floor.
void remove_from(dem::Simulation &grains, const Layout &layout)
{
  std::vector<std::int32_t> leaving;
  for (std::size_t i = 0; i < grains.particles.size(); ++i)
    if (!has_grain(layout, grains.particles.position[i]))
      leaving.push_back(static_cast<std::int32_t>(i));
  if (!grains.walls.empty())
    grains.remove_wall(4);
  grains.remove(leaving);
  grains.integrate(); // one step: the forces to come are those without them
}

dem::Box box_of(const dem::Simulation &grains)
{
  return grains.walls.empty() ? dem::Box{Vec3::Zero(), grains.particles.cell.edges} : dem::box_between(grains.walls);
}

void stop(dem::PeriodicCell &cell)
{
  for (Vec3 *const motion : {&cell.rate, &cell.drift_rate, &cell.acceleration})
    motion->setZero();
  cell.update_images();
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

dem::CellLoading isotropic(const TriaxialParameters &parameters, const dem::Simulation &grains)
{
  const dem::CompressionParameters &c = parameters.compression;
  const dem::MeanGrain grain = dem::mean_grain(grains.particles);
  dem::LoadingStage stage;
  stage.inertial_number = dem::inertial_number(grain, c.largest_rate, c.pressure);
  stage.friction = parameters.packing_friction;
  stage.pressure = c.pressure;
  stage.time_step = parameters.packing_time_step;
  stage.overlap_tolerance = parameters.packing_overlap_tolerance;
  stage.stress_tolerance = c.pressure_tolerance;
  stage.force_tolerance = c.force_tolerance;
  stage.longest_time = c.longest_time;
  return {stage, grain, parameters.simulation.grain().density};
}

PackingStage pack_between_walls(const TriaxialParameters &parameters)
{
  std::mt19937_64 generator(parameters.seed);
  const Vec3 edges = parameters.edges();
  const std::vector<dem::Superquadric> shapes =
      dem::draw_grains(parameters.distribution, parameters.expected_solid_fraction * edges.prod(), generator);

  const double widening = std::cbrt(parameters.expected_solid_fraction / parameters.initial_solid_fraction);
  const dem::Box box{Vec3::Zero(), std::max(widening, 1.) * edges};
  dem::Particles particles = dem::add_at_random(shapes, box, parameters.simulation.grain().density, generator());
  return {std::make_unique<dem::Simulation>(parameters.packing_simulation(), std::move(particles), dem::box_walls(box)),
          dem::Compression(parameters.compression),
          {}};
}

PackingStage pack_in_cell(const TriaxialParameters &parameters)
{
  dem::PackingParameters packing;
  packing.solid_fraction = parameters.tightened_solid_fraction;
  packing.density = parameters.simulation.grain().density;
  packing.tightening.is_stopped = interrupted;
  const Vec3 edges = std::cbrt(parameters.expected_solid_fraction / packing.solid_fraction) * parameters.edges();
  dem::PackedGrains packed =
      parameters.grading().pack(dem::PackingSpace::periodic({Vec3::Zero(), edges}), packing, parameters.seed);
  require_target(packed, packing.solid_fraction, "Packing/tightened solid fraction");
  packed.particles.cell = dem::PeriodicCell(edges);
  auto grains = std::make_unique<dem::Simulation>(parameters.packing_simulation(), std::move(packed.particles),
                                                  std::vector<dem::PlaneWall>{});
  dem::CellLoading loading = isotropic(parameters, *grains);
  loading.begin(*grains);
  return {std::move(grains), dem::Compression(parameters.compression), std::move(loading)};
}

Snapshot sample_in(const std::filesystem::path &file, const TriaxialParameters &parameters)
{
  return Snapshot(file, "packing for a triaxial test", parameters.sample_text(),
                  "give those of the sample, or leave Packing/sample out");
}

} // namespace

void PackingStage::step()
{
  if (!cell)
    return compression.step(*grains);
  cell->prepare(*grains);
  grains->integrate();
}

PackingStage begin_packing(const TriaxialParameters &parameters)
{
  return parameters.is_periodic() ? pack_in_cell(parameters) : pack_between_walls(parameters);
}

void write_sample(const std::filesystem::path &file, const dem::Simulation &grains,
                  const TriaxialParameters &parameters)
{
  sample_in(file, parameters)
      .write([&](StateVisitor &visit) { visit_grains(visit, &grains, parameters.packing_simulation()); });
}

PackingStage read_sample(const TriaxialParameters &parameters)
{
  PackingStage sample{nullptr, dem::Compression(parameters.compression), {}};
  sample_in(parameters.sample, parameters)
      .read([&](StateVisitor &visit)
            { sample.grains = visit_grains(visit, nullptr, parameters.packing_simulation()); });
  return sample;
}

void visit_packing(StateVisitor &visit, std::optional<PackingStage> &packing, const TriaxialParameters &parameters)
{
  auto grains = visit_grains(visit, packing ? packing->grains.get() : nullptr, parameters.packing_simulation());
  if (visit.is_reading())
    packing.emplace(PackingStage{std::move(grains), dem::Compression(parameters.compression), {}});
  visit("compression", packing->compression);
  if (!parameters.is_periodic())
    return;
  dem::CellLoading::State state = packing->cell ? packing->cell->state() : dem::CellLoading::State();
  visit("cell_loading", state);
  if (!visit.is_reading())
    return;
  packing->cell.emplace(isotropic(parameters, *packing->grains));
  packing->cell->resume(state);
}

Stage stage_of(PackingStage &packing, const double aim)
{
  dem::Simulation &grains = *packing.grains;
  const double solid = dem::solid_volume(grains.particles);
  Stage stage;
  stage.name = "packing";
  stage.n_particles = static_cast<std::int64_t>(grains.particles.size());
  stage.time = [&grains] { return grains.time; };
  stage.is_last = [&packing] { return packing.is_finished(); };
  stage.compute = [&packing] { packing.step(); };
  stage.fraction = [&grains, solid, aim] // tells how far the compression is until the pressure rises
  { return std::min(0.99, solid / box_of(grains).volume() / aim); };
  return stage;
}

LoadingStart end_packing(dem::Simulation &grains, const TriaxialParameters &parameters)
{
  grains.compute_forces(); // of a step that is done by whoever reads a sample, too
  LoadingStart start;
  start.box = box_of(grains);
  start.solid_fraction = dem::solid_fraction(grains.particles, start.box.volume());
  start.coordination_number = dem::mean_coordination(grains.contacts, grains.particles.size());
  start.stress_by_layer = stress_by_layer(grains, start.box, parameters.layers.high());
  for (dem::PlaneWall &wall : grains.walls)
    wall.velocity.setZero();
  stop(grains.particles.cell);
  grains.rest();
  grains.change(parameters.simulation);
  start.reference_by_id = dem::positions_by_id(grains.particles);
  if (parameters.is_periodic())
    for (Vec3 &place : start.reference_by_id)
      place = dem::place_in(grains.particles.cell, place);
  if (parameters.kind == ModelKind::two_scale)
    remove_from(grains, parameters.layout(start.box));
  return start;
}

} // namespace bergamo::driver
