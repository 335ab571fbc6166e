#pragma once

#include "dem/loading/loading_stage.h"
#include "dem/packing/grading.h"
#include "dem/packing/pack_grains.h"
#include "dem/simulation.h"
#include "drivers/common/parameter_file.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bergamo::driver
{

enum class SizeKind
{
  gaussian, ///< of the half-axes
  uniform,  ///< diameters of the spheres of equal volume
  sieves    ///< by mass
};

/// One sample of an ensemble.
struct SampleSettings
{
  std::int64_t number = 1; ///< from 1 on
  std::uint64_t seed = 1;
  double edge = 0.01;                ///< of the cell before its compression [m]
  double generation_friction = 0.15; ///< between grains while the packing is compressed
  double confining_pressure = 25e3;  ///< [Pa]
};

/// A stage of the program as the parameter file has it.
struct StageSettings
{
  bool is_used = false;
  dem::LoadingStage stage; ///< pressure 0 stands for the confining pressure of the sample
};

/// Everything that steers the triaxial tests on periodic cells. SI units.
struct RveParameters
{
  RveParameters();

  static constexpr std::size_t max_stages = 6;

  int n_samples = 10; ///< of each combination
  std::uint64_t seed = 1;
  std::vector<double> edges{0.01}; ///< [m]
  std::vector<double> generation_frictions{0.15};
  std::vector<double> confining_pressures{25e3}; ///< [Pa]

  SizeKind size_kind = SizeKind::gaussian;
  dem::GrainDistribution gaussian;
  dem::UniformSizes uniform;
  double d10 = 0.64e-3, d50 = 0.78e-3, d60 = 0.81e-3; ///< of the sieve curve [m]

  dem::SimulationParameters simulation;
  double packing_solid_fraction = 0.55;
  dem::LoadingStage generation; ///< isotropic compression of the packing

  std::array<StageSettings, max_stages> stages;

  int n_rows = 500;                 ///< of the history, in each strained stage
  std::int64_t row_interval = 2000; ///< steps between rows in stages without a strain of their own
  int n_distributions = 5;          ///< in each strained stage
  bool pictures = false;
  double snapshot_interval = 60.; ///< wall clock [s]

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Takes over what has been read. Before everything below.
  void take_stages();

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  dem::Grading grading() const;

  /// Every combination of edge, friction and pressure, n_samples times each, with seeds of their own. Samples that
  /// differ in the pressure alone have the same seed, and so the same packing.
  std::vector<SampleSettings> samples() const;

  /// Generation and the stages in use, with the sample's friction and pressure.
  std::vector<dem::LoadingStage> program(const SampleSettings &sample) const;

private:
  void require_room(const SampleSettings &sample) const;

  std::array<std::string, max_stages> path_names;
};

} // namespace bergamo::driver
