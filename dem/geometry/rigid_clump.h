#pragma once

#include "dem/geometry/clump.h"

#include <vector>

namespace bergamo::dem
{

/// A kind of grain ready to be placed: its parts in the principal frame about the centre of mass. Made once for each
/// kind, since the integrals over overlapping parts take time; scaled() gives the other sizes.
class Clump
{
public:
  /// A clump of one part has that part's frame, and is the plain grain bit for bit.
  /// @param tolerance of mass_properties(). Throws ConfigError as that does.
  explicit Clump(const ClumpShape &shape, double tolerance = 1e-6);

  /// The plain grain. Throws ConfigError for an impossible shape.
  explicit Clump(const Superquadric &shape);

  /// The same body, larger or smaller by a factor > 0. Throws ConfigError where that leaves the limits of shapes.
  Clump scaled(double factor) const;

  const std::vector<ClumpPart> &parts() const { return body.parts; } ///< unit orientations
  double volume() const { return v; }                                ///< of the union of the parts [m^3]
  const Vec3 &inertia_per_density() const { return inertia; }        ///< principal moments [m^5]
  double bounding_radius() const { return radius; }                  ///< about the centre [m]

private:
  ClumpShape body; // in the principal frame
  double v, radius;
  Vec3 inertia;
};

inline double volume(const Clump &clump)
{
  return clump.volume();
}

/// Width of a clump between two planes across a direction [m]. @param direction unit vector in the principal frame
double caliper_width(const Clump &clump, const Vec3 &direction);

} // namespace bergamo::dem
