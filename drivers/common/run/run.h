#pragma once

#include "drivers/common/command_line.h"
#include "drivers/common/history.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/plots.h"
#include "drivers/common/progress.h"
#include "drivers/common/run/run_loop.h"
#include "drivers/common/run/table.h"
#include "drivers/common/run_folder.h"
#include "drivers/common/summary.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// What a run says of itself.
struct RunDescription
{
  std::string kind;                        ///< of its snapshots, e.g. "strip footing"
  std::string parameters;                  ///< resolved text of all parameters
  double snapshot_interval = 30;           ///< of the wall clock [s]
  std::vector<std::string> own_files = {}; ///< that it writes beside those of every run, see RunFolder
};

/// A part of a run: how it is stepped, and what is shown of it.
struct Stage : Stepping
{
  std::string name;
  std::function<double()> fraction; ///< done, from 0 to 1
  std::int64_t n_particles = 0;
};

/// All of a run that is not its physics: its folder and files, progress, snapshots, and the loop over its steps.
///
/// In this order: construct it, keep(), open(), advance() stage by stage, and then finish(), or stop() once advance()
/// says that the user wants it.
class Run
{
public:
  /// Checks the folder and leaves the disk as it is; see RunFolder for what it refuses.
  Run(const CommandLine &command_line, const RunDescription &description);

  /// Says what belongs into a snapshot. With --restart it is read here and now.
  /// @return whether it was: otherwise the run begins
  bool keep(Visit state);

  /// From here on the disk changes: folder, parameters.prm. Throws as RunFolder::open() does.
  void open();

  bool is_restart() const { return command_line_.restart; }
  void write_snapshot() const { snapshot_.write(state_); }

  /// history.csv with the columns of the table, new at the first step of the stage, otherwise with the rows of the
  /// steps that are done.
  History history(const Table &table) const { return history(table, folder_.history()); }

  /// The same in another file.
  History history(const Table &table, const std::filesystem::path &file) const;

  /// A stage of n_steps steps of one length [s] from time 0; compute and move are left to fill in.
  Stage even_stage(const std::string &name, std::int64_t n_steps, double time_step) const;

  /// Goes on to the end of a stage, shows the progress. @return false if the user stopped it, after a snapshot
  bool advance(const Stage &stage, std::vector<Action> actions);

  /// Figures of the clocks, and those of all its steps by this process. @param n_particles moved in a step
  RunFigures figures(std::int64_t n_particles) const;

  /// Writes and shows the summary, draws the pictures, as report_run(). @return done
  /// @param scripts that draw the folder of the run, see PlotJob
  int finish(const Summary &summary, const std::vector<std::string> &scripts) const;

  /// Tells how to go on. @return stopped_by_user
  int stop() const;

  const RunFolder &folder() const { return folder_; }
  const RunLoop &loop() const { return loop_; }
  Progress &progress() { return progress_; }

private:
  const CommandLine &command_line_;
  std::string parameters_;
  double start_ = wall_clock();
  RunFolder folder_;
  Snapshot snapshot_;
  Visit state_;
  Progress progress_;
  RunLoop loop_;
  std::optional<InterruptWatch> watch_; ///< from open() on: before, there is nothing to save
};

} // namespace bergamo::driver
