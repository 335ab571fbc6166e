#include "dem/measure/extent.h"

#include "dem/geometry/contact_geometry.h"

#include <algorithm>
#include <limits>

namespace bergamo::dem
{

double highest_point(const Particles &grains)
{
  double top = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < grains.parts.size(); ++k)
  {
    const BodyPose pose = make_pose(grains.parts.shape[k], grains.part_position(k), grains.part_orientation(k));
    top = std::max(top, pose.position[2] + support(pose, Vec3::UnitZ()).height);
  }
  return top;
}

Vec3 centre_of_mass(const Particles &grains)
{
  Vec3 sum = Vec3::Zero();
  double mass = 0.;
  for (std::size_t i = 0; i < grains.size(); ++i)
    if (!grains.is_fixed(i))
    {
      sum += grains.mass[i] * grains.position[i];
      mass += grains.mass[i];
    }
  return mass > 0. ? Vec3(sum / mass) : Vec3(Vec3::Zero());
}

} // namespace bergamo::dem
