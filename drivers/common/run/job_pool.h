#pragma once

#include "drivers/common/progress.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// A part of a run that goes on beside others.
struct Job
{
  std::function<void()> run; ///< may throw; several jobs run at a time
  bool is_finished = false;  ///< set by run, or from the start where an earlier process did the job
  std::string failure;       ///< what run threw, or empty

  /// Where it stands, for others to read while it runs.
  /// @{
  std::atomic<double> fraction = 0.;        ///< done, from 0 to 1
  std::atomic<std::int64_t> steps_here = 0; ///< done by this process
  std::atomic<std::int64_t> particles = 0;
  /// @}
};

/// Runs jobs side by side, as many as OpenMP has threads, in their order; the threads are shared out, so that a job has
/// several where there are fewer jobs. Passes by what is finished. Begins no job once the user has asked to stop;
/// returns when all that were begun have ended. Shows the progress of all as one stage.
void run_jobs(const std::vector<std::shared_ptr<Job>> &jobs, const std::string &stage_name, Progress &progress);

/// Steps times particles done by this process over all jobs.
double particle_steps_here(const std::vector<std::shared_ptr<Job>> &jobs);

} // namespace bergamo::driver
