#pragma once

#include "dem/packing/space.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Convex polyhedron between planes.
struct Polyhedron
{
  std::vector<Vec3> vertices; ///< [m]
  Vec3 low, high;             ///< bounds [m]
  double volume = 0.;         ///< [m^3]
};

/// What half-spaces with unit normals enclose together. @throws ConfigError where they enclose no volume or do not
/// close
Polyhedron enclosed_by(std::span<const HalfSpace> planes);

} // namespace bergamo::dem
