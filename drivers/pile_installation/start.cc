#include "drivers/pile_installation/start.h"

#include "coupling/adapter/stress_profile.h"
#include "dem/state/positions_by_id.h"
#include "dem/state/repeated.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bergamo::driver
{
namespace
{

/// That holds all contacts of the sand, also those across the faces of a tile.
dem::Box room_of_contacts(const InstallationParameters &p)
{
  if (p.tiles == 0)
    return p.box();
  dem::Box room = p.tile();
  const double width = room.edges()[0];
  room.low[0] -= width;
  room.high[0] += width;
  return room;
}

/// Puts copies of a settled tile side by side, the middle of all at x = 0. The last contacts to go are those across the
/// ends, where elements begin.
void lay_tiles(std::unique_ptr<dem::Simulation> &sand, const InstallationParameters &p)
{
  sand = std::make_unique<dem::Simulation>(sand->repeated({{static_cast<int>(p.tiles), 1, 1}}));
  sand->open_cell(p.box().low[0] * Vec3::UnitX());
}

/// Stresses of all sand over the upright one.
Vec3 at_rest(const dem::Simulation &sand, const dem::Box &box)
{
  const Vec3 stress = coupling::stress_profile(sand, box, 1).front().grains;
  return stress / stress[2];
}

/// @return of the grains taken out those that the block may get back as it grows, and those about them
dem::Particles cut_block(dem::Simulation &sand, const InstallationParameters &parameters, const GroundPlan &plan)
{
  const dem::Particles &p = sand.particles;
  const GroundPlan deepest = plan.deeper(plan.outer_bottom - plan.deepest_bottom);
  std::vector<std::int32_t> beyond;
  dem::Particles reserve;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    if (plan.holds_grain(p.position[i]))
      continue;
    beyond.push_back(static_cast<std::int32_t>(i));
    if (parameters.n_growths() > 0 && deepest.is_near(p.position[i], parameters.beside_block()))
      reserve.append(p, i, p.id[i]);
  }
  sand.remove_wall(static_cast<std::int32_t>(sand.walls.size()) - 1); // the bottom
  while (sand.walls.size() > 2)
    sand.remove_wall(0); // at the ends of x: of tiles there are none
  sand.remove(beyond);
  sand.integrate(); // one step: the forces to come are those without them
  return reserve;
}

} // namespace

std::unique_ptr<dem::Simulation> pack_ground(Progress &progress, const InstallationParameters &p)
{
  return p.tiles > 0 ? pack_sand_tile(p.sand, p.tile(), p.settling())
                     : pack_sand(progress, p.sand, p.box(), p.settling());
}

InstallationStart prepare_ground(std::unique_ptr<dem::Simulation> &settled, const InstallationParameters &p)
{
  InstallationStart start;
  start.at_rest = at_rest(*settled, room_of_contacts(p));
  if (p.tiles > 0)
    lay_tiles(settled, p);
  dem::Simulation &sand = *settled;
  start.sand = end_settling(sand, p.sand, p.installing());
  const double mass = std::accumulate(sand.particles.mass.begin(), sand.particles.mass.end(), 0.);
  start.bulk_density = mass / (p.sand.box[0] * p.sand.box[1] * start.sand.level);
  start.place_by_id = dem::positions_by_id(sand.particles);
  start.reference_by_id = start.place_by_id;
  if (!p.is_two_scale())
    return start;
  const GroundPlan plan = p.plan(start.sand.level);
  start.reserve = cut_block(sand, p, plan);
  return start;
}

void InstallationStart::add_to(Summary &summary) const
{
  sand.add_to(summary);
  summary.set("sand_bulk_density_kg_m3", bulk_density, "kg/m3");
  summary.set("earth_pressure_at_rest_x", at_rest[0]);
  summary.set("earth_pressure_at_rest_y", at_rest[1]);
}

void InstallationStart::visit(StateVisitor &visit)
{
  sand.visit(visit);
  visit("start/bulk_density", bulk_density);
  visit("start/at_rest", at_rest);
  visit("start/place", place_by_id);
  visit("start/reference", reference_by_id);
  visit("start/reserve", reserve);
  visit("start/n_growths", n_growths);
}

} // namespace bergamo::driver
