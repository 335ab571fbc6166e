#include "dem/geometry/clump.h"

#include "dem/core/error.h"
#include "dem/geometry/orientation.h"

#include <algorithm>

namespace bergamo::dem
{

void ClumpShape::validate() const
{
  require(!parts.empty(), "number of parts of a clump", static_cast<double>(parts.size()), "at least 1");
  for (const ClumpPart &part : parts)
  {
    part.shape.validate();
    require_finite(part.position, "place of a clump's part");
    require(part.position.cwiseAbs().maxCoeff() <= shape_limits::largest_half_axis, "place of a clump's part",
            part.position.cwiseAbs().maxCoeff(), "in [-1e30, 1e30] m");
    unit_orientation(part.orientation);
  }
}

bool contains(const ClumpShape &clump, const Vec3 &point)
{
  return std::any_of(clump.parts.begin(), clump.parts.end(),
                     [&](const ClumpPart &part)
                     {
                       const Vec3 arm = part.orientation.normalized().conjugate() * (point - part.position);
                       return inside_outside(part.shape, arm) <= 1.;
                     });
}

double bounding_radius(const ClumpShape &clump)
{
  double radius = 0.;
  for (const ClumpPart &part : clump.parts)
    radius = std::max(radius, part.position.norm() + bounding_radius(part.shape));
  return radius;
}

ClumpShape in_frame(const ClumpShape &clump, const Vec3 &origin, const Quaternion &orientation)
{
  ClumpShape moved = clump;
  const Quaternion back = orientation.conjugate();
  for (ClumpPart &part : moved.parts)
  {
    part.position = back * (part.position - origin);
    part.orientation = back * part.orientation.normalized();
  }
  return moved;
}

} // namespace bergamo::dem
