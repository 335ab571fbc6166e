#pragma once

#include "dem/simulation/simulation.h"

#include <array>
#include <memory>

namespace bergamo::benchmark
{

/// Copies of a settled packing side by side, n in each direction, between the six walls moved apart: a dense packing of
/// any size without the time to settle it. Where two copies meet, the walls' contacts are missing, and the grains there
/// move into the gap.
std::unique_ptr<dem::Simulation> tile(const dem::Simulation &packing, const std::array<int, 3> &n);

inline std::unique_ptr<dem::Simulation> tile(const dem::Simulation &packing, const int n)
{
  return tile(packing, {n, n, n});
}

} // namespace bergamo::benchmark
