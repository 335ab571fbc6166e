#pragma once

#include "dem/core/pack.h"

namespace bergamo::fe
{

inline constexpr int points_per_pack = 8;

/// One double for each of eight quadrature points. Elements with more points hold several packs, those with fewer fill
/// up with points of no volume.
using Points = Lanes<points_per_pack>;

using math::sum, math::least;

} // namespace bergamo::fe
