#pragma once

#include "dem/core/types.h"

#include <cstdint>
#include <span>

namespace bergamo::dem
{

/// Lacey's index of how well grains of two kinds are mixed (Lacey 1954), by the variance of the share p of the first
/// kind over the cells of a cubic grid, each with the weight of its grains: (s0^2 - s^2) / (s0^2 - sr^2). s0^2 = p (1 -
/// p) is that of grains apart, sr^2 = p (1 - p) (K - 1) / (N - 1) the mean over all ways to deal out N grains to the
/// places of K cells: so 0 where each cell holds one kind alone, and 1 on average for a random mixture, whatever the
/// numbers in the cells.
/// @param position of each grain [m]; @param is_first whether it is of the first kind, of the same length
/// @param cell edge of the grid's cells, one of whose corners is the origin [m]
/// Throws ConfigError for an edge that is not positive, for grains of one kind alone, and where every cell holds but
/// one grain, which says nothing.
double lacey_index(std::span<const Vec3> position, std::span<const std::uint8_t> is_first, double cell);

} // namespace bergamo::dem
