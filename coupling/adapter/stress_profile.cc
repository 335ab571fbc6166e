#include "coupling/adapter/stress_profile.h"

#include "coupling/adapter/cell_stress.h"
#include "dem/core/error.h"

#include <algorithm>
#include <cmath>

namespace bergamo::coupling
{
namespace
{

/// Of grains alone or of a model.
template <class Measured>
std::vector<SlabStress> profile_of(const Measured &measured, const dem::Box &box, const unsigned int n_slabs)
{
  if (n_slabs == 0)
    reject("a profile of stresses has 0 slabs; give it as many as there are layers of elements");
  const dem::HexahedronGrid grid{box, {1, 1, static_cast<std::int32_t>(n_slabs)}};
  std::vector<SlabStress> slabs;
  for (const CellStress &cell : cell_stresses(measured, grid))
  {
    const double low = box.low[2] + static_cast<double>(slabs.size()) * grid.cell_edges()[2];
    slabs.push_back({low, low + grid.cell_edges()[2], cell.grains.diagonal(), cell.continuum.diagonal()});
  }
  return slabs;
}

} // namespace

std::vector<SlabStress> stress_profile(const TwoScaleModel &model, const dem::Box &box, const unsigned int n_slabs)
{
  return profile_of(model, box, n_slabs);
}

std::vector<SlabStress> stress_profile(const dem::Simulation &grains, const dem::Box &box, const unsigned int n_slabs)
{
  return profile_of(grains, box, n_slabs);
}

double unevenness(const std::vector<SlabStress> &profile)
{
  double least = 1e300, most = -1e300, sum = 0.;
  for (const SlabStress &slab : profile)
  {
    const double stress = slab.total()[2];
    least = std::min(least, stress);
    most = std::max(most, stress);
    sum += stress;
  }
  return sum == 0. ? 0. : (most - least) / std::abs(sum / static_cast<double>(profile.size()));
}

} // namespace bergamo::coupling
