#include "drivers/penetration/parameters.h"

#include "dem/core/error.h"
#include "drivers/common/grain_parameters.h"
#include "drivers/common/smooth_step.h"

namespace bergamo::driver
{

PenetrationParameters::PenetrationParameters()
{
  simulation.grain() = {.young_modulus = 2e7, .poisson_ratio = 0.2, .density = 2650.};
  simulation.set_damping(0.3);
  simulation.between_grains().friction = 0.24;
  simulation.with_walls().friction = 0.;
  simulation.time_step = 6e-6;
  sand.box = Vec3(40e-3, 6e-3, 22e-3);
  sand.solid_fraction = 0.52;
  sand.settling_gravity = 9.81;
  sand.settling_time = 0.15;
  sand.settling_step = 1e-5;
  output.n_samples = 100;
}

void PenetrationParameters::declare(ParameterFile &file)
{
  file.add(
      "Intruder", "kind", intruder.kind,
      "plate: a blade, edge down; cone: round, with a pointed or a flat tip; pile: from the box's front to its back",
      {{"plate", IntruderKind::plate}, {"cone", IntruderKind::cone}, {"pile", IntruderKind::pile}});
  file.add("Intruder", "breadth", intruder.breadth, "of a plate, along y [m]", Range::positive().usual(1e-4, 10));
  intruder.declare(file, "Intruder");
  file.add("Intruder", "friction", intruder_friction, "Coulomb's coefficient between grains and intruder",
           Range::non_negative().usual(0, 2));
  sand.declare(file);
  declare_grains(file, simulation);
  file.add("Grains", "friction", simulation.between_grains().friction, "Coulomb's coefficient between grains",
           Range::non_negative().usual(0, 2));
  file.add("Grains", "box friction", simulation.with_walls().friction,
           "the same between grains and the rigid box; 0: smooth", Range::non_negative().usual(0, 2));
  declare_overlap_tolerance(file, "Grains", simulation.contact.overlap_tolerance);

  file.add("Penetration", "gravity", gravity, "[m/s2]", Range::positive().usual(0.1, 1e4));
  file.add("Penetration", "depth", depth, "way of the intruder from the highest grain down [m]",
           Range::positive().usual(1e-4, 10));
  file.add("Penetration", "speed", speed, "[m/s]", Range::positive().usual(1e-5, 100));
  file.add("Penetration", "start time", start_time, "over which the speed grows, smoothly [s]", Range::positive());
  file.add("Penetration", "time step", simulation.time_step, "[s]", Range::positive());
  output.declare(file, "grains, intruder and contacts are");
}

void PenetrationParameters::validate() const
{
  sand.validate(simulation.grain(), box());
  sand.require_stable({"Penetration/time step", simulation.time_step}, simulation.grain());
  settling().validate();
  penetrating().validate();
  n_steps();
  if (0.5 * speed * start_time > depth)
    reject("Penetration/start time is ", start_time, " s, in which the intruder goes ", 0.5 * speed * start_time,
           " m, beyond Penetration/depth, ", depth, " m; choose a shorter one");
  constexpr double densest = 0.74;
  const double lowest_level = sand.box[2] * sand.solid_fraction / densest;
  if (depth > lowest_level)
    reject("Penetration/depth is ", depth, " m, but the settled sand may be only ", lowest_level,
           " m high; choose less, or a higher Sand/box");
  if (intruder.width >= sand.box[0])
    reject("Intruder/width is ", intruder.width, " m; choose less than the length of Sand/box, ", sand.box[0], " m");
  const double across = intruder.kind == IntruderKind::cone ? intruder.width : intruder.breadth;
  if (intruder.kind != IntruderKind::pile && across >= sand.box[1])
    reject("the intruder is ", across, " m across; choose less than the depth of Sand/box, ", sand.box[1],
           " m, by Intruder/", intruder.kind == IntruderKind::cone ? "width" : "breadth");
}

IntruderShape PenetrationParameters::shape() const
{
  IntruderShape s = intruder;
  if (s.kind == IntruderKind::pile)
    s.breadth = sand.box[1];
  return s;
}

Intruder PenetrationParameters::make_intruder(const double height) const
{
  const double largest_grain = 2. * sand.distribution.largest_half_axis;
  const IntruderShape s = shape();
  return driver::make_intruder(s, height * Vec3::UnitZ(), s.tip_height() + depth + 2. * largest_grain, largest_grain);
}

dem::Box PenetrationParameters::box() const
{
  const Vec3 half(0.5 * sand.box[0], 0.5 * sand.box[1], 0.);
  return {-half, half + sand.box[2] * Vec3::UnitZ()};
}

dem::SimulationParameters PenetrationParameters::penetrating() const
{
  dem::SimulationParameters p = simulation;
  p.wall() = p.grain();
  p.gravity = {0., 0., -gravity};
  p.materials.add(p.grain());
  p.materials.between(dem::grain_material, intruder_material).friction = intruder_friction;
  p.set_damping(simulation.between_grains().damping_ratio);
  return p;
}

dem::SimulationParameters PenetrationParameters::settling() const
{
  return sand.settling(penetrating());
}

std::int64_t PenetrationParameters::n_steps() const
{
  return steps_over({"Penetration/depth over speed", end()}, {"Penetration/time step", simulation.time_step});
}

double PenetrationParameters::speed_at(const double time) const
{
  return speed * smooth_step(time / start_time);
}

} // namespace bergamo::driver
