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
  Vector2<Real> tilt;                        ///< of the normal, in the tangent frame [rad]
  Real spin;                                 ///< of the tangent frame about the normal: the mean of both bodies [rad]
  Vector3<Real> shift;                       ///< of the contact point [m]
  Real wear;                                 ///< of the contact's budget
  ContactMotion<Real, Vector2<Real>> motion; ///< in the step
};

/// Square of what a turn of the normal relative to a body uses up of the contact's budget.
template <class Real>
Real squared_wear(const Vector2<Real> &wear, const Vector2<Real> &turn)
{
  const Real x = wear[0] * turn[0], y = wear[1] * turn[1];
  return x * x + y * y;
}

/// Turns that are followed at once: beyond it a contact is searched [rad].
inline constexpr double largest_turn = 0.01;

/// Budgets used up in one step beyond which nothing is followed: with 64 times the error it would say nothing.
inline constexpr double largest_wear = 4.;

/// A contact's tangent frame after its turn, of second order in the step.
template <class Real>
struct TurnedFrame
{
  Vector3<Real> normal, axis;

  TurnedFrame(const Vector3<Real> &old_normal, const TangentFrameOf<Real> &old, const ContactTurn<Real> &turn)
  {
    // a + w x a + w x (w x a) / 2, of a length of 1 to w^4 / 8
    const Real half(0.5), x = turn.tilt[0], y = turn.tilt[1], z = turn.spin;
    normal = old_normal * (Real(1.) - half * (x * x + y * y)) + old.col(0) * (x - half * z * y) +
             old.col(1) * (y + half * z * x);
    axis = old.col(0) * (Real(1.) - half * (x * x + z * z)) + old.col(1) * (z - half * x * y) -
           old_normal * (x + half * z * y);
  }
};

/// What a frame half way between the last step's and this one's sees of a displacement.
/// @param old displacement along the axes of the last step's frame and its normal [m]
template <class Real>
ContactMotion<Real, Vector2<Real>> seen_halfway(const Vector2<Real> &tilt, const Real &spin, const Vector3<Real> &old)
{
  const Real half(0.5);
  const Vector2<Real> beside(old[0], old[1]);
  return {-old[2] - half * tilt.dot(beside),
          beside - (tilt * old[2] + Vector2<Real>(-beside[1], beside[0]) * spin) * half};
}

} // namespace bergamo::dem
