#pragma once

#include "dem/force/kinds/against_flat.h"

namespace bergamo::dem
{

/// What makes a contact due, and no more: it has been followed well, however far beyond its face.
inline constexpr double all_of_budget = 1.5;

/// As WallMotion, of a part against features that turn, and that are flat in all directions (faces), in one (edges) or
/// in none (vertices), elsewhere sharp; WallMotion is the case of a face that does not turn, at half the cost. What the
/// deepest point has come nearer to the borders of its face since the last search wears, too.
template <class Real>
struct FeatureMotion : WallMotion<Real>
{
  Vector3<Real> feature_spin; ///< [1/s]
  Vector3<Real> edge;         ///< unit vector along an edge
  Real is_face, is_edge;      ///< 1 or 0

  /// As PairMotion::turn(). With R2 of the feature infinite where it is flat and 0 where it is sharp, (R1 + R2) dn =
  /// u + R1 (a1 x n) + R2 (a2 x n) has the normal turn with the feature in flat directions, and in sharp ones as R1
  /// asks.
  ContactTurn<Real> turn(const ContactState<Real> &s, const TangentFrameOf<Real> &frame) const
  {
    const Real dt(this->time_step), half(0.5);
    const Vector3<Real> turn1 = this->spin * dt, turn2 = feature_spin * dt, of_arm = turn1.cross(s.point);
    const Vector3<Real> at_old_point = this->velocity * dt - of_arm;
    const Vector2<Real> about1 = in_frame(frame, turn1), about2 = in_frame(frame, turn2);
    const Real about_normal1 = s.normal.dot(turn1), about_normal2 = s.normal.dot(turn2);
    const Vector2<Real> roll1(about1[1], -about1[0]), roll2(about2[1], -about2[0]); // turn x normal
    const Vector2<Real> along = in_frame(frame, edge), across(-along[1], along[0]);
    const Vector2<Real> flat_tilt = roll2 * is_face + along * (along.dot(roll2) * is_edge);
    const Vector2<Real> asked = in_frame(frame, at_old_point) + s.radii1 * (roll1 - flat_tilt);
    const Vector2<Real> of_edge =
        across * (across.dot(asked) / math::select(is_edge > Real(0.), across.dot(s.radii1 * across), Real(1.)));

    ContactTurn<Real> turn;
    const math::Mask<Real> is_vertex = is_face + is_edge < Real(0.5);
    const Vector2<Real> none(Real(0.), Real(0.)),
        of_vertex = math::select<Real>(is_vertex, s.radii1.solve(asked), none);
    turn.tilt = flat_tilt + of_edge * is_edge + of_vertex;
    turn.spin = half * (about_normal1 + about_normal2);
    const Vector2<Real> of_body1 = turn.tilt - roll1;
    turn.shift = of_arm + from_frame<Real>(frame, s.radii1 * of_body1) + s.normal * (half * s.normal.dot(at_old_point));
    const Vector2<Real> slip = in_frame(frame, Vector3<Real>(turn.shift - this->velocity * dt));
    turn.wear = math::sqrt(squared_wear(s.wear1, of_body1)) +
                s.twist_wear * math::abs(half * (about_normal2 - about_normal1)) +
                math::min(Real(math::sqrt(slip.squaredNorm()) * s.radii2.r11), Real(all_of_budget));
    const Vector3<Real> displacement = at_old_point + (turn2 - turn1).cross(turn.shift) * half;
    Vector3<Real> seen;
    seen << in_frame(frame, displacement), s.normal.dot(displacement);
    turn.motion = seen_halfway<Real>(turn.tilt, turn.spin, seen);
    return turn;
  }
};

} // namespace bergamo::dem
