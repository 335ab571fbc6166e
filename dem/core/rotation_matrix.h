#pragma once

#include "dem/core/types.h"

namespace bergamo
{

/// Matrix of a unit quaternion (x, y, z, w): body to global.
template <class Real>
Matrix3<Real> rotation_matrix(const Real &x, const Real &y, const Real &z, const Real &w)
{
  const Real one(1.), two(2.);
  Matrix3<Real> r;
  r(0, 0) = one - two * (y * y + z * z);
  r(0, 1) = two * (x * y - w * z);
  r(0, 2) = two * (x * z + w * y);
  r(1, 0) = two * (x * y + w * z);
  r(1, 1) = one - two * (x * x + z * z);
  r(1, 2) = two * (y * z - w * x);
  r(2, 0) = two * (x * z - w * y);
  r(2, 1) = two * (y * z + w * x);
  r(2, 2) = one - two * (x * x + y * y);
  return r;
}

/// R v
template <class Real>
Vector3<Real> turn(const Matrix3<Real> &r, const Vector3<Real> &v)
{
  return {r(0, 0) * v[0] + r(0, 1) * v[1] + r(0, 2) * v[2], r(1, 0) * v[0] + r(1, 1) * v[1] + r(1, 2) * v[2],
          r(2, 0) * v[0] + r(2, 1) * v[1] + r(2, 2) * v[2]};
}

/// R^T v
template <class Real>
Vector3<Real> turn_back(const Matrix3<Real> &r, const Vector3<Real> &v)
{
  return {r(0, 0) * v[0] + r(1, 0) * v[1] + r(2, 0) * v[2], r(0, 1) * v[0] + r(1, 1) * v[1] + r(2, 1) * v[2],
          r(0, 2) * v[0] + r(1, 2) * v[1] + r(2, 2) * v[2]};
}

} // namespace bergamo
