#pragma once

#include "dem/simulation/simulation_parameters.h"
#include "drivers/brachistochrone/path.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"

#include <string>
#include <vector>

namespace bergamo::driver
{

/// One way of the sphere.
struct SlideSettings
{
  Curve curve;
  int n_facets;

  std::string name() const { return (curve == Curve::plane ? "plane_" : "cycloid_") + std::to_string(n_facets); }
};

/// Everything that steers the slides. SI units.
struct SlideParameters
{
  SlideParameters();

  double run = 0.2;  ///< horizontal, from start to end [m]
  double drop = 0.1; ///< [m]
  std::vector<double> facets{10, 20, 40, 80, 160, 320, 640};

  double radius = 0.01;  ///< [m]
  double friction = 0.;  ///< of sphere and track
  double gravity = 9.81; ///< [m/s²]
  dem::SimulationParameters simulation;
  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  Vec3 end() const { return {run, 0., -drop}; } ///< of the centre's path, which starts at the origin [m]

  /// What speeds the centre up along its path in closed form: a solid sphere that rolls has 2/7 of its energy in the
  /// rotation [m/s²].
  double effective_gravity() const { return friction > 0. ? 5. / 7. * gravity : gravity; }

  /// Both curves with each number of facets.
  std::vector<SlideSettings> slides() const;

  /// Of the simulation, all that is given here included.
  dem::SimulationParameters simulation_parameters() const;
};

} // namespace bergamo::driver
