#pragma once

#include "drivers/common/summary.h"
#include "drivers/fit_mohr_coulomb/ensemble_fit.h"
#include "drivers/fit_mohr_coulomb/hardening_fit.h"
#include "drivers/fit_mohr_coulomb/sand_fit.h"

#include <string>
#include <vector>

namespace bergamo::driver
{

/// The law of sand beside that of Mohr and Coulomb, on the same tests.
struct LawComparison
{
  std::vector<SandTest> tests;
  SandFit sand;
  std::vector<LawCurves> mohr_coulomb; ///< of the tests
  Misfit mohr_coulomb_misfit;
};

/// The tests that whole laws are fitted to.
std::vector<SandTest> tests_of_laws(const Ensemble &ensemble, const FitParameters &parameters);

/// Fits the law of sand to what the other one was fitted to. Throws ConfigError, see fit_sand().
LawComparison compare_laws(const Ensemble &ensemble, const EnsembleFit &fit, const FitParameters &parameters);

/// Text of sand.prm: the section Continuum of a parameter file, its void ratio and density those of the mean test.
std::string sand_text(const LawComparison &laws, const EnsembleFit &fit, const std::string &ensemble_folder);

/// Text of curves_laws.csv: grains, Mohr–Coulomb and sand by test, the rows of its compression first.
std::string law_table(const LawComparison &laws);

/// Text of sand.json: parameters and the misfit of each law.
std::string laws_json(const LawComparison &laws);

/// Adds the misfit and the parameters of the continuum.
void add_figures(Summary &summary, const HardeningFit &fit);

/// Adds the misfits and the parameters of the sand.
void add_figures(Summary &summary, const LawComparison &laws);

} // namespace bergamo::driver
