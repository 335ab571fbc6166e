#pragma once

#include "dem/core/types.h"
#include "dem/geometry/surface_topology.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Adds a quadrilateral as two triangles that meet in its shorter diagonal, the first one where both are equal.
/// @param corners nodes around it; @param node places
inline void add_quadrilateral(const std::array<std::int32_t, 4> &corners, const std::span<const Vec3> node,
                              std::vector<Triangle> &triangles)
{
  const auto [a, b, c, d] = corners;
  if ((node[c] - node[a]).squaredNorm() <= (node[d] - node[b]).squaredNorm())
    triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
  else
    triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
}

} // namespace bergamo::dem
