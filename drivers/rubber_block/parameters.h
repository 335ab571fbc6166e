#pragma once

#include "dem/packing/space.h"
#include "dem/simulation/simulation_parameters.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/sand_parameters.h"
#include "fe_dealii/material/mooney_rivlin.h"

#include <cstdint>

namespace bergamo::driver
{

enum class BlockElement
{
  quadratic, ///< 27 nodes
  bending,   ///< 8 nodes that bend
  plain      ///< 8 nodes, too stiff in bending
};

/// A block of elements with a groove across its middle, from the bottom up, and a stiffer layer on its top.
struct BlockParameters
{
  BlockParameters();

  Vec3 edges{0.024, 0.012, 0.0096}; ///< along the pull, across it, upright [m]
  BlockElement element = BlockElement::quadratic;
  unsigned int n_along = 20, n_across = 10, n_high = 8;
  unsigned int notch_along = 4, notch_high = 3; ///< of the groove, in elements
  unsigned int top_layers = 2;                  ///< of elements
  unsigned int squares = 2;                     ///< of the contact's triangles along the side of a face
  fe::ElasticParameters top;                    ///< Neo-Hooke
  fe::MooneyRivlinParameters rubber;

  void declare(ParameterFile &file);
  void validate() const;

  double top_area() const { return edges[0] * edges[1]; } ///< [m²]
};

/// Everything that steers a rubber block that is pressed on sand and pulled over it. SI units.
struct RubberBlockParameters
{
  RubberBlockParameters();

  BlockParameters block;
  SandParameters sand;
  dem::SimulationParameters simulation; ///< of the pull, without the block's material
  double restitution = 0.96;            ///< of two mean grains at 1 m/s
  double block_friction = 1.;           ///< between grains and block
  double contact_modulus = 1e9;         ///< of the block's skin in Hertz's law [Pa]

  double gravity = 9.81;        ///< [m/s²]
  double pressure = 250e3;      ///< on the block's top [Pa]
  double loading_time = 1.5e-3; ///< over which it grows [s]
  double holding_time = 0.5e-3; ///< under all of it, before the pull [s]
  double speed = 30. / 3.6;     ///< of the pull [m/s]
  double start_time = 0.2e-3;   ///< over which it grows [s]
  double pull_time = 4.8e-3;    ///< from its begin on [s]
  double start_offset = 0.003;  ///< of the block from the box's rear [m]
  unsigned int n_grain_pictures = 2;
  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  dem::SimulationParameters settling() const;
  dem::SimulationParameters pulling() const; ///< with the block's material, see block_material

  dem::Box box() const { return {Vec3::Zero(), sand.box}; }
  double mean_radius() const; ///< of the grains [m]

  double pull_begin() const { return loading_time + holding_time; } ///< since the block is there [s]
  double end() const { return pull_begin() + pull_time; }           ///< the same [s]
  std::int64_t n_steps() const;

  double pressure_at(double time) const; ///< time since the block is there [s]; [Pa]
  double speed_at(double time) const;    ///< the same; [m/s]
};

/// Number of the block's material among those of the grains.
inline constexpr std::int32_t block_material = 2;

} // namespace bergamo::driver
