#include "drivers/overlap_waves/pulse.h"

#include <cmath>
#include <numbers>

namespace bergamo::driver
{

double Pulse::stress(const double time) const
{
  if (time <= 0. || time >= duration)
    return 0.;
  const double window = std::sin(std::numbers::pi * time / duration);
  return amplitude * window * window * std::sin(frequency * time);
}

} // namespace bergamo::driver
