#pragma once

#include "dem/force/touching_contact.h"
#include "dem/state/particles.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Mean pressure in every grain from the forces at its contacts, -sum arm . force / 3 V with the arm from the grain's
/// centre and V its own volume, with the contacts' weights; compression positive [Pa]. Pressures times volumes add up
/// to a third of minus the trace of force_moment().
/// @param pairs touching contacts between grains; @param walls with walls and surfaces
std::vector<double> grain_pressures(const Particles &particles, std::span<const TouchingContact> pairs,
                                    std::span<const TouchingContact> walls);

} // namespace bergamo::dem
