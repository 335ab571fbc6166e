#pragma once

#include "dem/geometry/contact_geometry.h"

#include <cstdint>
#include <span>

namespace bergamo::dem
{

/// Two grains and the plane between them.
struct GrainGap
{
  std::int32_t first = 0, second = 0;
  Vec3 normal = Vec3::Zero(); ///< unit, from the first to the second, of a plane between them; zero: none known yet
  double width = 0.;          ///< of the gap along the normal, at most; not positive: no plane found [m]
  double height1 = 0., height2 = 0.; ///< of the grains above their centres, towards each other [m]
};

/// Searches the gaps of pairs anew from their normals, in packs. @param poses of all grains;
/// @param centre_lines of the pairs, from the first to the nearest image of the second [m]
void search_gaps(std::span<GrainGap *const> pairs, std::span<const BodyPose> poses, std::span<const Vec3> centre_lines);

} // namespace bergamo::dem
