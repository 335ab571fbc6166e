#include "drivers/common/run/trigger.h"

#include <catch2/catch.hpp>

#include <chrono>

using namespace bergamo::driver;

namespace
{

/// The steps at which a trigger is due in a stage of n_steps steps of the given length [s].
std::vector<std::int64_t> due_steps(const Trigger &trigger, const std::int64_t n_steps, const double dt = 1)
{
  std::vector<std::int64_t> due;
  Moment now;
  for (now.step = 0; now.step <= n_steps; ++now.step)
  {
    now.time = now.step * dt;
    now.is_last = now.step == n_steps;
    if (trigger(now))
      due.push_back(now.step);
    now.last_time = now.time;
  }
  return due;
}

using Steps = std::vector<std::int64_t>;

} // namespace

TEST_CASE("a trigger of steps is due at the first one and at every n-th after it")
{
  CHECK(due_steps(every_steps(3), 7) == Steps{0, 3, 6});
  CHECK(due_steps(every_steps(1), 2) == Steps{0, 1, 2});
}

TEST_CASE("a trigger of time is due at the first step at or after each multiple of its interval")
{
  CHECK(due_steps(every_time(1), 10, 0.4) == Steps{0, 3, 5, 8, 10}); // 0, 1.2, 2, 3.2, 4
  CHECK(due_steps(every_time(0.1), 2, 1) == Steps{0, 1, 2});         // longer steps than intervals
}

TEST_CASE("given times are met once each, at the first step at or after them")
{
  CHECK(due_steps(at_times({0, 1, 1.1, 3}), 10, 0.4) == Steps{0, 3, 8});
  CHECK(due_steps(at_times({}), 10) == Steps{});
}

TEST_CASE("evenly is n times over a stage and once at its end")
{
  CHECK(due_steps(evenly(4, 8), 8) == Steps{0, 2, 4, 6, 8});
  CHECK(due_steps(evenly(3, 10), 10) == Steps{0, 3, 6, 9, 10});
  CHECK(due_steps(evenly(100, 2), 2) == Steps{0, 1, 2}); // more often than there are steps
  CHECK(due_steps(evenly(0, 5), 5) == Steps{0, 5});
  CHECK(due_steps(evenly(3, 12, 3), 12) == Steps{0, 3, 6, 9, 12}); // every fourth step, in cycles of three
  CHECK(due_steps(evenly(100, 6, 3), 6) == Steps{0, 3, 6});
  CHECK(due_steps(at_the_end(), 5) == Steps{5});
}

TEST_CASE("a trigger of the wall clock is due when its interval has passed since it last was")
{
  double clock = 100;
  const Trigger trigger = every_wall_time(10, [&] { return clock; });
  CHECK_FALSE(trigger({}));
  clock = 109;
  CHECK_FALSE(trigger({}));
  clock = 113;
  CHECK(trigger({}));
  CHECK_FALSE(trigger({}));
  clock = 122;
  CHECK_FALSE(trigger({}));
  clock = 123;
  CHECK(trigger({}));
}

TEST_CASE("the wall clock counts seconds on a clock that is never set back")
{
  const auto now = [] { return std::chrono::steady_clock::now().time_since_epoch(); };
  const std::chrono::duration<double> before = now();
  const double clock = wall_clock();
  const std::chrono::duration<double> after = now();
  CHECK(before.count() <= clock);
  CHECK(clock <= after.count());
}

TEST_CASE("either asks both triggers, so that each keeps its own account")
{
  double clock = 0;
  const Trigger wall = every_wall_time(10, [&] { return clock; });
  const Trigger both = either(every_steps(1), wall);
  clock = 10;
  CHECK(both({}));
  CHECK_FALSE(either([](const Moment &) { return false; }, [](const Moment &) { return false; })({}));
}
