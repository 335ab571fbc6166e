#pragma once

#include "dem/simulation/simulation.h"

#include <vector>

namespace bergamo::driver
{

/// Lets grains give way among others that stay where they are. Grains that were taken along by a strain of the ground
/// as if they were of it overlap by that strain; here they slide and turn until what their neighbours bear is left.
/// They creep, brought to rest again and again, under the gravity and with the friction of the parameters.
/// @param fixed those about them; @param walls about both
/// @return the grains in their order, at rest
dem::Particles fit_in(const dem::Particles &grains, const dem::Particles &fixed,
                      const std::vector<dem::PlaneWall> &walls, const dem::SimulationParameters &parameters);

} // namespace bergamo::driver
