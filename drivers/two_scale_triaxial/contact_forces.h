#pragma once

#include "dem/simulation/simulation.h"
#include "drivers/two_scale_triaxial/layout.h"

#include <filesystem>

namespace bergamo::driver
{

/// Writes a table of the contacts between grains that both have their centre beyond the continuum, where grains are
/// alone in any run: magnitude of the force [N] and its angle to x, y and z, in [0, 90] degrees. See
/// force_study.py.
void write_contact_forces(const std::filesystem::path &path, const dem::Simulation &grains, const Layout &layout);

} // namespace bergamo::driver
