#pragma once

#include "dem/state/particles.h"

namespace bergamo::dem
{

/// The highest point of any grain, along z [m]; minus infinity without grains.
double highest_point(const Particles &grains);

/// Of all grains but fixed ones [m]; the origin without any.
Vec3 centre_of_mass(const Particles &grains);

} // namespace bergamo::dem
