#pragma once

#include "dem/core/types.h"

#include <cstdint>
#include <span>

namespace bergamo::dem
{

/// Bounding spheres of grains or of the parts of bodies, among which near pairs are looked for.
struct BoundingSpheres
{
  std::span<const Vec3> positions;           ///< centres [m], finite
  std::span<const double> radii;             ///< [m], >= 0
  std::span<const double> masses = {};       ///< infinite for what is fixed [kg]; none given, nothing is
  std::span<const std::int32_t> body = {};   ///< that each belongs to; none given, each is a body by itself
  std::span<const std::uint8_t> sought = {}; ///< only pairs with one of these are looked for; none given, all
};

} // namespace bergamo::dem
