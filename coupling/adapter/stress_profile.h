#pragma once

#include "coupling/adapter/two_scale_model.h"
#include "dem/packing/space.h"

#include <vector>

namespace bergamo::coupling
{

/// Mean stresses in a slab across z, of both models with their weights: where they share the space, their sum is what
/// the material bears. Components xx, yy, zz, tension positive [Pa].
struct SlabStress
{
  double low = 0., high = 0.; ///< heights [m]
  Vec3 grains = Vec3::Zero(); ///< of the contacts, each with its weight, by the part of its branch in the slab
  Vec3 continuum = Vec3::Zero();

  Vec3 total() const { return grains + continuum; }
};

/// Slabs of equal height from the bottom to the top of a box, with all that lies beside it: cell_stresses() of a grid
/// that is cut along z alone; of one slab, with all above and below it, too. Of the present step, once its forces are
/// known. @throws ConfigError for no slab
std::vector<SlabStress> stress_profile(const TwoScaleModel &model, const dem::Box &box, unsigned int n_slabs);

/// Of grains alone, between walls or with a part of them taken out; otherwise as above.
std::vector<SlabStress> stress_profile(const dem::Simulation &grains, const dem::Box &box, unsigned int n_slabs);

/// Largest difference between the slabs' zz, over their mean. In a column at rest that bears no weight it is 0 for a
/// joint that does not show.
double unevenness(const std::vector<SlabStress> &profile);

} // namespace bergamo::coupling
