#pragma once

#include "dem/core/pack_vectors.h"
#include "dem/force/contact_search.h"
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

  /// Motion of body 2 relative to body 1 at a contact point, with the arms of the middle of the step [m].
  /// @param point minus the midpoint of the centres [m]
  Vector3<Real> displacement(const Vector3<Real> &point) const
  {
    const Vector3<Real> middle = half_line - velocity * Real(0.25 * time_step);
    return (velocity + spin_difference.cross(point) - spin_sum.cross(middle)) * Real(time_step);
  }

  /// Mean rotation of both bodies about a unit vector [rad].
  Real turn_about(const Vector3<Real> &axis) const { return axis.dot(spin_sum) * Real(0.5 * time_step); }

  /// Bound of the relative motion at a contact with the normal held [m]: the displacement plus both rotations, each
  /// over the given radius, in the norm of the sum of magnitudes, which takes no roots.
  Real bound(const Vector3<Real> &displacement, const Real &radius) const
  {
    Real path(0.), turns(0.);
    for (int d = 0; d < 3; ++d)
    {
      path = path + math::abs(displacement[d]);
      turns = turns + math::max(math::abs(spin_sum[d]), math::abs(spin_difference[d])); // |w1| + |w2|
    }
    return path + radius * turns * Real(time_step);
  }
};

/// Motion of the two particles of one pair.
inline PairMotion<double> motion_of_pair(const ContactSearch &pair, const ContactScene &scene)
{
  return {scene.particles, [&](int) { return pair.first; }, [&](int) { return pair.second; },
          [&](int) { return pair.image; }, scene.time_step};
}

} // namespace bergamo::dem
