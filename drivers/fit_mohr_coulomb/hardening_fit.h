#pragma once

#include "drivers/fit_mohr_coulomb/law_misfit.h"
#include "fe_dealii/material/mohr_coulomb.h"

#include <vector>

namespace bergamo::driver
{

struct HardeningFit
{
  fe::MohrCoulombParameters continuum;
  Misfit misfit;
};

/// Mohr–Coulomb whose friction is mobilised by plastic strain, nearest to whole curves, see least_misfit(). Unknown are
/// the modulus, its exponent where it depends on the pressure, ν, φ, ψ and the hardening strain; cohesion, initial
/// friction angle and density stay those of `start`, which is what single figures of the curves tell.
HardeningFit fit_hardening(const std::vector<SandTest> &tests, const fe::MohrCoulombParameters &start);

} // namespace bergamo::driver
