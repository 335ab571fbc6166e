#pragma once

#include "drivers/common/run/state_visitor.h"

#include <functional>
#include <utility>

namespace bergamo::driver
{

/// Time of all cores that this process has taken since it began [s]. What waits for a crowded machine takes none.
double processor_time();

/// What a run costs, over all its restarts: all of it, and the steps of a stage.
class RunCost
{
public:
  using Clock = std::function<double()>;

  explicit RunCost(Clock clock = processor_time) : clock_(std::move(clock)) {}

  /// A stage begins, whose steps cost nothing yet.
  void begin_stage() { stepped_ = 0.; }

  /// From here on the run steps.
  void step_on();

  /// From here on it does something else: writes, measures, draws.
  void pause();

  double core_seconds() const { return earlier_ + clock_(); } ///< of all cores together [s]
  double stepping_seconds() const;                            ///< of the steps of the last stage that began [s]

  void visit(StateVisitor &visit);

private:
  Clock clock_;
  double earlier_ = 0.;              // by processes before this one [s]
  double stepped_ = 0., since_ = 0.; // until the last pause, and when stepping went on [s]
  bool is_stepping_ = false;
};

} // namespace bergamo::driver
