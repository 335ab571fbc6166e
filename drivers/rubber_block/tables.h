#pragma once

#include "drivers/common/run/table.h"
#include "drivers/rubber_block/pull.h"

namespace bergamo::driver
{

/// A sample of the block and of the energies. What is sampled must outlive its table.
struct BlockSample
{
  double time = 0.; ///< since the block is there [s]
  Vec3 force = Vec3::Zero();
  dem::GrainEnergy grains;
  fe::BodyEnergy block;
  double residual = 0.; ///< of the balance of all energies [J]

  /// Rows of history.csv. @param pull as of the sample, present whenever a row is taken
  Table table(const std::unique_ptr<Pull> &pull) const;
};

/// Rows of pressure.csv: mean pressures over strips of the block's lower faces, from its rear to its front.
Table pressure_table(const double &time, const std::unique_ptr<Pull> &pull, std::size_t n_strips);

} // namespace bergamo::driver
