#include "drivers/penetration/measures.h"

#include "dem/measure/contact_list.h"
#include "dem/measure/inertial_number.h"
#include "dem/measure/solid_fraction.h"
#include "drivers/common/run/measured_columns.h"

#include <algorithm>
#include <numeric>

namespace bergamo::driver
{

void PenetrationMeasures::look(const Intrusion &intrusion, const double now)
{
  const dem::Simulation &grains = intrusion.sand();
  const dem::Particles &particles = grains.particles;
  const std::vector<dem::TouchingContact> pairs = grains.contacts.touching(particles),
                                          walls = grains.contacts.touching_walls(particles);
  time = now;
  lowest = intrusion.lowest();
  weight = parameters.gravity * std::accumulate(particles.mass.begin(), particles.mass.end(), 0.);
  loads = dem::part_loads(particles, grains.surfaces, walls, intrusion.parts());
  floor_force = grains.walls[bottom_wall].force[2];
  sides_force = 0.;
  for (std::size_t k = 0; k < bottom_wall; ++k)
    sides_force += grains.walls[k].force[2];
  drive_force = intrusion.drive_force();
  drive_work = intrusion.drive_work();
  coordination = dem::coordination_numbers(particles, pairs, walls);
  rattler_fraction = static_cast<double>(coordination.n_rattlers) / static_cast<double>(particles.size());
  const double radius = 0.5 * parameters.intruder.width;
  const Vec3 below = (lowest - radius) * Vec3::UnitZ();
  solid_fraction_below = dem::sampled_solid_fraction(dem::equivalent_spheres(particles), {&below, 1}, radius).front();
  inertial_number = tip_pressure() > 0. ? dem::inertial_number(dem::mean_grain(particles),
                                                               parameters.speed_at(now) / (2. * radius), tip_pressure())
                                        : 0.;
  overlap = std::max(dem::largest_relative_overlap(pairs, particles), dem::largest_relative_overlap(walls, particles));
  dem::check_overlap(overlap, now, "a smaller Penetration/time step");
  largest_overlap_ = std::max(largest_overlap_, overlap);
  if (shaft().normal > 0.)
    largest_shaft_friction = std::max(largest_shaft_friction, shaft().shear / shaft().normal);
  energy = grains.energy();
  residual.add(intrusion.energy_balance(), drive_work);
  momentum.look(grains);
  if (sand.height - lowest > std::min(parameters.intruder.width, 0.5 * parameters.depth))
    trend.add(sand.level - lowest, tip_pressure());
}

Vec3 PenetrationMeasures::moment() const
{
  return tip().moment + shaft().moment - (lowest * Vec3::UnitZ()).cross(force());
}

double PenetrationMeasures::bulk_weight() const
{
  return weight / (parameters.sand.box[0] * parameters.sand.box[1] * sand.level);
}

Table PenetrationMeasures::table() const
{
  Table table{{{"time_s", [this] { return time; }},
               {"way_m", [this] { return sand.height - lowest; }},
               {"depth_m", [this] { return sand.level - lowest; }},
               {"resistance_N", [this] { return force()[2]; }},
               {"tip_resistance_N", [this] { return tip().force[2]; }},
               {"shaft_resistance_N", [this] { return shaft().force[2]; }},
               {"tip_pressure_Pa", [this] { return tip_pressure(); }},
               {"tip_normal_N", [this] { return tip().normal; }},
               {"tip_shear_N", [this] { return tip().shear; }},
               {"shaft_normal_N", [this] { return shaft().normal; }},
               {"shaft_shear_N", [this] { return shaft().shear; }},
               {"lateral_force_x_N", [this] { return force()[0]; }},
               {"lateral_force_y_N", [this] { return force()[1]; }},
               {"moment_x_Nm", [this] { return moment()[0]; }},
               {"moment_y_Nm", [this] { return moment()[1]; }},
               {"torque_Nm", [this] { return moment()[2]; }},
               {"drive_force_N", [this] { return drive_force; }},
               {"floor_force_N", [this] { return floor_force; }},
               {"sides_force_N", [this] { return sides_force; }},
               {"coordination_number", [this] { return coordination.mean; }},
               {"coordination_number_deviation", [this] { return coordination.deviation; }},
               {"mechanical_coordination_number", [this] { return coordination.mechanical; }},
               {"coordination_number_without_rattlers", [this] { return coordination.without_rattlers; }},
               {"rattler_fraction", [this] { return rattler_fraction; }},
               {"solid_fraction_below_tip", [this] { return solid_fraction_below; }},
               {"inertial_number", [this] { return inertial_number; }},
               {"max_overlap_over_radius", [this] { return overlap; }},
               {"work_drive_J", [this] { return drive_work; }}}};
  table.add(columns_of(energy));
  table.add({{"energy_residual_J", [this] { return residual.present(); }},
             {"momentum_residual_Ns", [this] { return momentum.present().norm(); }}});
  return table;
}

void PenetrationMeasures::add_to(Summary &summary) const
{
  sand.add_to(summary);
  summary.set("sand_weight_N", weight, "N");
  summary.set("bulk_weight_N_m3", bulk_weight(), "N/m3");
  summary.set("depth_m", sand.level - lowest, "m");
  summary.set("resistance_N", force()[2], "N");
  summary.set("tip_resistance_N", tip().force[2], "N");
  summary.set("shaft_resistance_N", shaft().force[2], "N");
  summary.set("mean_tip_pressure_Pa", trend.mean(), "Pa");
  summary.set("bearing_factor", trend.mean() / (trend.mean_depth() * bulk_weight()));
  summary.set("bearing_factor_of_slope", trend.slope() / bulk_weight());
  summary.set("largest_shaft_friction", largest_shaft_friction);
  summary.set("coordination_number", coordination.mean);
  summary.set("coordination_number_deviation", coordination.deviation);
  summary.set("inertial_number", inertial_number);
  summary.set("momentum_residual", momentum.relative());
}

void PenetrationMeasures::visit(StateVisitor &visit)
{
  visit("largest_overlap", largest_overlap_);
  visit("largest_shaft_friction", largest_shaft_friction);
  residual.visit(visit);
  momentum.visit(visit);
  trend.visit(visit);
}

} // namespace bergamo::driver
