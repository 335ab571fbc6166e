#pragma once

#include "dem/state/particles.h"

namespace bergamo::dem
{

/// Acceleration beside that of the contacts, linear in the place: constant + gradient * x by components.
struct AccelerationField
{
  Vec3 constant = Vec3::Zero(); ///< [m/s^2]
  Vec3 gradient = Vec3::Zero(); ///< [1/s^2]

  Vec3 at(const Vec3 &x) const { return constant + gradient.cwiseProduct(x); }
};

/// One leapfrog step of all grains: kick, turn and drift (Wellmann 3.32-3.44) in one pass over the memory. Velocities
/// go from the half step before to the half step after, places and orientations to the next step.
/// @param kick between the half steps: the mean of the step before and the step to come [s]
/// @param drift the step to come [s]
/// @return false if any state would not be finite any more; such grains stay, with those beside them, at the old step
bool advance(Particles &particles, const AccelerationField &field, double kick, double drift);

} // namespace bergamo::dem
