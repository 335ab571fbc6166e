#pragma once

#include "drivers/common/run/wall_clock.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace bergamo::driver
{

/// Where a run stands when its triggers are asked.
struct Moment
{
  std::int64_t step = 0;                                       ///< of the stage, from 0
  double time = 0;                                             ///< simulated [s]
  double last_time = -std::numeric_limits<double>::infinity(); ///< of the moment before, if there was one [s]
  bool is_last = false;                                        ///< of the stage
};

/// Tells whether something is due; asked at every step (after HOOMD-blue's triggers, Anderson et al. 2020). Those of
/// steps and of simulated time look at the moment alone, so that a restarted run does the same at the same moments as
/// one in one go. Those of the wall clock are for what leaves results as they are.
using Trigger = std::function<bool(const Moment &)>;

/// Every n-th step of the stage, the first one too. @param n >= 1
Trigger every_steps(std::int64_t n);

/// At the first moment, and at the first one at or after every multiple of the interval. @param interval > 0 [s]
Trigger every_time(double interval);

/// Once at or after each of the times [s].
Trigger at_times(std::vector<double> times);

/// When the interval has passed since the last time, or since the trigger was made. @param interval [s]
Trigger every_wall_time(double interval, WallClock clock = wall_clock);

/// At the last moment of the stage.
Trigger at_the_end();

/// When one of both is due; both are asked.
Trigger either(Trigger one, Trigger other);

/// n times over a stage of n_steps steps, evenly, and once more at its end. @param cycle but for the end, only at its
/// multiples [steps], >= 1
Trigger evenly(std::int64_t n, std::int64_t n_steps, std::int64_t cycle = 1);

} // namespace bergamo::driver
