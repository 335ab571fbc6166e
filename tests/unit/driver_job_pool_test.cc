#include "dem/core/error.h"
#include "drivers/common/run/job_pool.h"

#include <catch2/catch.hpp>
#include <omp.h>

#include <sstream>

using namespace bergamo::driver;

TEST_CASE("a job that throws is reported, and the others are done")
{
  const int n_threads = omp_get_max_threads();
  omp_set_num_threads(GENERATE(1, 3));
  std::vector<std::shared_ptr<Job>> jobs;
  const auto add = [&](std::function<void()> run) { jobs.emplace_back(std::make_shared<Job>())->run = std::move(run); };
  for (int k = 0; k < 2; ++k)
  {
    add([] { throw bergamo::RunError("cannot write ensemble.csv"); });
    add([] { throw 7; });
    add([&jobs, k] { jobs[3 * k + 2]->is_finished = true; });
  }
  std::ostringstream shown;
  Progress progress({.quiet = true, .stream = &shown, .clock = wall_clock});
  run_jobs(jobs, "jobs", progress);
  omp_set_num_threads(n_threads);
  CHECK(jobs[2]->is_finished);
  CHECK(jobs[5]->is_finished);
  CHECK(jobs[0]->failure == "cannot write ensemble.csv");
  CHECK(jobs[4]->failure == "an exception of unknown kind");
  CHECK(jobs[5]->failure.empty());
}
