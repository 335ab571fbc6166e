#pragma once

#include "dem/force/contact_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bergamo::dem
{

/// What is known of two grains apart: a direction that separates them, and how much room is left along it whatever the
/// grains do later. Their centres' motion is seen as it is, so that grains that move together stay apart; of their
/// turns only the angles count.
struct Separation
{
  Vec3 direction = Vec3::Zero(); ///< unit vector from the first to the second; zero for a pair never searched
  double room = -std::numeric_limits<double>::infinity(); ///< gap less what separating_motion() was then [m]

  Separation() = default;

  /// @param gap along the direction at this step [m]
  Separation(const Vec3 &direction, const double gap, const ContactSearch &pair, const ContactScene &scene)
      : direction(direction), room(gap - separating_motion(pair, scene))
  {
  }

  /// Lower bound of the gap by now [m].
  double least_gap(const ContactSearch &pair, const ContactScene &scene) const
  {
    return room + separating_motion(pair, scene);
  }

  /// The same seen from the other body.
  void exchange_bodies() { direction = -direction; }

private:
  /// What has moved the bodies' surfaces apart along the direction, but for a constant [m].
  double separating_motion(const ContactSearch &pair, const ContactScene &scene) const
  {
    const Particles &p = scene.particles;
    const Vec3 branch = p.part_position(pair.second_part) + p.cell.place[pair.image] - p.part_position(pair.first_part);
    return direction.dot(branch) - turning_path(p, pair.first_part) - turning_path(p, pair.second_part);
  }

  /// Bounds what the turns since the start have changed of a part's height above its centre [m]: a turn by an angle
  /// changes it by the angle times the part of the arm beside the normal, whose square is arm^2 - height^2.
  static double turning_path(const Particles &p, const std::int32_t part)
  {
    const Superquadric &shape = p.parts.shape[part];
    const double radius = p.parts.bounding_radius[part];
    // The support function is the norm of (r1 n1, r2 n2, r3 n3) of dual exponents: least for an octahedron.
    const auto share = [](const double exponent) { return exponent > 1. ? std::sqrt(0.5) : 1.; };
    const double height = share(shape.eps1) * share(shape.eps2) * shape.half_axes.minCoeff();
    return p.turned[p.parts.particle[part]] * std::sqrt(std::max(radius * radius - height * height, 0.));
  }
};

} // namespace bergamo::dem
