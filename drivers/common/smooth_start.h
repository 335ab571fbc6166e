#pragma once

#include <algorithm>

namespace bergamo::driver
{

/// From 0 to 1 without a jump of the rate, with a mean of a half. @param share of the time that the start takes
inline double smooth_start(const double share)
{
  const double s = std::clamp(share, 0., 1.);
  return s * s * (3. - 2. * s);
}

} // namespace bergamo::driver
