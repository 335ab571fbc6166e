#include "drivers/common/run/job_pool.h"

#include "drivers/common/interrupt.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <iterator>
#include <mutex>
#include <thread>

namespace bergamo::driver
{
namespace
{

using Jobs = std::vector<std::shared_ptr<Job>>;

ProgressState state_of(const Jobs &jobs)
{
  ProgressState state{.particles = 1};
  for (const auto &job : jobs)
  {
    state.fraction += job->fraction / static_cast<double>(jobs.size());
    state.steps += job->steps_here;
    state.particles = std::max<std::int64_t>(state.particles, job->particles);
  }
  return state;
}

void run_guarded(Job &job)
{
  try
  {
    job.run();
  }
  catch (const std::exception &error)
  {
    job.failure = error.what();
  }
  catch (...) // of a library; it must not end the other jobs
  {
    job.failure = "an exception of unknown kind";
  }
}

} // namespace

void run_jobs(const Jobs &jobs, const std::string &stage_name, Progress &progress)
{
  Jobs left;
  std::copy_if(jobs.begin(), jobs.end(), std::back_inserter(left), [](const auto &job) { return !job->is_finished; });
  const int n_threads = omp_get_max_threads();
  const int n_workers = std::min<int>(n_threads, static_cast<int>(left.size()));
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::condition_variable changed;
  int n_working = n_workers;
  progress.begin_stage(stage_name, state_of(jobs));
  std::vector<std::jthread> workers;
  for (int w = 0; w < n_workers; ++w)
    workers.emplace_back(
        [&, w]
        {
          omp_set_num_threads(std::max(1, (n_threads + n_workers - 1 - w) / n_workers));
          for (std::size_t k; !interrupted() && (k = next++) < left.size();)
            run_guarded(*left[k]);
          const std::lock_guard guard(mutex);
          --n_working;
          changed.notify_all();
        });
  std::unique_lock lock(mutex);
  while (n_working > 0)
  {
    changed.wait_for(lock, std::chrono::milliseconds(200));
    progress.update(state_of(jobs));
  }
  lock.unlock();
  workers.clear();
  progress.update(state_of(jobs));
  progress.end_stage();
}

double particle_steps_here(const Jobs &jobs)
{
  double sum = 0.;
  for (const auto &job : jobs)
    sum += static_cast<double>(job->steps_here * job->particles);
  return sum;
}

} // namespace bergamo::driver
