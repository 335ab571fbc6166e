#pragma once

#include "dem/core/archive.h"
#include "dem/packing/compression.h"
#include "drivers/two_scale_triaxial/specimen.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// What the loading stage needs beside the models to go on.
struct LoadingState
{
  std::int64_t step = 0;                                ///< steps done in this stage
  dem::Box box;                                         ///< of the grains before the loading
  std::vector<Vec3> reference_by_id;                    ///< the grains' places then
  double first_balance = 0.;                            ///< energy balance of the first sample [J]
  double largest_residual = 0.;                         ///< over the work done so far
  double smallest_stable_step = 0.;                     ///< [s]; 0 before the first estimate
  std::vector<double> picture_times;                    ///< of the frames written [s]
  double solid_fraction = 0., coordination_number = 0.; ///< of the packing
  std::int64_t packing_steps = 0;
};

/// Where an interrupted run was.
enum class Stage : std::int64_t
{
  packing = 1,
  loading = 2
};

/// Snapshots of both stages: the state to the last bit and the parameters that it belongs to.
/// @{
void write_packing(const std::filesystem::path &path, const std::string &parameters, const dem::Simulation &grains,
                   const dem::Compression &compression);
void write_loading(const std::filesystem::path &path, const std::string &parameters, Specimen &specimen,
                   const LoadingState &state);

/// A snapshot opened for reading. Throws RunError for a damaged or foreign file, ConfigError where the
/// parameters are others than those of the run that wrote it.
class SnapshotReader
{
public:
  SnapshotReader(const std::filesystem::path &path, const std::string &parameters);

  Stage stage() const { return static_cast<Stage>(archive.read_integer("stage")); }
  std::unique_ptr<dem::Simulation> grains(const dem::SimulationParameters &parameters) const;
  void read(dem::Compression &compression) const;
  LoadingState loading_state() const;
  void read_body(fe::ExplicitBody &body) const;

private:
  ArchiveReader archive;
};
/// @}

} // namespace bergamo::driver
