#pragma once

namespace bergamo::fe
{

/// One double for each of eight quadrature points. Vector extension of GCC and Clang; compiles to what the processor
/// has. Elements with more points hold several packs, those with fewer fill up with points of no volume.
using Points [[gnu::vector_size(64)]] = double;

inline constexpr int points_per_pack = 8;

/// Sum over the points, always in the same order.
inline double sum(const Points &x)
{
  return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
}

inline double smallest(const Points &x)
{
  double least = x[0];
  for (int point = 1; point < points_per_pack; ++point)
    least = x[point] < least ? x[point] : least;
  return least;
}

} // namespace bergamo::fe
