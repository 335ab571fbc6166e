#pragma once

#include "dem/packing/distribution.h"
#include "dem/simulation/simulation.h"
#include "drivers/common/parameter_file.h"

#include <string>

namespace bergamo::driver
{

/// Binds sizes and shapes of a sand to a section: one place for their names.
void declare_distribution(ParameterFile &file, const std::string &section, dem::GrainDistribution &distribution);

/// Binds the grains' mineral, damping, curvature bound and Verlet distance to the section "Grains".
void declare_grains(ParameterFile &file, dem::SimulationParameters &simulation);

/// Binds the tolerance of the overlap between two searches of a contact.
void declare_overlap_tolerance(ParameterFile &file, const std::string &section, double &tolerance);

} // namespace bergamo::driver
