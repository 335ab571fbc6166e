#pragma once

#include "coupling/adapter/two_scale_model.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "drivers/overlap_waves/lattice.h"
#include "drivers/overlap_waves/pulse.h"

#include <cstdint>

namespace bergamo::driver
{

enum class ColumnKind
{
  two_scale,
  grains ///< alone
};

/// The end that a pulse is sent from; in a column of grains alone, where that end would be.
enum class PulseSource
{
  grains,
  continuum
};

/// Everything that steers waves through an overlap. SI units; lengths of the column in distances of its grains.
struct WaveParameters
{
  WaveParameters();

  ColumnKind kind = ColumnKind::two_scale;
  unsigned int width = 3;        ///< grains across
  unsigned int element_size = 2; ///< along the column [grains]
  unsigned int overlap_layers = 2;
  coupling::WeightShape weight = coupling::WeightShape::linear;
  double room = 1.15; ///< of either part outside of the overlap, over that of pulse and overlap

  Wave wave = Wave::compression;
  PulseSource source = PulseSource::grains;
  double wave_length = 16.; ///< in the grains [grains]
  unsigned int n_waves = 5; ///< in a pulse
  double amplitude = 1e-3;  ///< of its strain over that of the contacts under the pressure

  double radius = 0.5e-3; ///< of the grains [m]
  double pressure = 1e5;  ///< before the pulse [Pa]
  dem::SimulationParameters simulation;
  coupling::CouplingParameters coupling;
  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  CubicLattice lattice() const { return press_lattice(radius, simulation.grain(), pressure); }

  Pulse pulse() const;

  /// Of the pulse where it comes from: the elements have a dispersion of their own [m/s].
  double source_velocity() const;

  /// Layers of elements in either part outside of the overlap: pulse and overlap fit into it.
  unsigned int part_layers() const;
  unsigned int continuum_layers() const { return part_layers() + overlap_layers; }
  unsigned int all_layers() const { return continuum_layers() + part_layers(); } ///< of the whole column

  double element_height() const { return element_size * lattice().spacing; } ///< [m]

  /// Steps until the pulse has left the overlap.
  std::int64_t n_steps() const;

  const char *model_name() const { return kind == ColumnKind::grains ? "grains" : "two-scale"; }
};

} // namespace bergamo::driver
