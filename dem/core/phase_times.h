#pragma once

#include <chrono>

namespace bergamo
{

/// Wall-clock time spent in the phases of a step since the start [s].
struct PhaseTimes
{
  double neighbours = 0.; ///< Verlet list, sorting
  double contacts = 0.;   ///< following the touching contacts
  double screening = 0.;  ///< pairs apart
  double searches = 0.;
  double summation = 0.;
  double motion = 0.;

  double total() const { return neighbours + contacts + screening + searches + summation + motion; }
};

/// Laps between the phases.
class Stopwatch
{
public:
  /// Adds the time since the last lap.
  void lap(double &phase)
  {
    const auto now = Clock::now();
    phase += std::chrono::duration<double>(now - last).count();
    last = now;
  }

  /// Leaves out the time since the last lap.
  void restart() { last = Clock::now(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last = Clock::now();
};

} // namespace bergamo
