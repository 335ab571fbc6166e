#include "drivers/rubber_block/sand.h"

#include "dem/geometry/contact_geometry.h"
#include "dem/loading/compression.h"
#include "dem/measure/coordination.h"
#include "dem/measure/solid_fraction.h"
#include "dem/packing/pack_grains.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/packing_target.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bergamo::driver
{
namespace
{

/// Of the walls that box_walls() gives.
std::int32_t wall_facing(const std::vector<dem::PlaneWall> &walls, const Vec3 &normal)
{
  return static_cast<std::int32_t>(
      std::find_if(walls.begin(), walls.end(), [&](const dem::PlaneWall &wall) { return wall.normal == normal; }) -
      walls.begin());
}

double mean_speed_of(const dem::Particles &grains)
{
  double sum = 0.;
  for (const Vec3 &velocity : grains.velocity)
    sum += velocity.squaredNorm();
  return std::sqrt(sum / static_cast<double>(grains.size()));
}

} // namespace

std::unique_ptr<dem::Simulation> pack_sand(const RubberBlockParameters &p)
{
  dem::PackingParameters packing;
  packing.solid_fraction = p.sand.solid_fraction;
  packing.density = p.simulation.grain().density;
  packing.tightening.is_stopped = interrupted;
  dem::PackedGrains packed = dem::pack_grains(p.sand.distribution, p.box(), packing, p.sand.seed);
  if (interrupted()) // grains are too small
    return nullptr;
  require_target(packed, packing.solid_fraction, "Sand/solid fraction");
  return std::make_unique<dem::Simulation>(p.settling(), std::move(packed.particles), dem::box_walls(p.box()));
}

double top_of(const dem::Particles &grains)
{
  double top = 0.;
  for (std::size_t i = 0; i < grains.size(); ++i)
    top = std::max(top, grains.position[i][2] +
                            support(dem::make_pose(grains.parts.shape[i], grains.position[i], grains.orientation[i]),
                                    Vec3::UnitZ())
                                .height);
  return top;
}

void SettledSand::add_to(Summary &summary) const
{
  summary.set("sand_height_m", height, "m");
  summary.set("sand_solid_fraction", solid_fraction);
  summary.set("sand_coordination_number", coordination_number);
  summary.set("sand_floor_share", floor_share);
  summary.set("sand_mean_speed_m_s", mean_speed, "m/s");
}

SettledSand end_settling(dem::Simulation &sand, const RubberBlockParameters &p)
{
  SettledSand settled;
  const dem::Particles &grains = sand.particles;
  settled.height = top_of(grains);
  settled.solid_fraction = dem::solid_fraction(grains, p.sand.box[0] * p.sand.box[1] * settled.height);
  settled.coordination_number = dem::mean_coordination(sand.contacts, grains.size());
  const double weight = p.sand.settling_gravity * std::accumulate(grains.mass.begin(), grains.mass.end(), 0.);
  settled.floor_share = -sand.walls[wall_facing(sand.walls, Vec3::UnitZ())].force[2] / weight;
  settled.mean_speed = mean_speed_of(grains);
  sand.rest();
  sand.remove_wall(wall_facing(sand.walls, -Vec3::UnitZ()));
  sand.change(p.pulling());
  sand.reset_accounts();
  return settled;
}

} // namespace bergamo::driver
