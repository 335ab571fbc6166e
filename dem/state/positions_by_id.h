#pragma once

#include "dem/state/particles.h"

#include <vector>

namespace bergamo::dem
{

/// Where every particle is, whatever the order of the arrays [m]. @param particles with ids from 0 on, without gaps
inline std::vector<Vec3> positions_by_id(const Particles &particles)
{
  std::vector<Vec3> positions(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
    positions[particles.id[i]] = particles.position[i];
  return positions;
}

} // namespace bergamo::dem
