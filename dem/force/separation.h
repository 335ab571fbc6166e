#pragma once

#include "dem/force/contact_search.h"

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
    return direction.dot(branch) - turned_height(p, pair.first_part) - turned_height(p, pair.second_part);
  }

  /// Bounds what the turns since the start have changed of a part's height above its centre [m].
  static double turned_height(const Particles &p, const std::int32_t part)
  {
    return p.turned[p.parts.particle[part]] * p.parts.swing[part];
  }
};

} // namespace bergamo::dem
