#pragma once

namespace bergamo::driver
{

/// Volume of the voids over that of the grains [-]. @param solid_fraction of the whole, > 0
inline double void_ratio_of(const double solid_fraction)
{
  return 1 / solid_fraction - 1;
}

} // namespace bergamo::driver
