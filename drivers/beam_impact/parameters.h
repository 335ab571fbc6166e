#pragma once

#include "drivers/common/forecast/forecast.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "fe_dealii/material/elastic_parameters.h"

namespace bergamo::driver
{

enum class BeamElement
{
  quadratic, ///< 27 nodes
  bending,   ///< 8 nodes that bend
  plain      ///< 8 nodes, too stiff in bending
};

/// Everything that steers a sphere that hits a beam. SI units.
struct ImpactParameters
{
  ImpactParameters();

  double length = 0.307; ///< of the beam [m]
  double edge = 0.01;    ///< of its square section [m]
  unsigned int n_along = 10, n_across = 1;
  BeamElement element = BeamElement::quadratic;

  double radius = 0.02;   ///< of the sphere [m]
  double velocity = 0.01; ///< with which it hits the beam [m/s]

  fe::ElasticParameters material{.young_modulus = 220e9, .poisson_ratio = 0.3, .density = 7960}; ///< of both

  unsigned int n_modes = 15; ///< of the closed form
  double duration = 2.5e-3;  ///< [s]
  double step_share = 0.8;   ///< of the stable time step
  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  double sphere_mass() const; ///< [kg]

  /// F = stiffness δ^(3/2) between sphere and beam (Hertz 1882) [N/m^1.5].
  double hertz_stiffness() const;
};

} // namespace bergamo::driver
