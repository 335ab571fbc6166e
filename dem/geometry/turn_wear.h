#pragma once

#include "dem/geometry/contact_geometry.h"

namespace bergamo::dem
{

/// How fast the radii of curvature of a body's surface change where its normal is known. In a plane of the body's axes
/// they are R = (q - 1) (r1 r2)^q (n1 n2)^(q - 2) / h^(2 q - 1), so that over a turn of the normal n towards t
///   d ln R = (q - 2) (t1 / n1 + t2 / n2) - (2 q - 1) x.t / h,
/// x the arm; in space the exponents of both planes add up. Bounded by the magnitudes of all terms.
template <class Real>
class RadiiChange
{
public:
  /// @param normal unit vector, global, of either sign; @param arm surface point minus centre [m]; all by reference
  RadiiChange(const Pose<Real> &body, const Vector3<Real> &normal, const Vector3<Real> &arm)
      : body(body), arm(arm), n(turn_back(body.rotation, normal)), height(math::abs(arm.dot(normal)))
  {
  }

  /// Relative change over a radian. @param towards unit vector beside the normal, of either sign
  Real operator()(const Vector3<Real> &towards) const
  {
    const Real least(0.3);   // of a round body: no budget lasts for ever
    const Real tiny(1e-100); // keeps quotients finite
    const Real one(1.), two(2.);
    const auto share = [&](const Real &change, const Real &of) -> Real
    { return math::abs(change) / math::max(math::abs(of), tiny); };
    const Vector3<Real> t = turn_back(body.rotation, towards);
    const Real &q1 = body.shape.q1, &q2 = body.shape.q2;
    return least + (two * math::max(q1, q2) - one) * share(arm.dot(towards), height) +
           math::abs(q1 - two) * (share(t[0], n[0]) + share(t[1], n[1])) +
           math::abs(q2 - two) * (share(t[2], n[2]) + share(n[0] * t[0] + n[1] * t[1], n[0] * n[0] + n[1] * n[1]));
  }

private:
  const Pose<Real> &body;
  const Vector3<Real> &arm;
  const Vector3<Real> n; // in the body's frame
  const Real height;
};

/// Inverse of the turns [1/rad] after which a contact followed with the radii of a body held may have an error of a
/// share of its overlap. A turn of the normal by theta leaves R kappa theta^3 / 6, with kappa the relative change of
/// the radii; a twist phi about the normal beside it turns the radii and leaves R theta^2 phi / 2 at most. And no more
/// than 3 % of the radii may be gone. Turns of both bodies and in both directions add up by squares, since their cubes
/// do.
template <class Real>
struct TurnWear
{
  Vector2<Real> tilt = {Real(0.), Real(0.)}; ///< towards both axes of the tangent frame
  Real twist = Real(0.);

  TurnWear() = default; ///< of a plane

  /// @param radii of curvature in the tangent frame [m]; @param error allowed [m], > 0
  TurnWear(const RadiiChange<Real> &change, const TangentFrameOf<Real> &frame, const CurvatureRadii<Real> &radii,
           const Real &error)
  {
    constexpr double largest_change = 0.03;
    const auto wear_towards = [&](const int axis, const Real &radius)
    {
      const Real kappa = change(frame.col(axis)), cube = radius * kappa / (Real(6.) * error);
      const Real root = math::exp(math::log(cube) * Real(1. / 3.));
      tilt[axis] = math::max(root, kappa * Real(1. / largest_change));
      twist = math::max(twist, math::max(Real(root / math::max(kappa, Real(1.))), Real(1. / largest_change)));
    };
    wear_towards(0, radii.r11);
    wear_towards(1, radii.r22);
  }
};

} // namespace bergamo::dem
