#pragma once

#include "dem/core/pack.h"

#include <type_traits>

namespace bergamo::fe
{

inline constexpr int points_per_pack = 8;

/// One double for each of eight quadrature points. Elements with more points hold several packs, those with fewer fill
/// up with points of no volume.
using Points = Lanes<points_per_pack>;

/// The points from one on that fill a register, and their return.
template <class Register = Pack>
BERGAMO_INLINE Register part(const Points &points, const int first)
{
  if constexpr (std::is_same_v<Register, Points>)
    return points;
  else
    return Register([&](auto lane) { return points[first + lane]; });
}
template <class Register>
BERGAMO_INLINE void set_part(const Register &from, const int first, Points &points)
{
  if constexpr (std::is_same_v<Register, Points>)
    points = from;
  else
    for (std::size_t lane = 0; lane < from.size(); ++lane)
      points[first + lane] = from[lane];
}

using math::sum, math::least;

} // namespace bergamo::fe
