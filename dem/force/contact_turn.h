#pragma once

#include "dem/core/tangent_frame.h"
#include "dem/force/contact_state.h"

namespace bergamo::dem
{

/// How a contact turns and moves in a step.
///
/// The normal n minimises h1(n) + h2(-n) - n.(x2 - x1) (dem/geometry/contact_geometry.h). With the displacement u of
/// body 2 relative to body 1 at the contact, the rotations a1, a2 of the bodies and the radii R1, R2 of their surfaces
/// less half the overlap, all in the tangent plane, the minimum moves as
///   (R1 + R2) dn = u + R1 (a1 x n) + R2 (a2 x n),
/// the contact point with the bodies and by (R1 (dn - a1 x n) - R2 (dn - a2 x n)) / 2, and the overlap by -n.u exactly:
/// so a followed contact neither makes nor loses energy, whatever its radii. They are held between two searches, which
/// leaves an error of third order in the turn of the normal relative to the bodies (Montana 1988, for rolling).
template <class Real>
struct ContactTurn
{
  Vector2<Real> tilt;  ///< of the normal, in the tangent frame [rad]
  Real spin;           ///< of the tangent frame about the normal: the mean of both bodies [rad]
  Vector3<Real> shift; ///< of the contact point [m]
  Real wear;           ///< of the contact's budget
};

/// Sum of the magnitudes: a bound of the length that takes no root.
template <class Real>
Real magnitude(const Vector2<Real> &v)
{
  return math::abs(v[0]) + math::abs(v[1]);
}

/// Turns that are followed at once: beyond it a contact is searched [rad].
inline constexpr double largest_turn = 0.01;

/// Budgets used up in one step beyond which nothing is followed: with 64 times the error it would say nothing.
inline constexpr double largest_wear = 4.;

/// The displacement as the frame half way between this step's and the last one's sees it.
template <class Real>
ContactMotion<Real, Vector2<Real>> motion_in_frame(const Vector3<Real> &normal, const TangentFrameOf<Real> &frame,
                                                   const ContactTurn<Real> &turn, const Vector3<Real> &displacement)
{
  const Real half(0.5), apart = normal.dot(displacement);
  const Vector2<Real> beside = in_frame(frame, displacement);
  return {-apart - half * turn.tilt.dot(beside),
          beside - (turn.tilt * apart + Vector2<Real>(-beside[1], beside[0]) * turn.spin) * half};
}

/// Turns a contact's normal and axis. Of second order in the step; they stay orthonormal to rounding.
template <class Real>
void turn_frame(ContactState<Real> &s, const TangentFrameOf<Real> &frame, const ContactTurn<Real> &turn)
{
  const Vector2<Real> &tilt = turn.tilt;
  const Real half_spin = Real(0.5) * turn.spin;
  const Vector2<Real> halfway(tilt[0] - half_spin * tilt[1], tilt[1] + half_spin * tilt[0]);
  const Vector3<Real> normal = s.normal + from_frame(frame, halfway);
  const Vector3<Real> axis = s.axis - s.normal * tilt[0] + frame.col(1) * (turn.spin - Real(0.5) * tilt[0] * tilt[1]);
  // Of lengths of nearly one: the series of 1/sqrt(1 + x), whose error is 5 x^3 / 16.
  const auto unit = [](const Vector3<Real> &v) -> Vector3<Real>
  {
    const Real square = v.squaredNorm();
    return v * (Real(1.875) + square * (Real(0.375) * square - Real(1.25)));
  };
  s.normal = unit(normal);
  s.axis = unit(axis - s.normal * s.normal.dot(axis));
}

} // namespace bergamo::dem
