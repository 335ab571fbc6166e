#pragma once

#include "dem/geometry/adaptive_quadrature.h"
#include "dem/geometry/clump.h"

#include <span>

namespace bergamo::dem
{

/// What a part shares with others.
struct PartOverlap
{
  Integral shared;       ///< moments of the shared part, in the part's own frame with half-axes one
  bool is_whole = false; ///< all of it is shared
};

/// Moments of the points that a part shares with at least one of other parts. Orientations must be unit quaternions.
/// @param tolerance of the moments, half-axes one
PartOverlap shared_moments(const ClumpPart &part, std::span<const ClumpPart> others, double tolerance);

} // namespace bergamo::dem
