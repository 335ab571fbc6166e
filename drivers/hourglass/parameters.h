#pragma once

#include "dem/packing/pack_grains.h"
#include "dem/simulation/simulation_parameters.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/grading_parameters.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/steady_flow_parameters.h"
#include "drivers/hourglass/glass.h"

#include <cstdint>

namespace bergamo::driver
{

/// Everything that steers the hourglass. SI units.
struct HourglassParameters
{
  HourglassParameters();

  GlassShape glass;
  double friction = 0.24; ///< among grains, and of grains and glass
  double gravity = 9.81;  ///< downwards [m/s²]

  GradingParameters sizes;
  dem::SimulationParameters simulation;

  double fill_bottom = 0., fill_height = 14e-3; ///< of the packing, above the neck [m]
  double solid_fraction = 0.5;                  ///< of the packing
  std::uint64_t seed = 1;

  double longest_time = 1.;      ///< [s]
  double last_discharged = 0.95; ///< share of the mass after which the run ends
  double patience = 0.1;         ///< without a grain that passes the neck, after which it ends [s]
  SteadyFlowParameters steady;
  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  dem::PackingParameters packing() const;
  dem::SimulationParameters simulation_parameters() const; ///< all that is given here included
};

} // namespace bergamo::driver
