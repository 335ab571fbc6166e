#pragma once

#include "drivers/common/command_line.h"
#include "drivers/common/history.h"
#include "drivers/common/progress.h"
#include "drivers/common/run_folder.h"
#include "drivers/common/snapshot_timer.h"
#include "drivers/common/summary.h"
#include "drivers/two_scale_triaxial/packing_stage.h"
#include "drivers/two_scale_triaxial/snapshot.h"
#include "drivers/two_scale_triaxial/specimen.h"

#include <chrono>
#include <memory>
#include <optional>

namespace bergamo::driver
{

/// One run of the test in its folder: packing, loading, files. Every stage ends early, with a snapshot, when the user
/// asks for it.
class TriaxialRun
{
public:
  /// Sets up or, with --restart, reads the stage to begin with; nothing is written before open().
  TriaxialRun(const TriaxialParameters &parameters, const CommandLine &command_line, std::string parameter_text,
              RunFolder &folder);

  /// Opens the folder and runs all stages. @return false if the user stopped it
  bool run();

  /// Figures of the finished run.
  Summary summary() const;

private:
  bool run_packing();
  void begin_loading();
  bool run_loading();
  void sample(double time, const Vec3 &strain, History &history);
  void write_picture(double time);
  void watch_stable_step();

  using Clock = std::chrono::steady_clock;

  const TriaxialParameters &parameters;
  std::string parameter_text;
  RunFolder &folder;
  bool is_restart;
  Progress progress;

  std::optional<PackingStage> packing;
  std::unique_ptr<Specimen> specimen;
  LoadingState state;

  Clock::time_point start = Clock::now();
  SnapshotTimer snapshot_timer;
  std::int64_t steps_here = 0; ///< done by this process
  double largest_overlap = 0., largest_work = 0.;
  SpecimenEnergy last_energy;
  Vec3 last_stress = Vec3::Zero();
  double largest_difference = 0.; ///< between both models' displacements [m]
  bool has_warned = false;
};

} // namespace bergamo::driver
