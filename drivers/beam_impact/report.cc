#include "drivers/beam_impact/report.h"

namespace bergamo::driver
{

void add_impacts(Summary &summary, const std::string &prefix, const Trajectory &way, const double time_step)
{
  std::vector<double> begins, ends, forces, impulses;
  for (const TouchingTime &time : touching_times(way.force, time_step))
  {
    begins.push_back(time.begin);
    ends.push_back(time.end);
    forces.push_back(time.largest_force);
    impulses.push_back(time.impulse);
  }
  const std::size_t last = way.sphere.size() - 1;
  summary.set(prefix + "impact_begins_s", begins, "s");
  summary.set(prefix + "impact_ends_s", ends, "s");
  summary.set(prefix + "impact_largest_forces_N", forces, "N");
  summary.set(prefix + "impact_impulses_N_s", impulses, "N s");
  summary.set(prefix + "departure_velocity_m_s", (way.sphere[last - 1] - way.sphere[last]) / time_step, "m/s");
}

void add_deviations(Summary &summary, const std::string &prefix, const Trajectory &way, const Trajectory &exact)
{
  summary.set(prefix + "sphere_deviation", largest_deviation(way.sphere, exact.sphere));
  summary.set(prefix + "beam_deviation", largest_deviation(way.beam, exact.beam));
  summary.set(prefix + "force_deviation", largest_deviation(way.force, exact.force));
}

} // namespace bergamo::driver
