#pragma once

#include "drivers/common/forecast/forecast.h"
#include "drivers/common/forecast/grain_trial.h"
#include "drivers/common/sand_parameters.h"

namespace bergamo::fe
{
class MovingBody;
}

namespace bergamo::driver
{

/// Cost of a step over that of the same grains at rest, where they flow or fall, and where they are driven together:
/// contacts begin and end, and are searched anew. As measured of some hundred superquadrics, to half and twice as much.
/// @{
inline constexpr double cost_of_flow = 3.5;
inline constexpr double cost_of_packing = 2;
/// @}

/// Puts the grains of a trial into a forecast, with their memory.
void add_grains(Forecast &forecast, const GrainTrial &trial);

/// The same of a body.
void add_elements(Forecast &forecast, const fe::MovingBody &body);

/// Of grains' surfaces as write_grains_vtu() samples them. @param n_per_quarter steps a quarter turn: 4 or 6
FileForecast grain_pictures(double n_pictures, double n_grains, int n_per_quarter);

FileForecast body_pictures(double n_pictures, const fe::MovingBody &body);

FileForecast contact_pictures(double n_pictures, double n_contacts);

FileForecast table(const std::string &name, double n_rows, double n_columns);

/// How long grains that were driven together usually take to come to rest under a pressure: 0.7 times the time that
/// waves of sqrt(pressure / density) take over them. Of boxes, cylinders and periodic cells of 200 to 2000 grains,
/// within a quarter. @param length the largest of the packing [m]; @param density of the grains [kg/m^3] @return [s]
double usual_rest_time(double length, double pressure, double density);

/// Settled sand as its drivers begin with it.
struct SandForecast
{
  /// @param after the settling, with the material of the grains
  SandForecast(const SandParameters &sand, const dem::SimulationParameters &after);

  GradingParameters sizes;
  GrainTrial trial;
  double seconds_per_step = 0; ///< with all grains
  double stable_step = 0;      ///< under the sand's own weight while it settles [s]
  StageForecast settling;
};

} // namespace bergamo::driver
