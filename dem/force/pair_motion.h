#pragma once

#include "dem/core/pack_vectors.h"
#include "dem/force/contact_search.h"
#include "dem/force/contact_turn.h"
#include "dem/state/particles.h"

namespace bergamo::dem
{

/// Rigid motion of the two grains of a contact since the last step, global frame.
template <class Real>
struct PairMotion
{
  Vector3<Real> half_line;    ///< half of x2 - x1 at this step [m]
  Vector3<Real> velocity;     ///< v2 - v1 of the drift [m/s]
  Vector3<Real> spin1, spin2; ///< [1/s]
  double time_step;

  /// @param first, second grains of a lane: first(lane), second(lane)
  /// @param image of the second grain: image(lane), see PeriodicCell
  template <class First, class Second, class ImageOf>
  PairMotion(const Particles &p, const First &first, const Second &second, const ImageOf &image, const double time_step)
      : time_step(time_step)
  {
    const auto load = [](const std::vector<Vec3> &values, const auto &index)
    {
      return math::gather_vectors<Real>([&](const int lane) -> const Vec3 & { return values[index(lane)]; });
    };
    half_line = (load(p.position, second) - load(p.position, first)) * Real(0.5);
    velocity = load(p.drift_velocity, second) - load(p.drift_velocity, first);
    spin1 = load(p.angular_velocity, first);
    spin2 = load(p.angular_velocity, second);
    if (!p.cell.is_periodic())
      return;
    const auto load_image = [&](const auto &values)
    {
      return math::gather_vectors<Real>([&](const int lane) -> const Vec3 & { return values[image(lane)]; });
    };
    half_line += load_image(p.cell.place) * Real(0.5);
    velocity += load_image(p.cell.velocity);
  }

  /// Half of x2 - x1 in the middle of the step [m].
  Vector3<Real> middle() const { return half_line - velocity * Real(0.25 * time_step); }

  /// Motion of body 2 relative to body 1 at a contact point [m]. @param point minus the midpoint of the centres [m]
  Vector3<Real> displacement(const Vector3<Real> &point) const
  {
    const Vector3<Real> line = middle();
    return (velocity + spin2.cross(point - line) - spin1.cross(point + line)) * Real(time_step);
  }

  /// Mean rotation of both bodies about a unit vector [rad].
  Real turn_about(const Vector3<Real> &axis) const { return axis.dot(spin1 + spin2) * Real(0.5 * time_step); }

  /// How the contact turns and moves with the step: the common normal of both surfaces, by their curvatures.
  /// @param frame of the last step
  ContactTurn<Real> turn(const ContactState<Real> &s, const TangentFrameOf<Real> &frame) const
  {
    const Real dt(time_step), half(0.5);
    const Vector3<Real> line = middle(), turn1 = spin1 * dt, turn2 = spin2 * dt;
    const Vector3<Real> of_arm1 = turn1.cross(s.point + line), of_arm2 = turn2.cross(s.point - line);
    const Vector3<Real> displacement = velocity * dt + of_arm2 - of_arm1;
    const Vector2<Real> about1 = in_frame(frame, turn1), about2 = in_frame(frame, turn2);
    const Real about_normal1 = s.normal.dot(turn1), about_normal2 = s.normal.dot(turn2);
    const Vector2<Real> roll1(about1[1], -about1[0]), roll2(about2[1], -about2[0]); // turn x normal
    Vector3<Real> seen;
    seen << in_frame(frame, displacement), s.normal.dot(displacement);

    ContactTurn<Real> turn;
    turn.tilt = (s.radii1 + s.radii2).solve(Vector2<Real>(seen[0], seen[1]) + s.radii1 * roll1 + s.radii2 * roll2);
    turn.spin = half * (about_normal1 + about_normal2);
    const Vector2<Real> of_body1 = turn.tilt - roll1, of_body2 = turn.tilt - roll2;
    turn.shift =
        (of_arm1 + of_arm2) * half + from_frame<Real>(frame, (s.radii1 * of_body1 - s.radii2 * of_body2) * half);
    const Real twist = half * (about_normal2 - about_normal1);
    turn.wear =
        math::sqrt(squared_wear(s.wear1, of_body1) + squared_wear(s.wear2, of_body2)) + s.twist_wear * math::abs(twist);
    const Vector3<Real> further = (turn2 - turn1).cross(turn.shift) * half; // at the point of the middle of the step
    seen[0] += frame.col(0).dot(further);
    seen[1] += frame.col(1).dot(further);
    seen[2] += s.normal.dot(further);
    turn.motion = seen_halfway<Real>(turn.tilt, turn.spin, seen);
    return turn;
  }
};

/// Motion of the two particles of one pair.
inline PairMotion<double> motion_of_pair(const ContactSearch &pair, const ContactScene &scene)
{
  return {scene.particles, [&](int) { return pair.first; }, [&](int) { return pair.second; },
          [&](int) { return pair.image; }, scene.time_step};
}

} // namespace bergamo::dem
