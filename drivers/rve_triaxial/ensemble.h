#pragma once

#include "drivers/common/run_folder.h"
#include "drivers/common/summary.h"
#include "drivers/rve_triaxial/parameters.h"
#include "drivers/rve_triaxial/sample.h"

#include <memory>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// All samples of a run, as many at once as there are threads, each in samples/NNNN of the run's folder. Where fewer
/// samples are left than threads, a sample has several; its results do not depend on that.
class Ensemble
{
public:
  /// @param parameter_text resolved, kept with the snapshots; @param restart goes on with the samples of the folder
  Ensemble(const RveParameters &parameters, std::string parameter_text, RunFolder &folder, bool restart);

  /// Opens the folder and runs what is not finished yet. @return false if the user stopped it.
  /// A sample that fails is reported at the end, and the others go on; @throws RunError then
  bool run(bool quiet);

  Summary summary() const;

private:
  struct Sample
  {
    SampleSettings settings;
    SampleFigures figures;
    SampleProgress progress;
    bool is_finished = false;
    std::string failure;
  };

  std::filesystem::path folder_of(const Sample &sample) const;
  std::vector<Sample *> unfinished();
  void run_sample(Sample &sample);
  void write_table() const;
  void write_figures(const Sample &sample) const;
  bool read_figures(Sample &sample) const;

  const RveParameters &parameters;
  std::string parameter_text;
  RunFolder &folder;
  bool is_restart;
  std::vector<std::unique_ptr<Sample>> samples;
  double wall_time = 0.; ///< of this process [s]
  std::int64_t particle_steps_here = 0;
};

} // namespace bergamo::driver
