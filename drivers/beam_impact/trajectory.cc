#include "drivers/beam_impact/trajectory.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{

std::vector<TouchingTime> touching_times(const std::vector<double> &force, const double time_step)
{
  std::vector<TouchingTime> times;
  bool is_touching = false;
  for (std::size_t n = 0; n < force.size(); ++n)
  {
    if (force[n] > 0.)
    {
      const double time = static_cast<double>(n) * time_step;
      if (!is_touching)
        times.push_back({time, time, 0., 0.});
      times.back().end = time;
      times.back().largest_force = std::max(times.back().largest_force, force[n]);
      times.back().impulse += force[n] * time_step;
    }
    is_touching = force[n] > 0.;
  }
  return times;
}

double largest_deviation(const std::vector<double> &values, const std::vector<double> &exact)
{
  double difference = 0., size = 0.;
  for (std::size_t n = 0; n < exact.size(); ++n)
  {
    difference = std::max(difference, std::abs(values[n] - exact[n]));
    size = std::max(size, std::abs(exact[n]));
  }
  return difference / size;
}

} // namespace bergamo::driver
