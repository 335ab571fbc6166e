#pragma once

#include <chrono>
#include <functional>

namespace bergamo::driver
{

/// A clock on the wall: seconds from any origin.
using WallClock = std::function<double()>;

/// The system's steady clock [s].
inline double wall_clock()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace bergamo::driver
