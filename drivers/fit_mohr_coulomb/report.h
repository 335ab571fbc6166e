#pragma once

#include "drivers/common/summary.h"
#include "drivers/fit_mohr_coulomb/ensemble.h"
#include "drivers/fit_mohr_coulomb/ensemble_fit.h"

#include <string>

namespace bergamo::driver
{

/// Text of fit_mohr_coulomb.json: the figures with mean and deviation, all together, by pressure and by sample. A
/// deviation of one sample alone is null.
std::string fit_json(const Ensemble &ensemble, const EnsembleFit &fit, const FitParameters &parameters);

/// Text of continuum.prm: the section Continuum of a parameter file.
std::string continuum_text(const EnsembleFit &fit, const std::string &ensemble_folder);

/// The grains' mean curves and the continuum's along the same strains, by pressure.
struct CurveTables
{
  std::string grains;    ///< text of curves_grains.csv
  std::string continuum; ///< text of curves_continuum.csv
};
CurveTables curve_tables(const Ensemble &ensemble, const EnsembleFit &fit);

/// Adds the means and deviations.
void add_figures(Summary &summary, const EnsembleFit &fit);

} // namespace bergamo::driver
