#pragma once

#include "dem/geometry/contact_geometry.h"

namespace bergamo::dem
{

/// Relative change of the radii of curvature of a body's surface over a radian of its normal, about an upper bound.
/// In the plane they are R = (q - 1) (r1 r2)^q (n1 n2)^(q - 2) / h^(2 q - 1), so that
///   d ln R = (q - 2) (n2 / n1 - n1 / n2) - (2 q - 1) x.t / h,
/// x.t the part of the arm beside the normal; in space the exponents of both planes add up.
/// @param normal unit vector, global, of either sign; @param arm surface point minus centre [m]
template <class Real>
Real radii_change(const Pose<Real> &body, const Vector3<Real> &normal, const Vector3<Real> &arm)
{
  const Real least(0.3);   // of a round body: no budget lasts for ever
  const Real tiny(1e-100); // keeps the inverse finite
  const auto inverse = [&](const Real &n) -> Real { return Real(1.) / math::max(math::abs(n), tiny); };
  const Vector3<Real> n = turn_back(body.rotation, normal);
  const Real along = arm.dot(normal), beside = math::sqrt((arm - normal * along).squaredNorm());
  const Real &q1 = body.shape.q1, &q2 = body.shape.q2;
  const Real from_pole = math::sqrt(n[0] * n[0] + n[1] * n[1]);
  return least + (Real(2.) * math::max(q1, q2) - Real(1.)) * beside / math::abs(along) +
         math::abs(q1 - Real(2.)) * (inverse(n[0]) + inverse(n[1])) +
         math::abs(q2 - Real(2.)) * (inverse(n[2]) + inverse(from_pole));
}

/// Inverse of the turn of the normal relative to a body [1/rad] after which a contact followed with the radii held may
/// have an error of a share of its overlap: R kappa theta^3 / 6, with kappa the relative change of the radii; and no
/// more than 3 % of the radii may be gone. Turns of both bodies add up.
/// @param change radii_change(); @param radii of the body; @param error allowed [m], > 0
template <class Real>
Real turn_wear(const Real &change, const CurvatureRadii<Real> &radii, const Real &error)
{
  constexpr double largest_change = 0.03;
  const Real cube = radii.norm() * change / (Real(6.) * error);
  return math::max(math::exp(math::log(cube) * Real(1. / 3.)), change * Real(1. / largest_change));
}

} // namespace bergamo::dem
