#pragma once

#include "coupling/adapter/arlequin_coupling.h"
#include "drivers/common/parameter_file.h"

namespace bergamo::driver
{

/// Binds the coupling of grains and continuum to the section "Coupling".
void declare_coupling(ParameterFile &file, coupling::CouplingParameters &coupling);

} // namespace bergamo::driver
