#pragma once

#include <chrono>

namespace bergamo::driver
{

/// Tells by the wall clock when a run's next snapshot is due.
class SnapshotTimer
{
public:
  /// @param interval [s]
  explicit SnapshotTimer(const double interval) : interval(interval) {}

  /// Whether the interval has passed since the last time that this was so, or since the construction.
  bool is_due()
  {
    const auto now = Clock::now();
    if (std::chrono::duration<double>(now - last).count() < interval)
      return false;
    last = now;
    return true;
  }

private:
  using Clock = std::chrono::steady_clock;

  double interval;
  Clock::time_point last = Clock::now();
};

} // namespace bergamo::driver
