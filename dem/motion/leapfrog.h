#pragma once

#include "dem/state/particles.h"

namespace bergamo::dem
{

/// One leapfrog step of all grains: kick, turn and drift (Wellmann 3.32-3.44). Velocities go from the half step before
/// to the half step after, places and orientations to the next step.
/// @param gravity [m/s^2]; @param time_step [s]
/// @return false if any state would not be finite any more; such grains stay, with those beside them, at the old step
bool advance(Particles &particles, const Vec3 &gravity, double time_step);

} // namespace bergamo::dem
