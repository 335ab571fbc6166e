#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Spheres divided by size. The range of a sphere is its diameter and the Verlet distance: two spheres are near within
/// the mean of their ranges at most.
struct SizeClasses
{
  std::vector<double> range;            ///< of the largest sphere of each class, from the largest class on [m]
  std::vector<std::int32_t> size_class; ///< of each sphere
};

/// Divides so that the search for neighbours takes least work, as it is foreseen: in a class, every sphere looks at as
/// many others as lie in rows that are wide enough for the largest of them; and it looks once at each class of larger
/// spheres. Equal spheres make one class, a single large one among them makes one by itself.
/// @param radii [m], >= 0; @param verlet_distance [m], >= 0
SizeClasses divide_by_size(std::span<const double> radii, double verlet_distance);

} // namespace bergamo::dem
