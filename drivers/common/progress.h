#pragma once

#include "drivers/common/run/wall_clock.h"

#include <cstdint>
#include <iosfwd>
#include <string>

namespace bergamo::driver
{

/// Where a run stands.
struct ProgressState
{
  double fraction = 0;        ///< of the stage, from 0 to 1
  double time_s = 0;          ///< simulated time [s]
  std::int64_t steps = 0;     ///< steps done since the run began
  std::int64_t particles = 0; ///< particles that each step moves
};

/// One line of progress as it is shown; negative rates and times are unknown and left out.
struct ProgressLine
{
  std::string stage;
  double fraction = 0;
  double time_s = 0;
  double steps_per_second = -1;
  double particle_steps_per_second = -1;
  double seconds_left = -1;
};

/// "consolidation  42.3 %  t = 0.0123 s  1.23 k steps/s  2.46 M particle-steps/s  3 min 12 s left".
std::string format_progress(const ProgressLine &line);

/// 75 s as "1 min 15 s", 7300 s as "2 h 01 min".
std::string format_duration(double seconds);

/// Settings of the progress display.
struct ProgressOptions
{
  bool quiet = false;
  bool is_terminal = false;     ///< one live line instead of a plain line now and then
  std::size_t max_width = 1000; ///< columns of the terminal; longer lines are cut
  std::ostream *stream = nullptr;
  WallClock clock;

  /// Standard error and the steady clock.
  static ProgressOptions standard(bool quiet);
};

/// Shows how far a run is: on a terminal one live line, renewed five times a second at most; elsewhere a plain line
/// every ten seconds and one at the end of each stage.
class Progress
{
public:
  explicit Progress(ProgressOptions options);
  ~Progress();
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  /// Begins a stage (ends the one before) at the state where it starts.
  void begin_stage(const std::string &name, const ProgressState &state = {});

  /// Call it after every step: it costs one look at the clock.
  void update(const ProgressState &state);

  /// Shows the last state and closes the stage's line.
  void end_stage();

  /// A line of its own, above the live one; nothing where all is quiet.
  void note(const std::string &text);

  /// "warning: …" on a line of its own, above the live one; also where all else is quiet.
  void warn(const std::string &text);

private:
  void show(const ProgressState &state, double now);
  void write_live(const std::string &line);
  void write_above(const std::string &line);

  ProgressOptions options;
  std::string stage;
  bool in_stage = false;
  ProgressState first, shown, latest;
  double first_clock = 0, shown_clock = 0;
  double steps_per_second = -1;
  std::size_t live_width = 0; ///< characters of the live line on the terminal
};

} // namespace bergamo::driver
