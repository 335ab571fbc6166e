#pragma once

#include "dem/measure/inertial_number.h"
#include "dem/simulation/simulation_parameters.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/grading_parameters.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "fe_dealii/material/ogden.h"

#include <cstdint>
#include <string>

namespace bergamo::driver
{

/// The rubber around the sample: one ring of elements above the other.
struct MembraneParameters
{
  MembraneParameters();

  unsigned int n_around = 16, n_high = 12; ///< elements
  double thickness = 0.3e-3;               ///< [m]
  fe::OgdenParameters rubber;
  double contact_modulus = 1e9; ///< of its skin in Hertz's law [Pa]
  double friction = 0.2;        ///< of grains on it

  void declare_surface(ParameterFile &file); ///< what a sample in the mould has of it
  void declare_rubber(ParameterFile &file);  ///< the rest
};

/// The rigid cylinder in which the sample is made: packed, and shrunk until the grains bear a pressure.
struct MouldParameters
{
  double diameter = 0.042, height = 0.084; ///< of the loose packing [m]
  double solid_fraction = 0.45;            ///< of the loose packing
  std::uint64_t seed = 1;
  double friction = 0.;      ///< between grains while it shrinks; its walls are smooth
  double pressure = 1e3;     ///< at which it ends [Pa]
  double largest_rate = 20.; ///< of its shrinking [1/s]
  double pressure_tolerance = 0.1;
  double force_tolerance = 0.25; ///< mean unbalanced over mean contact force at its end
  double time_step = 2e-6;       ///< [s]
  double longest_time = 1.;      ///< [s]

  void declare(ParameterFile &file);
};

/// Everything that steers a triaxial test in a membrane. SI units, compression positive.
struct MembraneTriaxialParameters
{
  MembraneTriaxialParameters();

  GradingParameters sizes;
  dem::SimulationParameters simulation; ///< of the test, without the membrane's material
  MouldParameters mould;
  MembraneParameters membrane;

  std::string sample; ///< file of a sample that an earlier run has made, or empty

  double gravity = 9.81;            ///< [m/s²]
  double pressure = 100e3;          ///< of the air around the membrane [Pa]
  double loading_time = 5e-3;       ///< over which it grows from that of the mould [s]
  double pressure_tolerance = 0.01; ///< of the plates at the end of the loading
  double force_tolerance = 0.02;    ///< see MouldParameters
  double longest_loading = 0.2;     ///< [s]
  double inertial_number = 1e-3;    ///< of the compression
  double axial_strain = 0.12;       ///< at the end
  double start_strain = 5e-4;       ///< over which the plates come to their speed
  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  /// Warnings of values that are unwise beside others.
  std::vector<std::string> advice() const;

  dem::SimulationParameters shrinking() const; ///< both with the membrane's material, see membrane_material
  dem::SimulationParameters testing() const;

  /// All that a sample depends on, as a parameter file has it.
  std::string sample_text() const;

  double pressure_at(double time) const; ///< time since the loading began [s]; [Pa]

  /// Of the compression. @{
  double strain_rate(const dem::MeanGrain &grain) const;          ///< [1/s]
  double duration(const dem::MeanGrain &grain) const;             ///< [s]
  double rate_at(double time, const dem::MeanGrain &grain) const; ///< time since it began [s]; [1/s]
  std::int64_t n_steps(const dem::MeanGrain &grain) const;
  /// @}

private:
  void declare_sample(ParameterFile &file);
  double smallest_radius() const; ///< of the grains, nearly [m]
  void require_stable(double time_step, const char *name) const;
};

/// Number of the membrane's material among those of the grains.
inline constexpr std::int32_t membrane_material = 2;

} // namespace bergamo::driver
