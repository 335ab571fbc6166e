#include "drivers/common/interrupt.h"
#include "drivers/common/progress.h"

#include <catch2/catch.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <optional>
#include <sstream>
#include <vector>

using namespace bergamo::driver;
using Catch::Matchers::Contains;

namespace
{

struct Display
{
  double now = 100;
  std::ostringstream stream;
  ProgressOptions options(const bool is_terminal, const bool quiet = false)
  {
    ProgressOptions options;
    options.is_terminal = is_terminal;
    options.quiet = quiet;
    options.stream = &stream;
    options.clock = [this] { return now; };
    return options;
  }
};

/// A stage of 1000 steps that takes 100 s.
void run_stage(Display &display, Progress &progress)
{
  progress.begin_stage("shear", {.particles = 2000});
  for (int step = 1; step <= 1000; ++step)
  {
    display.now += 0.1;
    progress.update({.fraction = step / 1000.0, .time_s = step * 1e-5, .steps = step, .particles = 2000});
  }
  progress.end_stage();
}

} // namespace

TEST_CASE("a progress line says what is known, and only that")
{
  CHECK(format_progress({.stage = "shear", .fraction = 0.423, .time_s = 0.0123}) == "shear   42.3 %  t = 0.0123 s");
  CHECK(format_progress({"shear", 1, 0.5, 1234, 2468000, 192}) ==
        "shear  100.0 %  t = 0.5 s  1.23 k steps/s  2.47 M particle-steps/s  3 min 12 s left");
  CHECK(format_progress({"shear", 0.5, 0, 0.5, 999.7, 0}) ==
        "shear   50.0 %  t = 0 s  0.5 steps/s  1 k particle-steps/s  0 s left");
}

TEST_CASE("durations read well")
{
  CHECK(format_duration(0.4) == "0 s");
  CHECK(format_duration(59.4) == "59 s");
  CHECK(format_duration(59.6) == "1 min 00 s");
  CHECK(format_duration(75) == "1 min 15 s");
  CHECK(format_duration(7300) == "2 h 01 min");
  CHECK(format_duration(-1) == "0 s");
}

TEST_CASE("without a terminal there is a plain line every ten seconds and one at the end")
{
  Display display;
  Progress progress(display.options(false));
  run_stage(display, progress);
  const std::string text = display.stream.str();
  const auto n_lines = std::count(text.begin(), text.end(), '\n');
  CHECK(n_lines >= 10);
  CHECK(n_lines <= 11);
  CHECK_THAT(text, !Contains("\r"));
  CHECK_THAT(text, Contains("shear  100.0 %  t = 0.01 s  10 steps/s  20 k particle-steps/s  1 min 40 s\n"));
}

TEST_CASE("on a terminal one line is renewed, five times a second at most, and never wider than the terminal")
{
  Display display;
  ProgressOptions options = display.options(true);
  options.max_width = 40;
  Progress progress(options);
  run_stage(display, progress);
  const std::string text = display.stream.str();
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
  CHECK(std::count(text.begin(), text.end(), '\r') <= 502);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line, '\r');)
    CHECK(line.size() <= 41); // with the final line break
}

TEST_CASE("the time left follows from the stage's own fraction, also after a restart")
{
  Display display;
  Progress progress(display.options(false));
  progress.begin_stage("shear", {.fraction = 0.5, .steps = 500, .particles = 10});
  display.now += 20;
  progress.update({.fraction = 0.6, .steps = 600, .particles = 10});
  CHECK_THAT(display.stream.str(), Contains("  5 steps/s  50 particle-steps/s  1 min 20 s left"));
}

TEST_CASE("a note is a line of its own, before and within a stage")
{
  Display display;
  Progress progress(display.options(true));
  progress.note("grains.csv: 3 grains");
  CHECK(display.stream.str() == "grains.csv: 3 grains\n");
  progress.begin_stage("shear", {.steps = 0, .particles = 10});
  display.now += 20;
  progress.update({.fraction = 0.5, .steps = 10, .particles = 10});
  progress.note("the pile stands");
  CHECK_THAT(display.stream.str(), Contains("\rthe pile stands\n"));
}

TEST_CASE("quiet is silent but for warnings")
{
  for (const bool is_terminal : {false, true})
  {
    Display display;
    Progress progress(display.options(is_terminal, true));
    run_stage(display, progress);
    progress.note("grains.csv: 3 grains");
    CHECK(display.stream.str().empty());
    progress.begin_stage("shear");
    progress.warn("the step is long");
    CHECK(display.stream.str() == "warning: the step is long\n");
  }
}

namespace
{

/// The handlers of the signals that stop a run, put back at the end, and no flag left behind.
class SavedHandlers
{
public:
  SavedHandlers()
  {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
      handlers.push_back(std::signal(signal, SIG_DFL));
  }
  ~SavedHandlers()
  {
    clear_interrupt();
    for (const int signal : {SIGHUP, SIGTERM, SIGINT})
    {
      std::signal(signal, handlers.back());
      handlers.pop_back();
    }
  }

private:
  std::vector<void (*)(int)> handlers;
};

} // namespace

TEST_CASE("each signal that stops a run raises the flag that its loop reads")
{
  const SavedHandlers saved;
  const InterruptWatch watch;
  install_interrupt_handler();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
  {
    CHECK_FALSE(interrupted());
    std::raise(signal);
    CHECK(interrupted());
    CHECK(interrupt_signal() == signal);
    clear_interrupt();
  }
}

TEST_CASE("where nobody watches for it, the first signal ends the program")
{
  const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
  const bool is_watched = GENERATE(true, false);
  const pid_t child = ::fork();
  if (child == 0)
  {
    ::close(STDERR_FILENO);
    std::signal(SIGHUP, SIG_DFL);
    install_interrupt_handler();
    std::optional<InterruptWatch> watch;
    watch.emplace();
    if (!is_watched)
      watch.reset();
    std::raise(signal);
    ::_exit(interrupted() ? 3 : 4);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  if (is_watched)
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 3));
  else
    CHECK((WIFSIGNALED(status) && WTERMSIG(status) == signal));
}

TEST_CASE("a hangup that follows another signal does not end the program before its snapshot")
{
  const SavedHandlers saved;
  const InterruptWatch watch;
  install_interrupt_handler();
  std::raise(SIGTERM);
  std::raise(SIGHUP); // the default would end this test program
  CHECK(interrupt_signal() == SIGTERM);
}

TEST_CASE("a run under nohup outlives its terminal")
{
  const SavedHandlers saved;
  std::signal(SIGHUP, SIG_IGN);
  const InterruptWatch watch;
  install_interrupt_handler();
  std::raise(SIGHUP);
  CHECK_FALSE(interrupted());
}
