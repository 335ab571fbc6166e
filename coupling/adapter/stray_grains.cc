#include "coupling/adapter/stray_grains.h"

#include "coupling/adapter/dealii_adapter.h"

#include <algorithm>
#include <limits>
#include <unordered_set>

namespace bergamo::coupling
{

StrayGrains::StrayGrains(const dem::Particles &particles, const std::span<const std::int64_t> coupled,
                         const fe::ExplicitBody &body, const Bounds &bounds)
{
  const std::unordered_set<std::int64_t> is_coupled(coupled.begin(), coupled.end());
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (!is_coupled.contains(particles.id[i]))
    {
      id_.push_back(particles.id[i]);
      place_.push_back(particles.position[i]);
    }
  for (const double distance : distances_to(body, place_))
    reach_.push_back(std::max(bounds.farthest, distance - bounds.reach - bounds.farthest));
}

bool StrayGrains::may_have_come(const dem::Simulation &grains)
{
  const dem::Particles &p = grains.particles;
  // What returns to a periodic cell goes by a period in no time.
  if (p.largest_motion < look_at_motion_ && !p.cell.is_periodic())
    return false;
  double least = std::numeric_limits<double>::infinity(); // way that is left [m]
  for (std::size_t k = 0; k < id_.size(); ++k)
    if (grains.has(id_[k]))
      least = std::min(least, reach_[k] - (p.position[grains.index_of(id_[k])] - place_[k]).norm());
  look_at_motion_ = p.largest_motion + 0.9 * least; // far above the rounding of a sum over steps
  return least < 0.;
}

} // namespace bergamo::coupling
