#pragma once

#include "dem/packing/space.h"
#include "dem/simulation/simulation_parameters.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/intruder.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/sand_parameters.h"

#include <cstdint>

namespace bergamo::driver
{

/// Everything that steers a rigid body that is pressed into sand. SI units.
struct PenetrationParameters
{
  PenetrationParameters();

  IntruderShape intruder; ///< a pile's breadth is the box's, see shape()
  double intruder_friction = 0.1;
  SandParameters sand;
  dem::SimulationParameters simulation; ///< without the intruder's material

  double gravity = 9.81;    ///< [m/s²]
  double depth = 11e-3;     ///< way of the intruder, from where it touches the highest grain [m]
  double speed = 0.05;      ///< [m/s]
  double start_time = 5e-3; ///< over which the speed grows [s]
  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  /// Warnings of values that are unwise beside others.
  std::vector<std::string> advice() const;

  IntruderShape shape() const;
  Intruder make_intruder(double height) const; ///< its lowest point at that height [m]
  dem::Box box() const;                        ///< z = 0 at its bottom, the axis of the intruder in its middle

  dem::SimulationParameters settling() const;
  dem::SimulationParameters penetrating() const; ///< with the intruder's material, see intruder_material

  double end() const { return depth / speed + 0.5 * start_time; } ///< since the intruder is there [s]
  std::int64_t n_steps() const;
  double speed_at(double time) const; ///< time since the intruder is there [s]; downwards [m/s]
};

} // namespace bergamo::driver
