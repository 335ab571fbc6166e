#pragma once

#include "drivers/fit_mohr_coulomb/parameters.h"
#include "drivers/fit_mohr_coulomb/triaxial_curve.h"

#include <filesystem>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// Isotropic compression, one number a row in each vector.
struct CompressionCurve
{
  std::vector<double> pressure; ///< mean [Pa], compression positive
  std::vector<double> solid_fraction;

  std::size_t size() const { return pressure.size(); }
};

/// One triaxial test of an ensemble.
struct Sample
{
  int number;
  double edge; ///< of the cell [m]
  double generation_friction;
  double confining_pressure; ///< [Pa], compression positive
  double n_particles;
  TriaxialCurve curve;            ///< of the last stage
  CompressionCurve compression{}; ///< of the stage before it, which raises the pressure; empty without one
};

struct Ensemble
{
  std::vector<Sample> samples; ///< finished and chosen, in the order of ensemble.csv
  std::vector<std::string> warnings;
};

/// Throws ConfigError where a run in the output folder could move or delete what the fit reads: the ensemble's folder,
/// one of its samples', or the one above an ensemble that was moved aside.
void require_apart(const std::filesystem::path &output, const std::filesystem::path &ensemble);

/// Reads FOLDER/ensemble.csv and, for each finished sample that is chosen, FOLDER/samples/NNNN/history.csv. Warns of
/// samples left out and of pressures that are not held. Throws ConfigError where a file, a column or a value is
/// missing, or no sample is left.
Ensemble read_ensemble(const std::filesystem::path &folder, const SampleChoice &choice);

} // namespace bergamo::driver
