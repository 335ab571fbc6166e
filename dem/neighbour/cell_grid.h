#pragma once

#include "dem/core/types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Uniform grid of cubic cells over the particles' centres; particles of a cell in ascending order.
struct CellGrid
{
  /// @param cell_size edge of a cell [m], > 0; enlarged where the box would need more than a few cells per particle.
  CellGrid(std::span<const Vec3> positions, double cell_size);

  int n[3];                        ///< cells per direction
  std::vector<std::int32_t> begin; ///< begin[cell] .. begin[cell + 1] in particles
  std::vector<std::int32_t> particles;
  std::vector<std::int32_t> cell_of;
};

/// Order in which the particles lie cell by cell: order[new] = old. Neighbours in space become neighbours in memory.
/// Within a cell by x, then y, then z: the order in which the particles came does not matter, but for two in one place.
std::vector<std::int32_t> spatial_order(std::span<const Vec3> positions, double cell_size);

/// new_index[old] for order[new] = old.
std::vector<std::int32_t> inverse_order(std::span<const std::int32_t> order);

} // namespace bergamo::dem
