#include "drivers/common/history.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/run_loop.h"
#include "drivers/common/run/table.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <string>

using namespace bergamo::driver;

namespace
{

/// Takes the raised flag back, also where a test fails.
struct Signals
{
  Signals() { install_interrupt_handler(); }
  ~Signals() { clear_interrupt(); }
  InterruptWatch watch;
};

/// A mass on a spring in two stages of six and eight steps, the second one stiffer: a run as drivers have it.
class Oscillator
{
public:
  explicit Oscillator(const std::filesystem::path &folder)
      : snapshot(folder / "snapshot.h5", "oscillator", "set mass = 1"), table({{"time_s", [&] { return time; }},
                                                                               {"place_m", [&] { return place; }},
                                                                               {"highest_m", [&] { return highest; }}}),
        loop({1e9, [this] { write(); }}), file(folder / "history.csv")
  {
    if (std::filesystem::exists(snapshot.path()))
      snapshot.read([this](StateVisitor &v) { visit(v); });
  }

  /// @param last_step of the whole run; the user stops it before the next one
  bool run(const std::int64_t last_step = -1)
  {
    const bool is_new = time == 0;
    History history = is_new ? History(file, table.names()) : History::continued(file, table.names(), loop.last_time());
    for (; stage < 2; ++stage)
    {
      const std::int64_t n_steps = stage == 0 ? 6 : 8;
      const Stepping stepping{.time = [&] { return time; },
                              .is_last = [&] { return loop.step() == n_steps; },
                              .compute = [&] { velocity -= dt * (stage == 0 ? 1 : 3) * place; },
                              .move = [&] { drift(); }};
      const auto stop = [&](const Moment &) { return loop.steps_here() == last_step; };
      if (!loop.run(stepping, {{[](const Moment &) { return true; }, [&] { highest = std::max(highest, place); }},
                               {either(every_time(0.375), at_the_end()), [&] { history.append(table.row()); }},
                               {stop, [] { std::raise(SIGTERM); }}}))
        return false;
      drift();
    }
    return true;
  }

  std::int64_t n_snapshots = 0;

private:
  void drift()
  {
    place += dt * velocity;
    time += dt;
  }

  void visit(StateVisitor &v)
  {
    loop.visit(v);
    v("stage", stage);
    v("time", time);
    v("place", place);
    v("velocity", velocity);
    v("highest", highest);
  }

  void write()
  {
    snapshot.write([this](StateVisitor &v) { visit(v); });
  }

  static constexpr double dt = 0.125;
  Snapshot snapshot;
  Table table;
  RunLoop loop;
  std::filesystem::path file;
  std::int64_t stage = 0;
  double time = 0, place = 1, velocity = 0, highest = 0;
};

} // namespace

TEST_CASE("a run stopped at any step goes on with the same bits")
{
  const Signals signals;
  TemporaryFolder whole;
  REQUIRE(Oscillator(whole.path()).run());
  const std::string history = content_of(whole / "history.csv");
  CHECK(std::count(history.begin(), history.end(), '\n') == 1 + 3 + 3); // three times in a stage, its end one of them
  for (std::int64_t last_step = 0; last_step < 13; ++last_step)         // at the next it ends
  {
    INFO("stopped after step " << last_step);
    TemporaryFolder parts;
    CHECK_FALSE(Oscillator(parts.path()).run(last_step));
    clear_interrupt();
    CHECK(Oscillator(parts.path()).run());
    CHECK(content_of(parts / "history.csv") == history);
  }
}

TEST_CASE("a run stopped again at every step goes on with the same bits")
{
  const Signals signals;
  TemporaryFolder whole, parts;
  REQUIRE(Oscillator(whole.path()).run());
  int n_parts = 1;
  for (; !Oscillator(parts.path()).run(0); ++n_parts)
  {
    clear_interrupt();
    REQUIRE(n_parts < 100);
  }
  CHECK(n_parts > 10);
  CHECK(content_of(parts / "history.csv") == content_of(whole / "history.csv"));
}

TEST_CASE("a step is snapshot, forces, readings in their order, motion; the last one does not move")
{
  std::string order;
  double clock = 0;
  RunLoop loop({.interval = 2, .write = [&] { order += "snapshot "; }, .steps_between_looks = 1},
               [&] { return clock; });
  std::int64_t n = 0;
  const Stepping stepping{.time = [&] { return n * 0.5; },
                          .is_last = [&] { return n == 2; },
                          .compute = [&] { order += "forces "; },
                          .move =
                              [&]
                          {
                            order += "move ";
                            ++n;
                            clock += 1.5;
                          }};
  CHECK(loop.run(stepping, {{every_steps(2), [&] { order += "one "; }}, {at_the_end(), [&] { order += "two "; }}}));
  CHECK(order == "forces one move forces move snapshot forces one two ");
  CHECK(loop.step() == 2);
  CHECK(loop.steps_here() == 2);
  CHECK(loop.last_time() == 1.0);
}

TEST_CASE("snapshots that hold up the run come less often, so that they take a fiftieth of the time at most")
{
  double clock = 0, in_snapshots = 0;
  const double held_up = GENERATE(0.1, 5.);
  const auto write = [&]
  {
    clock += held_up;
    in_snapshots += held_up;
  };
  RunLoop loop({.interval = 20, .write = write, .steps_between_looks = 1}, [&] { return clock; });
  loop.run(
      {.time = [&] { return clock; }, .is_last = [&] { return loop.step() == 1000; }, .compute = [&] { clock += 1; }},
      {});
  CHECK(in_snapshots > 0);
  CHECK(in_snapshots < 0.0201 * clock + held_up); // of the first nothing is known
  CHECK(in_snapshots / held_up == (held_up < 1 ? Approx(49).margin(1) : Approx(4).margin(1)));
}

