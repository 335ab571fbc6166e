#pragma once

#include "dem/geometry/contact_geometry.h"

namespace bergamo::dem
{

/// Relative curvature of two surfaces at their contact: half the eigenvalues of the sum of both curvature
/// tensors, a <= b [1/m], and the direction of a: the major axis of the contact ellipse.
/// Replaces the dissertation's angle between principal directions (Wellmann, eq. 3.15, 3.16).
template <class Real>
struct RelativeCurvature
{
  Real a, b;
  Vector3<Real> major_axis;
};

/// Both principal radii of curvature of a surface are bounded to [factor r_min, r_max / factor], r_min and r_max
/// the body's smallest and largest half-axis: a flat spot (radius infinite) or a sharp one (radius 0) would have
/// an infinite or no Hertz force. 0 < factor <= 1; smaller is closer to the ideal shape.
template <class Real>
struct CurvatureBounds
{
  Real smallest_radius; ///< [m]
  Real largest_radius;  ///< [m]
};

template <class Real>
CurvatureBounds<Real> curvature_bounds(const SupportShape<Real> &shape, const double factor)
{
  return {Real(factor) * math::min(math::min(shape.r1, shape.r2), shape.r3),
          math::max(math::max(shape.r1, shape.r2), shape.r3) * Real(1. / factor)};
}

namespace detail
{

/// Symmetric 2x2 tensor in the tangent frame.
template <class Real>
struct Tensor2
{
  Real t11, t22, t12;

  Tensor2 operator+(const Tensor2 &o) const { return {t11 + o.t11, t22 + o.t22, t12 + o.t12}; }
};

/// Eigenvalues low <= high of a symmetric 2x2 tensor and the unit eigenvector (x, y) of low.
template <class Real>
struct Eigen2
{
  Real low, high, x, y;

  explicit Eigen2(const Tensor2<Real> &t)
  {
    using math::select;
    const Real mean = Real(0.5) * (t.t11 + t.t22), half = Real(0.5) * (t.t11 - t.t22);
    const Real radius = math::sqrt(half * half + t.t12 * t.t12);
    low = mean - radius;
    high = mean + radius;
    // Of the two equivalent rows take the one that does not cancel.
    const auto is_first = half > Real(0.);
    x = select(is_first, Real(-t.t12), Real(radius - half));
    y = select(is_first, Real(half + radius), Real(-t.t12));
    const Real length = math::sqrt(x * x + y * y);
    const auto is_round = !(length > Real(0.));
    x = select(is_round, Real(1.), Real(x / length));
    y = select(is_round, Real(0.), Real(y / length));
  }
};

} // namespace detail

/// Principal radii of a surface, low <= high [m], and the direction (x, y) of low in the tangent frame.
template <class Real>
struct PrincipalRadii
{
  Real low, high, x, y;

  /// @param radii in that frame
  explicit PrincipalRadii(const CurvatureRadii<Real> &radii)
  {
    // Radii of flat faces would overflow when squared; their directions stay.
    const Real size = math::max(math::max(math::abs(radii.r11), math::abs(radii.r22)), math::abs(radii.r12));
    const Real scale = Real(1.) / math::max(size, Real(1e-150));
    const detail::Eigen2<Real> e(detail::Tensor2<Real>{radii.r11 * scale, radii.r22 * scale, radii.r12 * scale});
    low = e.low * size;
    high = e.high * size;
    x = e.x;
    y = e.y;
  }
};

/// Of a body's surface. Where one radius is huge the tensor says nothing of the other one, up to 1e-4 half-axes: there
/// rounding would decide it, and it is taken from the body's own axes instead.
/// @param normal of the contact; @param radii in tangent_frame(normal)
template <class Real>
PrincipalRadii<Real> principal_radii(const Pose<Real> &body, const Vector3<Real> &normal,
                                     const CurvatureRadii<Real> &radii)
{
  constexpr double needle = 1e6; // ratio of the radii up to which the tensor gives the smaller one to 1e-9
  PrincipalRadii<Real> principal(radii);
  const math::Mask<Real> is_needle = principal.high > Real(needle) * math::abs(principal.low);
  if (math::any(is_needle)) // seldom
    principal.low = math::select(is_needle, Real(product_of_radii(body, normal) / principal.high), principal.low);
  return principal;
}

namespace detail
{

template <class Real>
Tensor2<Real> bounded_curvature(const PrincipalRadii<Real> &radii, const CurvatureBounds<Real> &bounds)
{
  const Real one(1.);
  const Real low = one / math::clamp(radii.low, bounds.smallest_radius, bounds.largest_radius);
  const Real high = one / math::clamp(radii.high, bounds.smallest_radius, bounds.largest_radius);
  const Real difference = low - high;
  return {high + difference * radii.x * radii.x, high + difference * radii.y * radii.y, difference * radii.x * radii.y};
}

template <class Real>
RelativeCurvature<Real> from_sum(const TangentFrameOf<Real> &frame, const Tensor2<Real> &curvature)
{
  const Eigen2<Real> e(curvature);
  return {Real(0.5) * e.low, Real(0.5) * e.high, frame.col(0) * e.x + frame.col(1) * e.y};
}

} // namespace detail

/// @param frame tangent frame of the contact normal, in which the radii stand
template <class Real>
RelativeCurvature<Real> relative_curvature(const TangentFrameOf<Real> &frame, const PrincipalRadii<Real> &radii1,
                                           const CurvatureBounds<Real> &bounds1, const PrincipalRadii<Real> &radii2,
                                           const CurvatureBounds<Real> &bounds2)
{
  return detail::from_sum(frame,
                          detail::bounded_curvature(radii1, bounds1) + detail::bounded_curvature(radii2, bounds2));
}

/// As above against a plane, whose curvature is zero.
template <class Real>
RelativeCurvature<Real> relative_curvature(const TangentFrameOf<Real> &frame, const PrincipalRadii<Real> &radii,
                                           const CurvatureBounds<Real> &bounds)
{
  return detail::from_sum(frame, detail::bounded_curvature(radii, bounds));
}

} // namespace bergamo::dem
