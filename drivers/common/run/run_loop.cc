#include "drivers/common/run/run_loop.h"

#include "drivers/common/interrupt.h"

#include <algorithm>
#include <utility>

namespace bergamo::driver
{

RunLoop::RunLoop(SnapshotPlan plan, WallClock clock, RunCost cost)
    : plan_(std::move(plan)), clock_(std::move(clock)), cost_(std::move(cost)), last_snapshot_(clock_())
{
}

bool RunLoop::snapshot_is_due() const
{
  return clock_() - last_snapshot_ >= std::max(plan_.interval, held_up_ / SnapshotPlan::largest_share);
}

void RunLoop::write_snapshot()
{
  const double begin = clock_();
  plan_.write();
  last_snapshot_ = clock_();
  held_up_ = last_snapshot_ - begin;
}

void RunLoop::visit(StateVisitor &visit)
{
  visit("loop/step", step_);
  visit("loop/last_time", last_time_);
  cost_.visit(visit);
}

bool RunLoop::run(const Stepping &stepping, const std::vector<Action> &actions)
{
  if (std::exchange(stage_is_done_, false))
    step_ = 0;
  if (step_ == 0)
    cost_.begin_stage();
  if (stepping.time() <= last_time_) // a stage with a time of its own
    last_time_ = -std::numeric_limits<double>::infinity();
  const auto aside = [&](const std::function<void()> &act)
  {
    cost_.pause();
    act();
    cost_.step_on();
  };
  cost_.step_on();
  for (;; ++step_, ++steps_here_)
  {
    const bool is_stopped = interrupted() && !stepping.is_last();
    const bool is_looked_at = steps_here_ > 0 && steps_here_ % plan_.steps_between_looks == 0;
    if ((is_looked_at && snapshot_is_due()) || is_stopped)
      aside([&] { write_snapshot(); });
    if (is_stopped)
      return false;
    stepping.compute();
    const Moment now{step_, stepping.time(), last_time_, stepping.is_last()};
    for (const auto &[trigger, act] : actions)
      if (trigger(now))
        aside(act);
    last_time_ = now.time;
    if (now.is_last)
      break;
    stepping.move();
  }
  cost_.pause();
  stage_is_done_ = true;
  return true;
}

} // namespace bergamo::driver
