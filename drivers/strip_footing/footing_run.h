#pragma once

#include "drivers/common/command_line.h"
#include "drivers/common/history.h"
#include "drivers/common/progress.h"
#include "drivers/common/run_folder.h"
#include "drivers/common/snapshot_timer.h"
#include "drivers/common/summary.h"
#include "drivers/strip_footing/footing_model.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// One run of the footing in its folder: static start, settlement, files. Ends early, with a snapshot, when the user
/// asks for it.
class FootingRun
{
public:
  /// Sets up or, with --restart, reads the state to begin with; nothing is written before run().
  FootingRun(const FootingParameters &parameters, const CommandLine &command_line, std::string parameter_text,
             RunFolder &folder);

  /// @return false if the user stopped it
  bool run();

  /// Figures of the finished run.
  Summary summary() const;

private:
  /// What a restart needs beside the ground.
  struct State
  {
    std::int64_t step = 0;
    double largest_residual = 0;           ///< of the energy balance [J]
    double bearing_sum = 0, n_bearing = 0; ///< of the pressures over the last part of the settlement [Pa]
    std::vector<double> picture_times;     ///< of the frames written [s]
  };

  void sample(double time, History &history);
  void write_picture(double time);
  void write_snapshot();

  using Clock = std::chrono::steady_clock;

  const FootingParameters &parameters;
  std::string parameter_text;
  RunFolder &folder;
  bool is_restart;
  Progress progress;
  FootingModel model;
  State state;
  Clock::time_point start = Clock::now();
  SnapshotTimer snapshot_timer;
  std::int64_t steps_here = 0; ///< done by this process
};

} // namespace bergamo::driver
