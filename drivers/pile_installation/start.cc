#include "drivers/pile_installation/start.h"

#include "coupling/adapter/stress_profile.h"
#include "dem/state/positions_by_id.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bergamo::driver
{
namespace
{

/// Stresses of all sand over the upright one.
Vec3 at_rest(const dem::Simulation &sand, const dem::Box &box)
{
  const Vec3 stress = coupling::stress_profile(sand, box, 1).front().grains;
  return stress / stress[2];
}

/// Above the grains of the overlap by half a grain, so that none leaves the elements as it rises.
double top_of_elements(const dem::Particles &grains, const InstallationParameters &p, const GroundPlan &plan)
{
  double highest = plan.inner_bottom;
  for (const Vec3 &centre : grains.position)
    if (plan.holds_grain(centre) && std::abs(centre[0]) > plan.inner_half_width)
      highest = std::max(highest, centre[2]);
  return highest + p.sand.distribution.mean_half_axes.mean();
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
  for (const std::int32_t wall : {static_cast<std::int32_t>(bottom_wall), 1, 0})
    sand.remove_wall(wall);
  sand.remove(beyond);
  sand.integrate(); // one step: the forces to come are those without them
  return reserve;
}

} // namespace

InstallationStart prepare_ground(dem::Simulation &sand, const InstallationParameters &p)
{
  InstallationStart start;
  dem::Box filled = p.box();
  filled.high[2] = p.sand.box[2];
  start.at_rest = at_rest(sand, filled);
  start.sand = end_settling(sand, p.sand, p.installing());
  const double mass = std::accumulate(sand.particles.mass.begin(), sand.particles.mass.end(), 0.);
  start.bulk_density = mass / (p.sand.box[0] * p.sand.box[1] * start.sand.level);
  start.place_by_id = dem::positions_by_id(sand.particles);
  start.reference_by_id = start.place_by_id;
  if (!p.is_two_scale())
    return start;
  const GroundPlan plan = p.plan(start.sand.level, start.sand.level);
  start.top = top_of_elements(sand.particles, p, plan);
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
  visit("start/top", top);
  visit("start/at_rest", at_rest);
  visit("start/place", place_by_id);
  visit("start/reference", reference_by_id);
  visit("start/reserve", reserve);
  visit("start/n_growths", n_growths);
}

} // namespace bergamo::driver
