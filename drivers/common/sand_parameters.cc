#include "drivers/common/sand_parameters.h"

#include "dem/core/error.h"
#include "dem/motion/stable_step.h"
#include "drivers/common/grain_parameters.h"
#include "drivers/common/sand_file.h"

namespace bergamo::driver
{

void SandParameters::declare(ParameterFile &file)
{
  file.add("Sand", "box", {box.data(), 3}, "inner edges of the rigid box; upright: of the loose packing [m]",
           Range::positive().usual(1e-4, 10));
  declare_distribution(file, "Sand", distribution);
  file.add("Sand", "solid fraction", solid_fraction, "of the loose packing",
           {.lowest = 0, .highest = 0.6, .lowest_included = false});
  file.add("Sand", "seed", seed, "of all random numbers");
  file.add("Sand", "grains file", grains_file,
           "a packing to settle instead of one that is made: a table (.csv) or a dump of LAMMPS or LIGGGHTS, see "
           "docs/files.md; places as in the pictures of the driver; empty: none");
  file.add("Sand/Settling", "gravity", settling_gravity, "what the packing settles under [m/s2]",
           Range::positive().usual(0.1, 1e4));
  file.add("Sand/Settling", "time", settling_time, "[s]", Range::positive());
  file.add("Sand/Settling", "time step", settling_step, "[s]", Range::positive());
  file.add("Sand/Settling", "damping ratio", settling_damping, "dashpot at the contacts, share of critical damping",
           Range::between(0, 10).usual(0, 1));
}

void SandParameters::validate(const dem::Material &grain, const dem::Box &place) const
{
  distribution.validate();
  n_settling_steps();
  if (!grains_file.empty())
    read_sand(*this, place, grain);
  require_stable({"Sand/Settling/time step", settling_step}, grain);
}

void SandParameters::require_stable(const NamedTime &step, const dem::Material &grain) const
{
  // At an overlap of 1e-5 radii: no packing under load is softer.
  const double limit = dem::stable_step_of_two_spheres(distribution.smallest_half_axis, grain, 1e-5);
  if (step.seconds > limit)
    reject(step.name, " is ", step.seconds, " s: it must stay below ", limit,
           " s, the stable step of two of the smallest grains in contact");
}

dem::SimulationParameters SandParameters::settling(const dem::SimulationParameters &after) const
{
  dem::SimulationParameters p = after;
  p.gravity = {0., 0., -settling_gravity};
  p.time_step = settling_step;
  p.set_damping(settling_damping);
  return p;
}

std::int64_t SandParameters::n_settling_steps() const
{
  return steps_over({"Sand/Settling/time", settling_time}, {"Sand/Settling/time step", settling_step});
}

} // namespace bergamo::driver
