#pragma once

#include "dem/core/pack.h"
#include "dem/core/types.h"

namespace bergamo
{

/// Two unit columns t1, t2 that complete a unit vector n to a right-handed frame (t1, t2, n).
template <class Real>
using TangentFrameOf = Eigen::Matrix<Real, 3, 2>;
using TangentFrame = TangentFrameOf<double>;

/// A vector's part in the tangent plane, as the frame sees it.
template <class Real>
Vector2<Real> in_frame(const TangentFrameOf<Real> &frame, const Vector3<Real> &v)
{
  return {frame.col(0).dot(v), frame.col(1).dot(v)};
}

/// The vector that the frame sees so.
template <class Real>
Vector3<Real> from_frame(const TangentFrameOf<Real> &frame, const Vector2<Real> &v)
{
  return frame.col(0) * v[0] + frame.col(1) * v[1];
}

/// Duff et al. 2017, Building an orthonormal basis, revisited.
template <class Real>
TangentFrameOf<Real> tangent_frame(const Vector3<Real> &n)
{
  const Real sign = math::select(n[2] >= Real(0.), Real(1.), Real(-1.));
  const Real a = Real(-1.) / (sign + n[2]);
  const Real b = n[0] * n[1] * a;
  TangentFrameOf<Real> frame;
  frame(0, 0) = Real(1.) + sign * n[0] * n[0] * a;
  frame(1, 0) = sign * b;
  frame(2, 0) = -sign * n[0];
  frame(0, 1) = b;
  frame(1, 1) = sign + n[1] * n[1] * a;
  frame(2, 1) = -n[1];
  return frame;
}

} // namespace bergamo
