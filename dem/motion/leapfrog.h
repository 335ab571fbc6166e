#pragma once

#include "dem/state/particles.h"

#include <functional>

namespace bergamo::dem
{

/// One leapfrog step of all grains: kick, turn and drift (Wellmann 3.32-3.44). Velocities go from the half step before
/// to the half step after, places and orientations to the next step.
/// @param gravity [m/s^2]; @param time_step [s]
/// @param before called as before(begin, end) for all grains once, a few at a time, just before these move: what it
/// writes of them is then still in the core's own cache
/// @return false if any state would not be finite any more; such grains stay, with those beside them, at the old step
bool advance(Particles &particles, const Vec3 &gravity, double time_step,
             const std::function<void(std::size_t begin, std::size_t end)> &before = {});

} // namespace bergamo::dem
