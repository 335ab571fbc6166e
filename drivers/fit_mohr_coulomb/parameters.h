#pragma once

#include "drivers/common/forecast/forecast.h"
#include "drivers/common/parameter_file.h"
#include "drivers/fit_mohr_coulomb/fit.h"

#include <string>
#include <vector>

namespace bergamo::driver
{

/// Which samples of an ensemble are fitted. An empty list takes all.
struct SampleChoice
{
  std::vector<double> edges;                ///< of the cells [m]
  std::vector<double> generation_frictions; ///< of the packings
  std::vector<double> pressures;            ///< confining [Pa]
};

enum class CohesionSource
{
  given,
  common_tangent
};

enum class StiffnessLaw
{
  constant, ///< the mean modulus at any pressure
  power     ///< E = E_r (p / p_r)^m
};

/// What steers the fit of the law of sand (hypoplasticity), which stands for all densities at once.
struct SandFitParameters
{
  bool is_wanted = false;
  double loosest_over_critical = 1.15; ///< e_i0 / e_c0
  double densest_void_ratio = 0;       ///< e_d0; 0: it is fitted
  double compression_from = 0.1;       ///< share of the confining pressure from which the compression counts
};

/// Everything that steers the fit. SI units.
struct FitParameters
{
  std::string ensemble = "results/rve_triaxial"; ///< folder
  SampleChoice choice;
  FitWindows windows;
  std::vector<double> young_pressures; ///< those whose samples give Young's modulus [Pa]; empty: all
  StiffnessLaw stiffness_law = StiffnessLaw::constant;
  double reference_pressure = 100e3; ///< p_r of the power law [Pa]
  CohesionSource cohesion_source = CohesionSource::given;
  double cohesion = 15;             ///< [Pa], where it is given
  double grain_density = 2650.;     ///< [kg/m3]
  bool hardening_is_wanted = false; ///< whether the continuum's friction hardens, see fit_hardening()
  SandFitParameters sand;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together.
  void validate() const { windows.validate(); }

  /// What a run will be, for --dry-run.
  Forecast forecast() const;
};

/// Whether a list takes a value: empty lists take all; numbers are equal to 1e-6 of their size.
bool takes(const std::vector<double> &list, double value);

} // namespace bergamo::driver
