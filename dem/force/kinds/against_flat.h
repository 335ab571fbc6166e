#pragma once

#include "dem/force/contact_search.h"
#include "dem/force/pair_motion.h"

/// Contacts of parts with what has no curvature of its own: planes, and the features of surfaces.
namespace bergamo::dem
{

/// Rigid motion of a grain against a wall since the last step, as PairMotion.
template <class Real>
struct WallMotion
{
  Vector3<Real> velocity; ///< of the wall at the contact minus the grain's [m/s]
  Vector3<Real> spin;     ///< of the grain [1/s]
  double time_step;

  /// @param point contact point minus the grain's centre [m]
  Vector3<Real> displacement(const Vector3<Real> &point) const
  {
    return (velocity - spin.cross(point)) * Real(time_step);
  }

  /// As PairMotion::turn(): the plane's radii are infinite, so the normal is that of the plane.
  ContactTurn<Real> turn(const ContactState<Real> &s, const TangentFrameOf<Real> &frame) const
  {
    const Real half(0.5);
    const Vector3<Real> rotation = spin * Real(time_step), of_arm = rotation.cross(s.point);
    const Vector3<Real> at_old_point = velocity * Real(time_step) - of_arm;
    const Vector2<Real> about = in_frame(frame, rotation), roll(about[1], -about[0]); // rotation x normal
    ContactTurn<Real> turn;
    turn.tilt = {Real(0.), Real(0.)};
    turn.spin = half * s.normal.dot(rotation); // the mean of both bodies
    turn.shift = of_arm - from_frame<Real>(frame, s.radii1 * roll) + s.normal * (half * s.normal.dot(at_old_point));
    turn.wear = math::sqrt(squared_wear(s.wear1, roll)) + s.twist_wear * math::abs(turn.spin);
    const Vector3<Real> displacement = at_old_point - rotation.cross(turn.shift) * half;
    Vector3<Real> seen;
    seen << in_frame(frame, displacement), s.normal.dot(displacement);
    turn.motion = seen_halfway<Real>(turn.tilt, turn.spin, seen);
    return turn;
  }
};

/// Where a part is deepest in what it touches.
struct FlatPlace
{
  Vec3 normal;    ///< unit, from the part to what it touches
  double overlap; ///< [m], > 0
  double weight;  ///< of the contact
};

/// A part's place in space.
BodyPose pose_of(const Particles &particles, std::int32_t part, std::int32_t particle);

/// Gives a contact its place and brings it to this step.
/// @param[in,out] s with the state of last step, or ContactState::begin()
void take_flat_place(ContactSearch &search, const ContactScene &scene, const FlatPlace &place,
                     const WallMotion<double> &motion, ContactState<double> &s, ContactLosses &losses);

} // namespace bergamo::dem
