#pragma once

#include "dem/core/pack.h"
#include "dem/geometry/superquadric.h"

namespace bergamo::dem
{

/// What the support function of a superquadric needs: half-axes [m] and the dual exponents q = 2/(2 - eps).
/// Real is double or a SIMD pack.
template <class Real>
struct SupportShape
{
  Real r1, r2, r3;
  Real q1, q2;
  Real q2_over_q1, one_over_q2;

  SupportShape(const Real &r1, const Real &r2, const Real &r3, const Real &eps1, const Real &eps2)
      : r1(r1), r2(r2), r3(r3), q1(Real(2.) / (Real(2.) - eps1)), q2(Real(2.) / (Real(2.) - eps2)),
        q2_over_q1((Real(1.) - Real(0.5) * eps1) * q2), one_over_q2(Real(1.) - Real(0.5) * eps2)
  {
  }
};

inline SupportShape<double> support_shape(const Superquadric &s)
{
  return {s.half_axes[0], s.half_axes[1], s.half_axes[2], s.eps1, s.eps2};
}

/// Support height h(N), the surface point X = grad h whose outward normal is N, and dX/dN, all in the body frame.
template <class Real>
struct Support
{
  Real h;                            ///< [m]
  Real x1, x2, x3;                   ///< [m]
  Real h11, h22, h33, h12, h13, h23; ///< second derivatives of h [m]
};

namespace detail
{

/// Shares a/(a+b), b/(a+b) and log(a+b) from log a and log b, without overflow or loss.
template <class Real>
struct LogSum
{
  Real share_a, share_b, log_sum;

  LogSum(const Real log_a, const Real log_b)
  {
    using math::abs, math::exp, math::log, math::select;
    const Real ratio = exp(-abs(log_a - log_b)); // smaller over larger
    const Real large = Real(1) / (Real(1) + ratio);
    const Real small = ratio * large;
    const auto a_is_large = log_a >= log_b;
    share_a = select(a_is_large, large, small);
    share_b = select(a_is_large, small, large);
    log_sum = select(a_is_large, log_a, log_b) + log(Real(1) + ratio); // its absolute error counts, no log1p
  }
};

} // namespace detail

namespace detail
{

/// Of an ellipsoid: h^2 = sum of (r_i N_i)^2.
inline Support<double> support_of_ellipsoid(const SupportShape<double> &shape, const Vec3 &n)
{
  const Vec3 half_axes(shape.r1, shape.r2, shape.r3), squares = half_axes.cwiseAbs2();
  Support<double> s;
  s.h = half_axes.cwiseProduct(n).norm();
  const double inverse = 1. / s.h;
  const Vec3 x = squares.cwiseProduct(n) * inverse, rounded = x * inverse;
  s.x1 = x[0];
  s.x2 = x[1];
  s.x3 = x[2];
  s.h11 = squares[0] * inverse - x[0] * rounded[0];
  s.h22 = squares[1] * inverse - x[1] * rounded[1];
  s.h33 = squares[2] * inverse - x[2] * rounded[2];
  s.h12 = -x[0] * rounded[1];
  s.h13 = -x[0] * rounded[2];
  s.h23 = -x[1] * rounded[2];
  return s;
}

} // namespace detail

/// Support function of a superquadric with its gradient and Hessian.
///
/// h(N) = max{N.X : X in the body} is of superquadric form with the dual exponents:
///   a = (r1|N1|)^q1, b = (r2|N2|)^q1, e = (r3|N3|)^q2, h = ((a+b)^(q2/q1) + e)^(1/q2).
/// Worked in logarithms: eight transcendental calls, no overflow for any exponent in (0, 2).
/// @param n1,n2,n3 normal in the body frame; any length > 0, h is homogeneous of degree one.
/// A component that is exactly zero gives the middle of a flat region (X_i = 0) and a large but finite curvature
/// radius.
template <class Real>
Support<Real> support(const SupportShape<Real> &shape, const Real n1, const Real n2, const Real n3)
{
  using math::abs, math::exp, math::log;
  if constexpr (std::is_same_v<Real, double>)
    if (shape.q1 == 2. && shape.q2 == 2.) // spheres on triangles, which are looked at one by one
      return detail::support_of_ellipsoid(shape, {n1, n2, n3});
  const Real tiny(1e-100); // keeps logarithms finite and products of two Hessian entries below overflow
  const Real m1 = abs(n1) + tiny, m2 = abs(n2) + tiny, m3 = abs(n3) + tiny;

  const detail::LogSum<Real> plane(shape.q1 * log(shape.r1 * m1), shape.q1 * log(shape.r2 * m2));
  const detail::LogSum<Real> body(shape.q2_over_q1 * plane.log_sum, shape.q2 * log(shape.r3 * m3));

  Support<Real> s;
  s.h = exp(body.log_sum * shape.one_over_q2);

  const Real w1 = body.share_a * plane.share_a;
  const Real w2 = body.share_a * plane.share_b;
  const Real w3 = body.share_b;
  const Real one(1.);
  const Real r1 = one / m1, r2 = one / m2, r3 = one / m3;
  const Real i1 = n1 * r1 * r1, i2 = n2 * r2 * r2, i3 = n3 * r3 * r3; // 1/n, and 0 at n = 0
  s.x1 = s.h * w1 * i1;
  s.x2 = s.h * w2 * i2;
  s.x3 = s.h * w3 * i3;

  const Real k1 = shape.q1 - one, k2 = shape.q2 - one, k12 = shape.q2 - shape.q1;
  s.h11 = s.h * w1 * (r1 * r1) * (k1 + k12 * plane.share_a - k2 * w1);
  s.h22 = s.h * w2 * (r2 * r2) * (k1 + k12 * plane.share_b - k2 * w2);
  s.h33 = s.h * w3 * (r3 * r3) * k2 * body.share_a;
  s.h12 = s.x1 * i2 * (k12 * plane.share_b - k2 * w2);
  s.h13 = -s.x1 * i3 * k2 * w3;
  s.h23 = -s.x2 * i3 * k2 * w3;
  return s;
}

} // namespace bergamo::dem
