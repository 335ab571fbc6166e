#pragma once

#include "dem/loading/compression.h"
#include "dem/loading/strain_program.h"
#include "drivers/common/parameter_file.h"

namespace bergamo::driver
{

/// Binds the compression of a packing between walls to the section "Packing".
void declare_compression(ParameterFile &file, dem::CompressionParameters &compression);

/// Binds prescribed strains to the section "Loading".
void declare_strain_program(ParameterFile &file, dem::StrainProgram &program);

} // namespace bergamo::driver
