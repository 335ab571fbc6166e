#pragma once

#include "dem/core/types.h"
#include "dem/state/periodic_cell.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Uniform grid of cells over the particles' centres; particles of a cell in ascending order.
struct CellGrid
{
  /// @param cell_size least edge of a cell [m], > 0; enlarged where the box would need more than a few cells per
  /// particle.
  /// @param period if periodic, the grid's cells fill it
  CellGrid(std::span<const Vec3> positions, double cell_size, const PeriodicCell &period = {});

  int n[3];                        ///< cells per direction
  std::vector<std::int32_t> begin; ///< begin[cell] .. begin[cell + 1] in particles
  std::vector<std::int32_t> particles;
  std::vector<std::int32_t> cell_of;
};

} // namespace bergamo::dem
