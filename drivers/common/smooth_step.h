#pragma once

#include <algorithm>

namespace bergamo::driver
{

/// From 0 to 1, without a jump of the rate; a half on average. @param share of the time, 0 before and 1 after
inline double smooth_step(const double share)
{
  const double s = std::clamp(share, 0., 1.);
  return s * s * (3. - 2. * s);
}

} // namespace bergamo::driver
