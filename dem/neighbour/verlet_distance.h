#pragma once

#include "dem/state/particles.h"

namespace bergamo::dem
{

/// Gap up to which two parts are neighbours [m]. @param share of the mean bounding radius of all parts
double verlet_distance_of(const Particles &particles, double share);

} // namespace bergamo::dem
