#pragma once

#include "drivers/common/progress.h"
#include "drivers/common/run/state_visitor.h"

#include <string>
#include <utility>

namespace bergamo::driver
{

/// Keeps the smallest stable step of a run and warns, once a process, where the time step is longer.
class StableStepWatch
{
public:
  /// @param name of the parameter that sets the step, "Loading/time step"
  explicit StableStepWatch(std::string name) : name(std::move(name)) {}

  /// @param time_step in use, @param stable estimated now [s]
  void look(double time_step, double stable, Progress &progress);

  double smallest() const { return smallest_stable; } ///< [s]; 0 before the first look

  void visit(StateVisitor &visit) { visit("stable_step/smallest", smallest_stable); }

private:
  std::string name;
  double smallest_stable = 0;
  bool has_warned = false;
};

} // namespace bergamo::driver
