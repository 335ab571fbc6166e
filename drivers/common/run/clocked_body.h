#pragma once

#include "coupling/adapter/body_mover.h"
#include "dem/core/phase_times.h"

namespace bergamo::driver
{

/// A body that knows the time which its elements and nodes take.
class ClockedBody final : public coupling::BodyMover
{
public:
  using BodyMover::BodyMover;

  void compute_forces() override
  {
    Stopwatch watch;
    BodyMover::compute_forces();
    watch.lap(seconds_);
  }
  void kick(const double time_step) override
  {
    Stopwatch watch;
    BodyMover::kick(time_step);
    watch.lap(seconds_);
  }
  void drift(const double time_step) override
  {
    Stopwatch watch;
    BodyMover::drift(time_step);
    watch.lap(seconds_);
  }

  double seconds() const { return seconds_; } ///< of the wall clock, since it was made

private:
  double seconds_ = 0.;
};

} // namespace bergamo::driver
