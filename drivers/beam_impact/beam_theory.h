#pragma once

#include "drivers/beam_impact/parameters.h"
#include "drivers/beam_impact/trajectory.h"

#include <cstdint>

namespace bergamo::driver
{

/// What a beam is made of in theory.
enum class BeamTheory
{
  slender, ///< plane sections stay normal to the axis (Euler, Bernoulli), as in Timoshenko's solution of the impact
  thick    ///< they shear and have inertia of rotation (Timoshenko 1921), with Cowper's shear coefficient (1966)
};

/// A sphere that hits a beam on simple supports in its middle, by the eigenmodes of the beam and Hertz's law (S.
/// Timoshenko, Zur Frage nach der Wirkung eines Stosses auf einen Balken, Z. Math. Phys. 62, 1913). The equations of
/// the modes are integrated by Dormand and Prince's method to nine digits.
/// @param time_step [s], > 0; @param n_steps of them, after the one at the first touch
Trajectory solve_impact(const ImpactParameters &parameters, BeamTheory theory, double time_step, std::int64_t n_steps);

} // namespace bergamo::driver
