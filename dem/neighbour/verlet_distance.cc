#include "dem/neighbour/verlet_distance.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace bergamo::dem
{

double verlet_distance_of(const Particles &particles, const double share)
{
  std::vector<double> radii = particles.parts.bounding_radius;
  std::sort(radii.begin(), radii.end()); // so that the sum does not depend on the grains' order
  return share * std::accumulate(radii.begin(), radii.end(), 0.) / static_cast<double>(radii.size());
}

} // namespace bergamo::dem
