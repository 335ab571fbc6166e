#include "dem/geometry/surface_size.h"

#include "dem/core/error.h"

namespace bergamo::dem
{

double extent_of(const std::span<const Vec3> node)
{
  Vec3 low = node.front(), high = low;
  for (const Vec3 &place : node)
  {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  return (high - low).maxCoeff();
}

void check_size_against_grains(const std::span<const Vec3> node, const GrainSizes &grains,
                               const SurfaceSizeLimits &limits)
{
  require(grains.smallest_radius > 0. && grains.largest_radius >= grains.smallest_radius,
          "smallest radius of the grains beside a surface", grains.smallest_radius,
          "positive, and not above the largest one");
  const double extent = extent_of(node);
  if (extent > limits.largest * grains.largest_radius)
    reject("a surface is ", extent, " m long, ", extent / grains.largest_radius,
           " times the largest grain's radius of ", grains.largest_radius, " m, and ", limits.largest,
           " are allowed: its places may be in another unit; read it with unit = 0.001 if they are millimetres");
  if (!(extent >= limits.smallest * grains.smallest_radius))
    reject("a surface is ", extent, " m long, ", extent / grains.smallest_radius,
           " times the smallest grain's radius of ", grains.smallest_radius, " m, and ", limits.smallest,
           " is the least that is allowed: its places may be in another unit; look at the unit it is read with");
}

} // namespace bergamo::dem
