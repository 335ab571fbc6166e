#pragma once

#include "dem/packing/pack_grains.h"
#include "dem/simulation/simulation.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/grading_parameters.h"
#include "drivers/common/stage_parameters.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// One sample of an ensemble.
struct SampleSettings
{
  std::int64_t number = 1;           ///< from 1 on
  std::uint64_t ensemble_seed = 1;   ///< with which it is the first of an ensemble
  std::uint64_t seed = 1;            ///< of its random numbers
  double edge = 0.01;                ///< of the cell before its compression [m]
  double generation_friction = 0.15; ///< between grains while the packing is compressed
  double confining_pressure = 25e3;  ///< [Pa]
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

  GradingParameters sizes;
  dem::SimulationParameters simulation;
  double packing_solid_fraction = 0.55;
  dem::LoadingStage generation; ///< isotropic compression of the packing

  std::array<StageParameters, max_stages> stages; ///< pressure 0 stands for the confining pressure of the sample

  int n_rows = 500;                 ///< of the history, in each strained stage
  std::int64_t row_interval = 2000; ///< steps between rows in stages without a strain of their own
  int n_distributions = 5;          ///< in each strained stage
  bool pictures = false;
  double snapshot_interval = 60.; ///< wall clock [s]

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  /// Every combination of edge, friction and pressure, n_samples times each, with seeds of their own. Samples that
  /// differ in the pressure alone have the same seed, and so the same packing.
  std::vector<SampleSettings> samples() const;

  /// Options with which an ensemble is this sample alone: --set "Ensemble/samples=1" and so on.
  std::string alone(const SampleSettings &sample) const;

  /// Generation and the stages in use, with the sample's friction and pressure.
  std::vector<dem::LoadingStage> program(const SampleSettings &sample) const;

private:
  void require_room(const SampleSettings &sample) const;
};

} // namespace bergamo::driver
