#include "dem/loading/cell_room.h"

#include "dem/neighbour/neighbour_watch.h"
#include "dem/neighbour/verlet_distance.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{

double least_uncompressed_edge(const Particles &grains, const double solid_fraction, const double verlet_share)
{
  constexpr double densest = 0.74;
  const double shrinking = std::cbrt(std::min(1., solid_fraction / densest));
  const double largest = *std::max_element(grains.bounding_radius.begin(), grains.bounding_radius.end());
  return std::max(least_cell_edge(grains, verlet_distance_of(grains, verlet_share)) / shrinking, 4. * largest);
}

} // namespace bergamo::dem
