#include "benchmarks/peers/bergamo_contestant.h"

#include "benchmarks/step_timing.h"
#include "dem/flow/outlet.h"
#include "dem/motion/surface_path.h"
#include "dem/simulation/simulation.h"

#include <chrono>
#include <cmath>
#include <optional>

namespace bergamo::benchmark
{
namespace
{

constexpr int steps_between_outlets = 500;

/// A case on its way.
class Steps
{
public:
  Steps(const BulkCase &bulk, const double distance) : grains(with(bulk.parameters, distance), bulk.beads, {})
  {
    grains.add_surface(bulk.vessel);
    if (bulk.vessel_spin != 0.)
      turning.emplace(grains.surfaces[0], Vec3::Zero(),
                      [spin = bulk.vessel_spin](const double time) {
                        return dem::SurfacePlacement{Vec3::Zero(), Vec3(0., spin * time, 0.)};
                      });
    if (std::isfinite(bulk.outlet))
      outlet.emplace(dem::OutletParameters{.region = dem::HalfSpace{Vec3::UnitZ(), bulk.outlet},
                                           .step_interval = steps_between_outlets});
  }

  void step()
  {
    if (outlet)
      outlet->act(grains);
    grains.step();
    if (turning)
      turning->move(grains.surfaces[0], grains.time, grains.parameters().time_step);
  }

  dem::Simulation grains;

private:
  static dem::SimulationParameters with(dem::SimulationParameters p, const double distance)
  {
    p.verlet_distance = distance;
    return p;
  }

  std::optional<dem::SurfacePath> turning;
  std::optional<dem::Outlet> outlet;
};

Frame frame_of(const dem::Simulation &grains, const std::int64_t only_bead)
{
  const dem::Particles &p = grains.particles;
  if (only_bead != BulkCase::all)
    return {grains.time, {only_bead}, {p.position[grains.index_of(only_bead)]}};
  return {grains.time, p.id, p.position};
}

} // namespace

Track BergamoContestant::run(const BulkCase &bulk, const double distance)
{
  Steps steps(bulk, distance);
  Track track{frame_of(steps.grains, bulk.only_bead)};
  for (int sample = 0; sample < bulk.n_samples; ++sample)
  {
    for (std::int64_t n = 0; n < bulk.steps_between_samples; ++n)
      steps.step();
    steps.grains.check_finite();
    track.push_back(frame_of(steps.grains, bulk.only_bead));
  }
  return track;
}

double BergamoContestant::time(const BulkCase &bulk, const int n_steps, const double distance)
{
  Steps steps(bulk, distance);
  for (int n = 0; n < warm_up_steps; ++n)
    steps.step();
  const auto start = std::chrono::steady_clock::now();
  for (int n = 0; n < n_steps; ++n)
    steps.step();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  steps.grains.check_finite();
  return seconds;
}

BulkCase advanced(const BulkCase &bulk, const double seconds)
{
  Steps steps(bulk, bulk.parameters.verlet_distance);
  while (steps.grains.time < seconds)
    steps.step();
  BulkCase later = bulk;
  later.vessel = dem::Surface(steps.grains.surfaces[0].node, bulk.vessel.topology.triangle);
  later.vessel.material = bulk.vessel.material;
  const dem::Particles &beads = steps.grains.particles;
  later.beads = {};
  for (std::size_t i = 0; i < beads.size(); ++i)
    if (beads.position[i].z() > bulk.outlet)
      later.beads.append(beads, i, static_cast<std::int64_t>(later.beads.size()));
  return later;
}

} // namespace bergamo::benchmark
