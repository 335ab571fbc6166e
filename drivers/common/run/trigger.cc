#include "drivers/common/run/trigger.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace bergamo::driver
{

Trigger every_steps(const std::int64_t n)
{
  assert(n >= 1);
  return [n](const Moment &now) { return now.step % n == 0; };
}

Trigger every_time(const double interval)
{
  assert(interval > 0);
  return [interval](const Moment &now)
  { return std::floor(now.time / interval) > std::floor(now.last_time / interval); };
}

Trigger at_times(std::vector<double> times)
{
  return [times = std::move(times)](const Moment &now)
  {
    return std::any_of(times.begin(), times.end(),
                       [&](const double time) { return now.last_time < time && time <= now.time; });
  };
}

Trigger every_wall_time(const double interval, WallClock clock)
{
  return [interval, clock, last = clock()](const Moment &) mutable
  {
    const double now = clock();
    if (now - last < interval)
      return false;
    last = now;
    return true;
  };
}

Trigger at_the_end()
{
  return [](const Moment &now) { return now.is_last; };
}

Trigger either(Trigger one, Trigger other)
{
  return [one = std::move(one), other = std::move(other)](const Moment &now)
  {
    const bool is_one = one(now), is_other = other(now);
    return is_one || is_other;
  };
}

Trigger evenly(const std::int64_t n, const std::int64_t n_steps, const std::int64_t cycle)
{
  const std::int64_t n_cycles = n_steps / std::max<std::int64_t>(1, n) / cycle;
  return either(every_steps(std::max<std::int64_t>(1, n_cycles) * cycle), at_the_end());
}

} // namespace bergamo::driver
