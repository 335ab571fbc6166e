#pragma once

#include "dem/simulation/simulation.h"

#include <filesystem>
#include <memory>
#include <string>

namespace bergamo::python
{

/// Writes a simulation so that it can go on with the same bits, and nothing else is needed for that. The file appears
/// whole or not at all; throws RunError as ArchiveWriter does. @param parameters as text, for readers
void save(const dem::Simulation &simulation, const std::filesystem::path &path, const std::string &parameters);

/// Makes the simulation that save() wrote. Throws RunError as ArchiveReader does, for a snapshot of a driver too: its
/// elastic materials stand in the driver's parameters.
std::unique_ptr<dem::Simulation> load(const std::filesystem::path &path);

} // namespace bergamo::python
