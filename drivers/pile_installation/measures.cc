#include "drivers/pile_installation/measures.h"

#include "dem/core/error.h"
#include "dem/measure/contact_list.h"
#include "dem/measure/coordination.h"
#include "dem/measure/solid_fraction.h"
#include "drivers/common/run/measured_columns.h"
#include "fe_dealii/body_energy.h"

#include <algorithm>
#include <string>

namespace bergamo::driver
{
namespace
{

void require_within_block(const Installation &installation, const double time)
{
  const std::optional<GroundPlan> &plan = installation.plan();
  const double end = plan ? plan->inner_bottom : 0.;
  if (installation.lowest() > end)
    return;
  throw RunError("the pile has come to the end of the grains that are its own at time " + std::to_string(time) +
                 " s, at a height of " + std::to_string(end) +
                 " m; choose a deeper Model/block depth, or a smaller Pile/head force");
}

} // namespace

void InstallationMeasures::look(const Installation &installation, const double now)
{
  const dem::Simulation &sand = installation.sand();
  sand.check_finite();
  if (installation.body())
    fe::require_bounded(installation.body()->energy(), "the elements at time " + std::to_string(now) + " s",
                        "a smaller Pile/time step");
  require_within_block(installation, now);
  const dem::Particles &grains = sand.particles;
  const std::vector<dem::TouchingContact> pairs = sand.contacts.touching(grains),
                                          walls = sand.contacts.touching_walls(grains);
  time = now;
  way = installation.start().sand.height - installation.lowest();
  depth = installation.start().sand.level - installation.lowest();
  loads = dem::part_loads(grains, sand.surfaces, walls, installation.parts());
  head_force = installation.head_force();
  largest_head_force = std::max(largest_head_force, head_force);
  bottom_force = installation.bottom_force();
  grain_motion = installation.largest_grain_motion();
  element_motion = installation.largest_element_motion();
  difference = installation.largest_difference();
  unbalanced = installation.unbalanced();
  coordination = dem::mean_coordination(sand.contacts, grains.size());
  const double radius = 0.5 * parameters.pile.width;
  const Vec3 below = (installation.lowest() - radius) * Vec3::UnitZ();
  solid_fraction_below = dem::sampled_solid_fraction(dem::equivalent_spheres(grains), {&below, 1}, radius).front();
  overlap = std::max(dem::largest_relative_overlap(pairs, grains), dem::largest_relative_overlap(walls, grains));
  dem::check_overlap(overlap, now, "a smaller Pile/time step");
  largest_overlap_ = std::max(largest_overlap_, overlap);
  energy = installation.energy();
  pile_work = installation.pile_work();
  residual.add(energy.balance(), pile_work);
}

Table InstallationMeasures::table() const
{
  Table table{{{"time_s", [this] { return time; }},
               {"way_m", [this] { return way; }},
               {"depth_m", [this] { return depth; }},
               {"head_resistance_N", [this] { return head_force; }},
               {"tip_resistance_N", [this] { return tip().force[2]; }},
               {"shaft_resistance_N", [this] { return shaft().force[2]; }},
               {"tip_pressure_Pa", [this] { return tip_pressure(); }},
               {"tip_normal_N", [this] { return tip().normal; }},
               {"tip_shear_N", [this] { return tip().shear; }},
               {"shaft_normal_N", [this] { return shaft().normal; }},
               {"shaft_shear_N", [this] { return shaft().shear; }},
               {"lateral_force_x_N", [this] { return tip().force[0] + shaft().force[0]; }},
               {"bottom_force_N", [this] { return bottom_force; }},
               {"largest_grain_motion_m", [this] { return grain_motion; }},
               {"largest_element_motion_m", [this] { return element_motion; }},
               {"coupling_difference_m", [this] { return difference; }},
               {"unbalanced_force", [this] { return unbalanced; }},
               {"coordination_number", [this] { return coordination; }},
               {"solid_fraction_below_tip", [this] { return solid_fraction_below; }},
               {"max_overlap_over_radius", [this] { return overlap; }},
               {"pile_work_J", [this] { return pile_work; }}}};
  table.add(columns_of(energy));
  table.add({{"energy_residual_J", [this] { return residual.present(); }}});
  return table;
}

void InstallationMeasures::add_to(Summary &summary) const
{
  summary.set("depth_m", depth, "m");
  summary.set("head_resistance_N", head_force, "N");
  summary.set("largest_head_resistance_N", largest_head_force, "N");
  summary.set("tip_resistance_N", tip().force[2], "N");
  summary.set("shaft_resistance_N", shaft().force[2], "N");
  summary.set("tip_pressure_Pa", tip_pressure(), "Pa");
  summary.set("solid_fraction_below_tip", solid_fraction_below);
  summary.set("largest_grain_motion_m", grain_motion, "m");
  summary.set("largest_element_motion_m", element_motion, "m");
  summary.set("drift_over_grain",
              std::max(grain_motion, element_motion) / (2. * parameters.sand.distribution.mean_half_axes.mean()));
  summary.set("coupling_difference_m", difference, "m");
  summary.set("unbalanced_force", unbalanced);
  summary.set("pile_work_J", pile_work, "J");
}

void InstallationMeasures::visit(StateVisitor &visit)
{
  visit("largest_overlap", largest_overlap_);
  visit("largest_head_force", largest_head_force);
  residual.visit(visit);
}

} // namespace bergamo::driver
