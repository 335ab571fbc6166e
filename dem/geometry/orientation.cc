#include "dem/geometry/orientation.h"

#include "dem/core/error.h"

#include <cmath>

namespace bergamo::dem
{

Quaternion unit_orientation(const Quaternion &orientation)
{
  const double length = orientation.coeffs().stableNorm();
  require(length >= 1e-100 && length <= 1e100, "length of an orientation's quaternion", length,
          "positive and finite, 1 at best; no rotation is (w, x, y, z) = (1, 0, 0, 0)");
  return orientation.normalized();
}

void require_finite(const Vec3 &position, const char *const name)
{
  for (int d = 0; d < 3; ++d)
    require(std::isfinite(position[d]), name, position[d], "a finite number [m]");
}

} // namespace bergamo::dem