TEST_CASE("a run knows what all of it and the steps of a stage cost, over restarts, whatever else it does meanwhile")
{
  TemporaryFolder folder;
  Snapshot snapshot(folder / "snapshot.h5", "costs", "");
  double spent = 0; // by a process [s]
  std::int64_t last_step = 4;
  const auto run = [&](RunLoop &loop, const std::int64_t end)
  {
    return loop.run({.time = [&] { return static_cast<double>(loop.step()); },
                     .is_last = [&, end] { return loop.step() == end; },
                     .compute = [&] { spent += 2; },
                     .move = [&] { spent += 1; }},
                    {{every_steps(2), [&] { spent += 100; }}});
  };
  RunLoop before({.interval = 1e9, .write = [] {}}, wall_clock, RunCost([&] { return spent; }));
  REQUIRE(run(before, 6)); // 7 forces, 6 motions, 4 readings
  CHECK(before.cost().stepping_seconds() == 20);
  CHECK(before.cost().core_seconds() == 420);
  REQUIRE(run(before, last_step));
  CHECK(before.cost().stepping_seconds() == 14); // of its own stage
  CHECK(before.cost().core_seconds() == 734);
  spent += 50; // between stages
  snapshot.write([&](StateVisitor &v) { before.visit(v); });

  spent = 7; // another process, which has read much
  RunLoop after({.interval = 1e9, .write = [] {}}, wall_clock, RunCost([&] { return spent; }));
  snapshot.read([&](StateVisitor &v) { after.visit(v); });
  CHECK(after.cost().stepping_seconds() == 14);
  CHECK(after.cost().core_seconds() == 791);
  REQUIRE(run(after, last_step + 2)); // goes on with the step that had not moved
  CHECK(after.cost().stepping_seconds() == 14 + 3 * 2 + 2);
  CHECK(after.cost().core_seconds() == 791 + 8 + 200);
}

TEST_CASE("the interval between snapshots runs on from stage to stage")
{
  double clock = 0;
  int n_snapshots = 0;
  RunLoop loop({.interval = 10, .write = [&] { ++n_snapshots; }, .steps_between_looks = 1}, [&] { return clock; });
  for (int stage = 0; stage < 6; ++stage) // each shorter than the interval
  {
    int n = 0;
    CHECK(loop.run({.time = [&] { return stage + n * 0.1; },
                    .is_last = [&] { return n == 3; },
                    .compute = [&] { clock += 1; },
                    .move = [&] { ++n; }},
                   {}));
  }
  CHECK(n_snapshots == 2); // in 24 s
}

TEST_CASE("a stage begins at step 0, and its time may begin anew")
{
  RunLoop loop({.interval = 1e9, .write = [] {}});
  std::vector<std::int64_t> steps;
  for (const double start : {0., 0., 1.})
  {
    CHECK(loop.begins_stage());
    int n = 0;
    CHECK(loop.run({.time = [&] { return start + n * 0.1; },
                    .is_last = [&] { return n == 2; },
                    .compute = [&] { CHECK(loop.begins_stage() == (n == 0)); },
                    .move = [&] { ++n; }},
                   {{at_times({0}), [&] { steps.push_back(loop.step()); }}}));
  }
  CHECK(steps == std::vector<std::int64_t>{0, 0}); // the third goes on with the time of the second
}

TEST_CASE("who stops a run at its last step gets its end, and a stop before it a snapshot")
{
  const Signals signals;
  int n = 0, n_snapshots = 0;
  RunLoop loop({.interval = 1e9, .write = [&] { ++n_snapshots; }});
  const Stepping stepping{
      .time = [&] { return 0.1 * n; }, .is_last = [&] { return n == 3; }, .compute = [] {}, .move = [&] { ++n; }};
  const auto stop_at = [&](const int step) {
    return Action{[step](const Moment &now) { return now.step == step; }, [] { std::raise(SIGTERM); }};
  };
  CHECK_FALSE(loop.run(stepping, {stop_at(1)}));
  CHECK(n_snapshots == 1);
  clear_interrupt();
  CHECK(loop.run(stepping, {stop_at(2)}));
  CHECK(n_snapshots == 1);
}

TEST_CASE("each stage of a run begins with nothing done")
{
  const TemporaryFolder folder;
  CommandLine words;
  words.output = folder / "run";
  words.quiet = true;
  Run run(words, {"two stages", "set steps = 6"});
  run.keep([](StateVisitor &) {});
  run.open();
  for (const std::int64_t n_steps : {6, 8})
  {
    Stage stage = run.even_stage("stage", n_steps, 0.1);
    stage.compute = [] {};
    std::vector<double> fractions{stage.fraction()};
    REQUIRE(run.advance(stage, {{every_steps(1), [&] { fractions.push_back(stage.fraction()); }}}));
    REQUIRE(fractions.size() == static_cast<std::size_t>(n_steps) + 2);
    CHECK(fractions.front() == 0.); // what the time that is left is told by
    CHECK(fractions[2] == 1. / static_cast<double>(n_steps));
    CHECK(fractions.back() == 1.);
  }
}
