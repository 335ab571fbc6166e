#pragma once

#include <functional>

namespace bergamo::fe
{
class MovingBody;
}

namespace bergamo::driver
{

/// Seconds of the wall clock that a step takes, the median of several blocks in some tenths of a second.
/// @param step may be made some thousand times
double seconds_of(const std::function<void()> &step);

/// The same of a body at rest, which is made ready for it: forces, kick and drift.
double seconds_of_step(fe::MovingBody &body);

} // namespace bergamo::driver
