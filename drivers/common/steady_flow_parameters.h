#pragma once

#include "dem/measure/mass_flow.h"
#include "drivers/common/parameter_file.h"

namespace bergamo::driver
{

/// Between which shares of the mass a discharge is steady, and how its fluctuation is judged.
struct SteadyFlowParameters
{
  double first_share = 0.1, last_share = 0.4; ///< of the mass that have passed
  int n_windows = 10;                         ///< of equal time

  /// Binds them to the section "Steady flow".
  void declare(ParameterFile &file);

  /// Throws ConfigError. @param end share of the mass at which the discharge ends, by the parameter "Discharge/last
  /// share"
  void validate(double end) const;

  /// @param mass of all [kg]
  dem::MassSpan span(const double mass) const { return {first_share * mass, last_share * mass}; }

  bool contains(const double share) const { return share >= first_share && share <= last_share; }
};

} // namespace bergamo::driver
