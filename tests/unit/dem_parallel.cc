#include "dem/core/parallel.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>
#include <mutex>
#include <set>
#include <unistd.h>

using namespace bergamo;

TEST_CASE("loops of little and of much work share the same threads")
{
  constexpr int n_threads = 4;
  const Threads threads(n_threads);
  std::mutex mutex;
  std::set<pid_t> used;
  for (int repeat = 0; repeat < 50; ++repeat)
    for (const std::size_t n : {1, 2, 3, 100, 2}) // parts of one; the last ones are fewer than threads
      parallel_ranges(n, 1,
                      [&](const std::size_t, const std::size_t, const std::size_t)
                      {
                        const std::lock_guard lock(mutex);
                        used.insert(gettid());
                      });
  CHECK(used.size() <= n_threads);
}

TEST_CASE("each of the parts is worked once, with fewer and with more of them than threads")
{
  const Threads threads(4);
  for (const std::size_t n : {0, 1, 2, 3, 4, 5, 31, 32, 33, 1000})
  {
    std::vector<int> visits(n, 0);
    parallel_ranges(n, 1,
                    [&](const std::size_t, const std::size_t begin, const std::size_t end)
                    {
                      for (std::size_t i = begin; i < end; ++i)
                        ++visits[i];
                    });
    CHECK(visits == std::vector<int>(n, 1));
  }
}
