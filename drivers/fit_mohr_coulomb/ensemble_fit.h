#pragma once

#include "drivers/fit_mohr_coulomb/ensemble.h"
#include "drivers/fit_mohr_coulomb/fit.h"
#include "drivers/fit_mohr_coulomb/statistic.h"
#include "fe_dealii/material/mohr_coulomb.h"

#include <string>
#include <vector>

namespace bergamo::driver
{

/// Means and deviations over some samples.
struct FitStatistics
{
  std::size_t n_samples = 0;
  Statistic young_modulus;  ///< [Pa]
  Statistic poisson_ratio;  ///<
  Statistic friction_angle; ///< [degrees]
  Statistic dilation_angle; ///< [degrees]
  Statistic dilation_rate;  ///< −dεV/dε3
  Statistic peak_stress_ratio;
  Statistic peak_compression;      ///< axial strain
  Statistic peak_axial_pressure;   ///< [Pa]
  Statistic peak_lateral_pressure; ///< [Pa]
  Statistic final_stress_ratio;
  Statistic initial_solid_fraction;
  Statistic critical_solid_fraction;
};

struct PressureFit
{
  double confining_pressure; ///< [Pa]
  FitStatistics statistics;
};

/// Elastic constants with another width of their window.
struct WindowStudy
{
  double axial_strain;
  Statistic young_modulus; ///< [Pa]
  Statistic poisson_ratio;
};

/// E = E_r (p / p_r)^m over the confining pressures.
struct PowerLaw
{
  double modulus;            ///< E_r [Pa]
  double reference_pressure; ///< p_r [Pa]
  double exponent;           ///< m
};

struct EnsembleFit
{
  std::vector<SampleFit> samples; ///< in the ensemble's order
  double cohesion;                ///< [Pa]
  FitStatistics all;              ///< its Young's modulus over the pressures that are to give it
  std::vector<PressureFit> pressures;
  std::vector<WindowStudy> windows;      ///< half, whole and twice the window
  std::optional<PowerLaw> stiffness;     ///< where there are two pressures or more
  std::optional<Tangent> common_tangent; ///< of all circles
  fe::MohrCoulombParameters continuum;   ///< the means, moved into the material's range where they lie outside
  std::vector<std::string> warnings;
};

/// Fits each sample, then the ensemble. Throws ConfigError, naming the sample or the parameter.
EnsembleFit fit_ensemble(const std::vector<Sample> &samples, const FitParameters &parameters);

} // namespace bergamo::driver
