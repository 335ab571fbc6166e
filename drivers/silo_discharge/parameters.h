#pragma once

#include "dem/measure/hexahedron_grid.h"
#include "dem/packing/pack_grains.h"
#include "dem/simulation/simulation_parameters.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/grading_parameters.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/steady_flow_parameters.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// Everything that steers the discharge of a silo: a box with a slot across the middle of its flat floor. SI units.
/// The origin is the middle of the orifice, x runs across the slot, y along it, z upwards.
struct SiloParameters
{
  SiloParameters();

  double width = 0.1, depth = 0.025;         ///< [m]
  double fill_height = 0.15;                 ///< of the settled grains, if their solid fraction is the expected one [m]
  double triangle_size = 0.0125;             ///< longest leg of the surfaces' triangles [m]
  std::vector<double> orifice_widths{0.016}; ///< one discharge each [m]

  GradingParameters sizes;
  dem::SimulationParameters simulation;
  double friction = 0.162; ///< of grains, walls and floor
  double gravity = 9.81;   ///< downwards [m/s²]

  double packing_solid_fraction = 0.45; ///< from which the grains settle
  double expected_solid_fraction = 0.6; ///< that they settle to
  double filling_damping_ratio = 0.3;   ///< dashpot while they settle, beside what they have
  double rest_share = 1e-3;             ///< of m g d: mean kinetic energy of a grain at rest
  double longest_filling = 5.;          ///< [s]
  std::uint64_t seed = 1;

  double discharge_time = 5.;    ///< at most [s]
  double last_discharged = 1.;   ///< share of the mass after which a discharge ends
  double patience = 0.5;         ///< without a grain that passes, after which it ends [s]
  double outlet_depth = 0.03;    ///< below the floor, where grains are taken away [m]
  double outlet_interval = 5e-3; ///< between two looks for such grains [s]

  SteadyFlowParameters steady;

  double field_height = 0.15; ///< of the grid, above the orifice [m]
  std::array<double, 3> field_cells{20., 1., 24.};
  std::vector<double> profile_heights{0.0273, 0.0873}; ///< [m]

  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  double packing_height() const { return fill_height * expected_solid_fraction / packing_solid_fraction; } ///< [m]

  dem::PackingParameters packing() const;
  dem::HexahedronGrid field_grid() const;

  /// Of the discharge, and of the filling before it.
  /// @{
  dem::SimulationParameters discharge_simulation() const;
  dem::SimulationParameters filling_simulation() const;
  /// @}

  /// "16mm" of the orifice of 0.016 m.
  static std::string orifice_name(double width);

  /// Whether an orifice and the silo's depth are those of Choi et al.
  bool has_choi_orifice() const;
};

} // namespace bergamo::driver
