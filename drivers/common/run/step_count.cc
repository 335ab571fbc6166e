#include "drivers/common/run/step_count.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{
namespace
{

constexpr double most_steps = 1e15;

} // namespace

std::int64_t steps_over(const NamedTime &duration, const NamedTime &step)
{
  const double steps = std::ceil(duration.seconds / step.seconds - 1e-9);
  if (!(steps <= most_steps))
    reject(duration.name, " is ", duration.seconds, " s, at a step of ", step.seconds, " s (", step.name, ") ", steps,
           " steps: at most ", most_steps, " can be counted; choose a shorter time or a longer step");
  return whole_steps(steps);
}

std::int64_t whole_steps(const double steps)
{
  return static_cast<std::int64_t>(std::clamp(steps, 1., most_steps));
}

} // namespace bergamo::driver
