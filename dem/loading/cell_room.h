#pragma once

#include "dem/state/particles.h"

namespace bergamo::dem
{

/// What the edges of a cubic cell have to exceed before its compression, so that grains meet one image of one another
/// all the way [m]: two ranges of the random addition (see PackingSpace::require_range()), and least_cell_edge() still
/// when the packing is as dense as packings get.
/// @param solid_fraction before the compression; @param verlet_share see verlet_distance_of()
double least_uncompressed_edge(const Particles &grains, double solid_fraction, double verlet_share);

} // namespace bergamo::dem
