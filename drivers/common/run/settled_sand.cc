#include "drivers/common/run/settled_sand.h"

#include "dem/loading/compression.h"
#include "dem/measure/coordination.h"
#include "dem/measure/extent.h"
#include "dem/measure/solid_fraction.h"
#include "dem/packing/pack_grains.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/packing_target.h"
#include "drivers/common/sand_file.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace bergamo::driver
{
namespace
{

/// Nothing where the user interrupts it.
std::optional<dem::Particles> pack(const SandParameters &sand, const dem::PackingSpace &space,
                                   const dem::SimulationParameters &settling)
{
  dem::PackingParameters packing;
  packing.solid_fraction = sand.solid_fraction;
  packing.density = settling.grain().density;
  packing.tightening.is_stopped = interrupted;
  dem::PackedGrains packed = dem::pack_grains(sand.distribution, space, packing, sand.seed);
  if (interrupted()) // grains are too small
    return {};
  require_target(packed, packing.solid_fraction, "Sand/solid fraction");
  return std::move(packed.particles);
}

double mean_speed_of(const dem::Particles &grains)
{
  double sum = 0.;
  for (const Vec3 &velocity : grains.velocity)
    sum += velocity.squaredNorm();
  return std::sqrt(sum / static_cast<double>(grains.size()));
}

} // namespace

std::unique_ptr<dem::Simulation> pack_sand(Progress &progress, const SandParameters &sand, const dem::Box &box,
                                           const dem::SimulationParameters &settling)
{
  if (!sand.grains_file.empty())
  {
    dem::GrainsOfFile file = read_sand(sand, box, settling.grain());
    progress.note(file.statement);
    return std::make_unique<dem::Simulation>(settling, std::move(file.particles), dem::box_walls(box));
  }
  std::optional<dem::Particles> packed = pack(sand, box, settling);
  return packed ? std::make_unique<dem::Simulation>(settling, std::move(*packed), dem::box_walls(box)) : nullptr;
}

std::unique_ptr<dem::Simulation> pack_sand_tile(const SandParameters &sand, const dem::Box &tile,
                                                const dem::SimulationParameters &settling)
{
  std::optional<dem::Particles> packed = pack(sand, dem::PackingSpace::periodic(tile, {true, false, false}), settling);
  if (!packed)
    return nullptr;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  packed->cell = dem::PeriodicCell({tile.edges()[0], infinite, infinite});
  std::vector<dem::PlaneWall> walls = dem::box_walls(tile);
  walls.erase(walls.begin(), walls.begin() + 2); // across x
  return std::make_unique<dem::Simulation>(settling, std::move(*packed), std::move(walls));
}

bool settle_sand(Run &run, dem::Simulation &sand, const SandParameters &p)
{
  Stage stage = run.even_stage("settling", p.n_settling_steps(), p.settling_step);
  stage.n_particles = static_cast<std::int64_t>(sand.particles.size());
  stage.compute = [&] { sand.compute_forces(); };
  stage.move = [&] { sand.integrate(); };
  return run.advance(stage, {{every_steps(200), [&] { sand.check_finite(); }}});
}

void SettledSand::add_to(Summary &summary) const
{
  summary.set("sand_height_m", height, "m");
  summary.set("sand_level_m", level, "m");
  summary.set("sand_solid_fraction", solid_fraction);
  summary.set("sand_coordination_number", coordination_number);
  summary.set("sand_floor_share", floor_share);
  summary.set("sand_mean_speed_m_s", mean_speed, "m/s");
}

SettledSand end_settling(dem::Simulation &sand, const SandParameters &p, const dem::SimulationParameters &after)
{
  SettledSand settled;
  const dem::Particles &grains = sand.particles;
  settled.height = dem::highest_point(grains);
  settled.level = 2. * dem::centre_of_mass(grains)[2];
  settled.solid_fraction = dem::solid_fraction(grains, p.box[0] * p.box[1] * settled.height);
  settled.coordination_number = dem::mean_coordination(sand.contacts, grains.size());
  const double weight = p.settling_gravity * std::accumulate(grains.mass.begin(), grains.mass.end(), 0.);
  const auto lid = static_cast<std::int32_t>(sand.walls.size()) - 1;
  settled.floor_share = -sand.walls[lid - 1].force[2] / weight;
  settled.mean_speed = mean_speed_of(grains);
  sand.rest();
  sand.remove_wall(lid);
  sand.change(after);
  sand.reset_accounts();
  return settled;
}

} // namespace bergamo::driver
