#pragma once

#include "dem/loading/cell_loading.h"
#include "dem/loading/compression.h"
#include "dem/simulation/simulation.h"
#include "drivers/common/run/run.h"
#include "drivers/two_scale_triaxial/parameters.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace bergamo::driver
{

/// The first stage: grains drawn, placed at random in a box that is wide enough, and compressed between its walls; or
/// packed in a periodic cell and compressed by it.
struct PackingStage
{
  std::unique_ptr<dem::Simulation> grains;
  dem::Compression compression;         ///< between walls
  std::optional<dem::CellLoading> cell; ///< of a periodic one

  void step(); ///< one of the simulation, walls or cell included
  bool is_finished() const { return cell ? cell->is_finished() : compression.is_finished(); }
};

/// Draws and places the grains. @throws ConfigError where they do not fit
PackingStage begin_packing(const TriaxialParameters &parameters);

/// A packing that other runs may start from, moved on to the step after its last. Reading throws ConfigError for one of
/// other parameters, naming the first that differs, and RunError for a file that is missing, damaged or of another
/// kind.
/// @{
void write_sample(const std::filesystem::path &file, const dem::Simulation &grains,
                  const TriaxialParameters &parameters);
PackingStage read_sample(const TriaxialParameters &parameters);
/// @}

/// The state of a packing under way, by name; in reading it is made.
void visit_packing(StateVisitor &visit, std::optional<PackingStage> &packing, const TriaxialParameters &parameters);

/// How the packing is stepped. @param aim solid fraction that is expected, for the display
Stage stage_of(PackingStage &packing, double aim);

/// What the loading starts from.
struct LoadingStart
{
  dem::Box box;                        ///< of the grains or, without any, of the specimen
  std::vector<Vec3> reference_by_id{}; ///< the grains' places
  double solid_fraction = 0.;
  double coordination_number = 0.; ///< contacts a grain

  /// Of the whole packing, xx, yy and zz, a layer of elements each from the bottom, tension positive [Pa]: what the
  /// continuum takes over. Its zz is the mean over all layers, as balance asks for; the lateral ones may differ.
  std::vector<Vec3> stress_by_layer{};
};

/// Stops a packing's grains and walls where they are, for the loading. Grains with their centre where a
/// continuum will be alone are taken out, and the floor: those that stay are grains of a specimen of grains alone.
/// @param grains moved on to the step after the packing's last
LoadingStart end_packing(dem::Simulation &grains, const TriaxialParameters &parameters);

} // namespace bergamo::driver
