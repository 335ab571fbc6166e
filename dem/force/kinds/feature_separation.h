#pragma once

#include "dem/force/contact_search.h"
#include "dem/geometry/surface_contact.h"

#include <limits>

namespace bergamo::dem
{

/// What is known of a part apart from a feature of a surface, as Separation knows it of two grains: a direction and how
/// much room is left along it, whatever the part does later and as long as the nodes' paths allow for it.
struct FeatureSeparation
{
  Vec3 direction = Vec3::Zero(); ///< unit, from the feature to the part; zero for a pair never searched
  double room = -std::numeric_limits<double>::infinity(); ///< gap less what separating_motion() was then [m]

  FeatureSeparation() = default;
  FeatureSeparation(const SeparatingDirection &found, const ContactSearch &pair, const ContactScene &scene)
      : direction(found.direction), room(found.gap - separating_motion(pair, scene))
  {
  }

  /// Lower bound of the gap by now [m].
  double least_gap(const ContactSearch &pair, const ContactScene &scene) const
  {
    return room + separating_motion(pair, scene);
  }

private:
  double separating_motion(const ContactSearch &pair, const ContactScene &scene) const
  {
    const Particles &p = scene.particles;
    const double turned_height = p.turned[pair.first] * p.parts.swing[pair.first_part];
    return direction.dot(p.part_position(pair.first_part)) - turned_height - scene.surface_motion;
  }
};

} // namespace bergamo::dem
