#pragma once

#include "drivers/fit_mohr_coulomb/law_misfit.h"
#include "drivers/fit_mohr_coulomb/parameters.h"
#include "fe_dealii/material/hypoplastic_parameters.h"

#include <vector>

namespace bergamo::driver
{

struct SandFit
{
  fe::HypoplasticParameters sand; ///< its void ratio at the start is the mean of the tests'
  Misfit misfit;
  std::vector<LawCurves> curves; ///< of the tests, in their order
};

/// Least squares of differences() by the method of Levenberg and Marquardt (MINPACK's, in Eigen). Unknown are φ_c, h_s,
/// n, e_c0, α, β and, unless it is given, e_d0; e_i0 follows e_c0. Starts from what Herle and Gudehus (1999) read from
/// the end of the shear, φ_c and e_c0, and from the best of some granulate hardnesses and exponents.
/// Throws ConfigError where the tests are of one density or one pressure alone: they would not tell the parameters.
SandFit fit_sand(const std::vector<SandTest> &tests, const SandFitParameters &parameters);

} // namespace bergamo::driver
