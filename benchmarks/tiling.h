#pragma once

#include "dem/simulation/simulation.h"

#include <memory>

namespace bergamo::benchmark
{

/// Copies of a settled packing side by side, n in each direction, between the six walls moved apart: a dense packing of
/// any size without the time to settle it. Where two copies meet, the walls' contacts are missing, and the grains there
/// move into the gap.
std::unique_ptr<dem::Simulation> tile(const dem::Simulation &packing, int n);

} // namespace bergamo::benchmark
