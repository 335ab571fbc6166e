#include "drivers/brachistochrone/track.h"

#include <cstdint>
#include <vector>

namespace bergamo::driver
{

dem::Surface make_track(const Path &path, const int n_facets, const double radius)
{
  const auto corner = [&](const int k) { return path.at(static_cast<double>(k) / n_facets); };
  std::vector<Vec3> along, normal; // unit vectors of the facets
  for (int k = 0; k < n_facets; ++k)
  {
    along.push_back((corner(k + 1) - corner(k)).normalized());
    normal.push_back(along.back().cross(Vec3::UnitY()));
  }
  std::vector<Vec3> edge; // middles of those across the track
  edge.push_back(corner(0) - radius * (normal.front() + along.front()));
  for (int k = 1; k < n_facets; ++k)
    edge.push_back(corner(k) - radius * (normal[k - 1] + normal[k]) / (1. + normal[k - 1].dot(normal[k])));
  edge.push_back(corner(n_facets) - radius * (normal.back() - along.back()));

  std::vector<Vec3> nodes;
  for (const Vec3 &middle : edge)
    for (const double side : {-1.5, 1.5})
      nodes.push_back(middle + side * radius * Vec3::UnitY());
  std::vector<dem::Triangle> triangles;
  for (std::int32_t k = 0; k < n_facets; ++k)
  {
    const std::int32_t a = 2 * k, b = a + 1, c = a + 2, d = a + 3;
    triangles.insert(triangles.end(), {{a, c, b}, {b, c, d}});
  }
  return {std::move(nodes), std::move(triangles)};
}

} // namespace bergamo::driver
