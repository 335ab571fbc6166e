#pragma once

#include "dem/core/archive.h"
#include "dem/simulation/simulation.h"

#include <memory>
#include <string>

namespace bergamo::dem
{

/// Writes everything that a simulation needs to go on with the same bits below the group "dem" of an archive.
void write_simulation(ArchiveWriter &archive, const Simulation &simulation);

/// Makes the simulation that write_simulation() stored. Throws RunError where the archive does not hold one.
/// @param parameters of the run; what Simulation::change() may have altered is taken from the archive
std::unique_ptr<Simulation> read_simulation(const ArchiveReader &archive, const SimulationParameters &parameters);

} // namespace bergamo::dem
