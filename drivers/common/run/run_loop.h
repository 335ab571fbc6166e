#pragma once

#include "drivers/common/run/run_cost.h"
#include "drivers/common/run/snapshot.h"
#include "drivers/common/run/trigger.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace bergamo::driver
{

/// How a run goes one step on, and how far.
struct Stepping
{
  /// Simulated, of the present step, and of a row that it writes, to the last bit: a restart keeps rows up to it [s].
  std::function<double()> time;
  std::function<bool()> is_last;      ///< whether the present step ends the stage; asked before and after compute
  std::function<void()> compute;      ///< forces and kick: energies and loads can be read from here on
  std::function<void()> move = [] {}; ///< to the next step; not called at the last one
};

/// What is done at some moments of a run, between compute and move. It must leave the state of the models as it is.
struct Action
{
  Trigger trigger;
  std::function<void()> act;
};

/// When a run writes its snapshot, and what is in it.
struct SnapshotPlan
{
  /// Of the wall clock, the most that a kill can cost [s]: where a snapshot holds up the run by more than
  /// `largest_share` of it, the next one waits longer.
  double interval = 30;
  std::function<void()> write;
  std::int64_t steps_between_looks = 50; ///< at the clock
  static constexpr double largest_share = 0.02;
};

/// The loop of every run, over one stage after the other. A step is: snapshot, when one is due or the user asks the run
/// to stop; compute; the actions whose moment it is, in their order; move. The state that a snapshot holds is that
/// before compute, so a run that goes on from it does this step's actions (again).
class RunLoop
{
public:
  explicit RunLoop(SnapshotPlan plan, WallClock clock = wall_clock, RunCost cost = RunCost());

  /// Goes on to the end of the stage: from its start, or from the step of a snapshot that has been read.
  /// @return false if the user stopped it (see interrupted()), after a snapshot
  bool run(const Stepping &stepping, const std::vector<Action> &actions);

  /// What a restart needs of the loop itself.
  void visit(StateVisitor &visit);

  /// Whether the next call of run() begins a stage, or goes on with the one of a snapshot.
  bool begins_stage() const { return stage_is_done_ || step_ == 0; }

  std::int64_t step() const { return step_; }             ///< of the stage
  double last_time() const { return last_time_; }         ///< of the last step whose actions are done [s]
  std::int64_t steps_here() const { return steps_here_; } ///< done by this process, over all stages
  const RunCost &cost() const { return cost_; }           ///< of the run; of steps without actions and snapshots

private:
  bool snapshot_is_due() const;
  void write_snapshot();

  SnapshotPlan plan_;
  WallClock clock_;
  RunCost cost_;
  double last_snapshot_, held_up_ = 0; // when, and by how much it held up the run [s]
  std::int64_t step_ = 0, steps_here_ = 0;
  double last_time_ = -std::numeric_limits<double>::infinity();
  bool stage_is_done_ = false;
};

} // namespace bergamo::driver
