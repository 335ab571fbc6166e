#pragma once

#include "dem/state/particles.h"
#include "dem/state/wall.h"

#include <span>

/// What a periodic cell bears beside its grains. All pass without one.
namespace bergamo::dem
{

/// Throws ConfigError naming wall, normal and remedy where a wall stands across a direction in which the cell repeats
/// itself, or where there is a wall and the cell deforms: grains and their images would see it move differently.
void require_walls_fit(const PeriodicCell &cell, std::span<const PlaneWall> walls);

/// Throws ConfigError where gravity acts along a direction in which the cell repeats itself [m/s^2].
void require_gravity_fits(const PeriodicCell &cell, const Vec3 &gravity);

/// Throws ConfigError in a periodic cell: surfaces know no images.
void require_no_cell_of_surfaces(const PeriodicCell &cell);

} // namespace bergamo::dem
