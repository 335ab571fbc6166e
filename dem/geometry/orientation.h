#pragma once

#include "dem/core/types.h"

namespace bergamo::dem
{

/// The unit quaternion of an orientation that a user gave, of any length in [1e-100, 1e100]. Throws ConfigError for one
/// that is no number, infinite, or has no direction.
Quaternion unit_orientation(const Quaternion &orientation);

/// Throws ConfigError for a place that is not finite. @param name of what lies there; @param position [m]
void require_finite(const Vec3 &position, const char *name);

} // namespace bergamo::dem
