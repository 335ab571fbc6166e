#pragma once

#include "coupling/adapter/two_scale_model.h"
#include "dem/loading/compression.h"
#include "dem/loading/strain_program.h"
#include "dem/packing/distribution.h"
#include "dem/simulation/simulation.h"
#include "drivers/common/continuum_parameters.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/grading_parameters.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "drivers/two_scale_triaxial/layout.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bergamo::driver
{

enum class ModelKind
{
  two_scale,
  grains,
  continuum
};

enum class Sides
{
  walls,   ///< smooth and rigid, on all six sides
  periodic ///< the specimen repeats itself in all directions
};

/// Everything that steers the two-scale triaxial test. SI units; angles in degrees.
struct TriaxialParameters
{
  TriaxialParameters();

  ModelKind kind = ModelKind::two_scale;
  double edge = 0.01; ///< of the cube [m]
  ElementLayers layers;
  Sides sides = Sides::walls;
  InterfaceShape interface_shape = InterfaceShape::flat;
  coupling::WeightShape weight = coupling::WeightShape::linear;
  bool bending_elements = false; ///< see fe::Hourglass
  bool large_strain = false;     ///< see fe::Kinematics

  dem::GrainDistribution distribution;
  dem::SimulationParameters simulation; ///< of the loading

  double initial_solid_fraction = 0.2;    ///< of the random addition
  double expected_solid_fraction = 0.67;  ///< sets the number of grains
  double tightened_solid_fraction = 0.55; ///< of grains in a periodic cell, before it is compressed
  double packing_friction = 0.15;
  double packing_time_step = 3e-7; ///< [s]
  double packing_overlap_tolerance = 5e-2;
  std::uint64_t seed = 1;
  std::string sample; ///< file of the packing, of an earlier run; empty: one is made
  dem::CompressionParameters compression;

  ContinuumParameters continuum;
  double continuum_damping = 200.; ///< mass-proportional [1/s]
  int steps_per_force = 1;         ///< of the continuum joined to grains, see coupling::Subcycling

  coupling::CouplingParameters coupling;
  dem::StrainProgram program;

  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// What the packing depends on, as text: samples of the same one are alike.
  std::string sample_text() const;

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  /// Warnings of values that are unwise beside others.
  std::vector<std::string> advice() const;

  /// The grains' parameters while they are packed.
  dem::SimulationParameters packing_simulation() const;
  dem::SimulationParameters loading_simulation() const; ///< walls damp as the grains do

  /// Of whole cycles of the continuum; throws ConfigError where they are too many to count.
  std::int64_t loading_steps() const;
  int cycle() const { return kind == ModelKind::two_scale ? steps_per_force : 1; } ///< of the continuum [steps]

  const char *model_name() const ///< as the parameter file has it
  {
    return kind == ModelKind::grains ? "grains" : kind == ModelKind::continuum ? "continuum" : "two-scale";
  }
  bool needs_mpi() const { return kind == ModelKind::two_scale; } ///< to find the equilibrium it starts from
  bool has_grains() const { return kind != ModelKind::continuum; }
  bool has_continuum() const { return kind != ModelKind::grains; }
  bool is_periodic() const { return sides == Sides::periodic; }
  double element_size() const { return edge / layers.per_edge; }              ///< nominal [m]
  Vec3 edges() const { return {edge, edge, element_size() * layers.high()}; } ///< nominal, of the specimen [m]
  Layout layout(const dem::Box &specimen) const;
  GradingParameters grading() const;

private:
  void declare_sample(ParameterFile &file);
};

} // namespace bergamo::driver
