#pragma once

#include "dem/core/types.h"

namespace bergamo::dem
{

using TangentFrame = Eigen::Matrix<double, 3, 2>;

/// Two unit columns t1, t2 that complete the unit vector n to a right-handed frame (t1, t2, n). Duff et al. 2017.
inline TangentFrame tangent_frame(const Vec3 &n)
{
  const double sign = n[2] >= 0. ? 1. : -1.;
  const double a = -1. / (sign + n[2]);
  const double b = n[0] * n[1] * a;
  TangentFrame frame;
  frame << 1. + sign * n[0] * n[0] * a, b, sign * b, sign + n[1] * n[1] * a, -sign * n[0], -n[1];
  return frame;
}

} // namespace bergamo::dem
