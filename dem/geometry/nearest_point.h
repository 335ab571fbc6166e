#pragma once

#include "dem/core/types.h"

namespace bergamo::dem
{

/// Point of a triangle that is nearest to another (Ericson 2005, Real-Time Collision Detection, 5.1.5).
Vec3 nearest_on_triangle(const Vec3 &point, const Vec3 &a, const Vec3 &b, const Vec3 &c);

/// The same of a line from a to b.
Vec3 nearest_on_line(const Vec3 &point, const Vec3 &a, const Vec3 &b);

} // namespace bergamo::dem
