#pragma once

#include "dem/simulation/simulation.h"
#include "drivers/common/run/settled_sand.h"
#include "drivers/common/run/state_visitor.h"
#include "drivers/pile_installation/parameters.h"

#include <memory>
#include <vector>

namespace bergamo::driver
{

/// What the installation starts from, and what its block of grains has become since.
struct InstallationStart
{
  SettledSand sand;
  double bulk_density = 0.;          ///< of all sand below its level [kg/m³]
  Vec3 at_rest = Vec3::Ones();       ///< stresses of all sand at rest over the upright one: K0 along x and y, 1
  std::vector<Vec3> place_by_id;     ///< of the grains, before any were taken out [m]
  std::vector<Vec3> reference_by_id; ///< the same in the elements' reference configuration, as the overlap has it [m]

  dem::Particles reserve; ///< settled grains below the block, which it gets as it grows, and about them, as they lay
  std::int64_t n_growths = 0; ///< of the block so far

  bool is_known() const { return sand.height > 0.; } ///< the sand has settled
  void add_to(Summary &summary) const;
  void visit(StateVisitor &visit);
};

/// Packs the sand, or the one tile of it that others will be copies of; nothing where the user interrupts it.
std::unique_ptr<dem::Simulation> pack_ground(Progress &progress, const InstallationParameters &parameters);

/// Lays a settled tile side by side with copies of it, with all their contacts but those across the ends of the sand.
/// Then measures the settled sand, once its forces are known, and opens its box. Of two-scale ground all grains beyond
/// the block are taken out, and the walls there: those that stay are the grains of ground of grains alone.
InstallationStart prepare_ground(std::unique_ptr<dem::Simulation> &sand, const InstallationParameters &parameters);

} // namespace bergamo::driver
