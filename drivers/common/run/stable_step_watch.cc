#include "drivers/common/run/stable_step_watch.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace bergamo::driver
{

void StableStepWatch::look(const double time_step, const double stable, Progress &progress)
{
  smallest_stable = smallest_stable > 0 ? std::min(smallest_stable, stable) : stable;
  if (time_step <= stable || std::exchange(has_warned, true))
    return;
  std::ostringstream message;
  message << name << " is " << time_step << " s, the stable step is now estimated at " << stable << " s";
  progress.warn(message.str());
}

} // namespace bergamo::driver
