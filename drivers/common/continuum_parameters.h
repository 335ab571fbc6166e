#pragma once

#include "drivers/common/parameter_file.h"
#include "fe_dealii/material/mohr_coulomb.h"

#include <string>

namespace bergamo::driver
{

/// Binds the material of a continuum to a section, "Continuum" or that of another layer: one place for its names, so
/// that what one driver writes another one reads.
void declare_continuum(ParameterFile &file, fe::MohrCoulombParameters &continuum,
                       const std::string &section = "Continuum");

} // namespace bergamo::driver
