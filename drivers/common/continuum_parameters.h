#pragma once

#include "drivers/common/parameter_file.h"
#include "fe_dealii/material/mohr_coulomb.h"

namespace bergamo::driver
{

/// Binds the material of a continuum to the section "Continuum": one place for its names, so that what one driver
/// writes another one reads.
void declare_continuum(ParameterFile &file, fe::MohrCoulombParameters &continuum);

} // namespace bergamo::driver
