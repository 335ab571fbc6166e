#pragma once

#include "dem/geometry/superquadric.h"

#include <vector>

namespace bergamo::dem
{

/// One of the superquadrics of a clump, placed in the clump's frame.
struct ClumpPart
{
  Superquadric shape;
  Vec3 position = Vec3::Zero();                    ///< centre [m]
  Quaternion orientation = Quaternion::Identity(); ///< part to clump; made unit where it is used
};

/// A rigid body of several superquadrics. Parts may overlap: the body is their union. They may also be apart.
struct ClumpShape
{
  std::vector<ClumpPart> parts;

  /// Throws ConfigError for no parts, an impossible shape, or a place or orientation that is no number.
  void validate() const;
};

/// Whether a point lies in the body or on its surface. @param point in the clump's frame [m]
bool contains(const ClumpShape &clump, const Vec3 &point);

/// Radius of a sphere about the origin of the clump's frame that contains the body, the smallest one for a single part
/// whose centre is there [m].
double bounding_radius(const ClumpShape &clump);

/// The same body in another frame. @param origin of the new frame in the old one [m]; @param orientation unit
/// quaternion, new frame to old one
ClumpShape in_frame(const ClumpShape &clump, const Vec3 &origin, const Quaternion &orientation);

} // namespace bergamo::dem
