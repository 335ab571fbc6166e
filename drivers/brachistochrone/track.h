#pragma once

#include "dem/state/surface.h"
#include "drivers/brachistochrone/path.h"

namespace bergamo::driver
{

/// Flat facets, each of two triangles, on which the centre of a sphere goes from place to place of a path along
/// straight lines: each lies below one of them, at the sphere's radius. It takes the sphere in closed form the same
/// time for each facet. First and last facet reach further by a radius, and all are three radii wide.
/// @param path it bends upwards, or not at all @param n_facets at least 1 @param radius of the sphere [m]
dem::Surface make_track(const Path &path, int n_facets, double radius);

} // namespace bergamo::driver
