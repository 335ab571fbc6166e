#pragma once

#include "dem/loading/cell_measures.h"
#include "drivers/common/history.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/job_pool.h"
#include "drivers/common/run/run_loop.h"
#include "drivers/rve_triaxial/parameters.h"
#include "drivers/rve_triaxial/sample_figures.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace bergamo::driver
{

/// One sample: packing, generation, and the stages of the program, in a folder of its own. Goes on from its snapshot
/// where there is one.
class SampleRun
{
public:
  SampleRun(const RveParameters &parameters, const SampleSettings &settings, std::filesystem::path folder,
            const std::string &parameter_text, Job &progress);

  /// @return false if the user stopped it, after a snapshot. @throws RunError naming the sample
  bool run();

  const SampleFigures &figures() const { return f; }

private:
  void visit(StateVisitor &visit);
  void go_on();
  bool begin(); ///< @return false where it was stopped on the way; a restart begins it anew
  void make_loading();
  void begin_stage();
  void end_stage();
  void measure();
  void look_at_step();
  std::int64_t steps_to_next_row() const;
  std::int64_t steps_to_next_distribution() const;

  const RveParameters &parameters;
  SampleSettings settings;
  std::filesystem::path folder;
  Job &progress;
  std::vector<dem::LoadingStage> program;
  Snapshot snapshot;
  RunLoop loop;

  std::unique_ptr<dem::Simulation> simulation;
  std::optional<dem::CellLoading> loading;
  std::int64_t stage = 0;                           ///< under way
  std::int64_t next_row = 0, next_distribution = 0; ///< steps
  dem::CellMeasures now;                            ///< of the last row
  EnergyResidual residual;
  SampleFigures f;
  double clock = wall_clock(); ///< up to which f.wall_time counts [s]
};

/// A sample among others.
struct Sample : Job
{
  SampleSettings settings;
  std::filesystem::path folder;
  SampleFigures figures;

  std::filesystem::path figures_file() const { return folder / "figures.csv"; } // there once it is finished
};

} // namespace bergamo::driver
