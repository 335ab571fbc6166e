#pragma once

#include "dem/force/touching_contact.h"
#include "dem/state/material.h"
#include "dem/state/particles.h"

#include <span>

namespace bergamo::dem
{

/// Longest time step for which the leapfrog scheme with its lagged dashpots is stable for the present contacts [s]:
///   lambda_max( M^-1 (K dt^2/4 + C dt/2) ) = 1,
/// K and C the stiffness and damping of all contacts, translations and rotations, found by power iteration.
/// Infinity without contacts. Contacts grow stiffer as they are pressed: leave a margin.
/// @param contacts all that touch, walls included; @param laws by TouchingContact::law
/// @param guess a time step near the answer [s]
double stable_time_step(const Particles &particles, std::span<const TouchingContact> contacts,
                        std::span<const ContactLaw> laws, double guess);

/// That of two equal spheres which oscillate along the line of their centres about an overlap, undamped [s]: what else
/// moves in a packing, and what is pressed together more, is stiffer.
/// @param radius [m]; @param relative_overlap of the contact over the radius
double stable_step_of_two_spheres(double radius, const Material &material, double relative_overlap);

} // namespace bergamo::dem
