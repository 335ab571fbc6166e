#pragma once

#include "dem/core/types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Order of the particles along Hilbert's curve through cells of a grid: order[new] = old. Neighbours in space become
/// neighbours in memory, in all directions alike. Within a cell by x, then y, then z: the order in which the particles
/// came does not matter, but for two in one place. Two million cells in each direction, around the middle grain if the
/// grains need more: what lies further out counts as in the last one. The same on any number of threads.
/// @param positions finite [m]; @param cell_size edge of a cell [m], > 0
std::vector<std::int32_t> spatial_order(std::span<const Vec3> positions, double cell_size);

/// new_index[old] for order[new] = old.
std::vector<std::int32_t> inverse_order(std::span<const std::int32_t> order);

} // namespace bergamo::dem
