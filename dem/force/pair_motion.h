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
  Vector3<Real> half_line;                 ///< half of x2 - x1 at this step [m]
  Vector3<Real> velocity;                  ///< v2 - v1 of the drift [m/s]
  Vector3<Real> spin_sum, spin_difference; ///< w1 + w2, w2 - w1 [1/s]
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
    const Vector3<Real> spin1 = load(p.angular_velocity, first), spin2 = load(p.angular_velocity, second);
    spin_sum = spin1 + spin2;
    spin_difference = spin2 - spin1;
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
    return (velocity + spin_difference.cross(point) - spin_sum.cross(middle())) * Real(time_step);
  }

  /// What a step of the point adds to the displacement [m].
  Vector3<Real> displacement_by(const Vector3<Real> &step) const
  {
    return spin_difference.cross(step) * Real(time_step);
  }

  /// Mean rotation of both bodies about a unit vector [rad].
  Real turn_about(const Vector3<Real> &axis) const { return axis.dot(spin_sum) * Real(0.5 * time_step); }

  /// How the contact turns and moves with the step: the common normal of both surfaces, by their curvatures.
  /// @param frame of the last step; @param displacement there
  ContactTurn<Real> turn(const ContactState<Real> &s, const TangentFrameOf<Real> &frame,
                         const Vector3<Real> &displacement) const
  {
    const Real half(0.5 * time_step);
    const Vector2<Real> sum = in_frame<Real>(frame, spin_sum) * half,
                        difference = in_frame<Real>(frame, spin_difference) * half;
    // w x n in the frame
    const Vector2<Real> roll1(sum[1] - difference[1], difference[0] - sum[0]),
        roll2(sum[1] + difference[1], -sum[0] - difference[0]);
    const Vector2<Real> asked = in_frame(frame, displacement) + s.radii1 * roll1 + s.radii2 * roll2;
    const Vector2<Real> tilt = (s.radii1 + s.radii2).solve(asked);
    const Vector2<Real> turn1 = tilt - roll1, turn2 = tilt - roll2;
    const Real twist = math::abs(s.normal.dot(spin_difference) * half);
    const Vector2<Real> beside = (s.radii1 * turn1 - s.radii2 * turn2) * Real(0.5);
    return {tilt, turn_about(s.normal),
            (spin_sum.cross(s.point) - spin_difference.cross(middle())) * half + from_frame(frame, beside),
            s.wear1 * (magnitude(turn1) + twist) + s.wear2 * (magnitude(turn2) + twist)};
  }
};

/// Motion of the two particles of one pair.
inline PairMotion<double> motion_of_pair(const ContactSearch &pair, const ContactScene &scene)
{
  return {scene.particles, [&](int) { return pair.first; }, [&](int) { return pair.second; },
          [&](int) { return pair.image; }, scene.time_step};
}

} // namespace bergamo::dem
