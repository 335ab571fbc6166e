#pragma once

#include "dem/neighbour/neighbour_watch.h"
#include "dem/state/particles.h"
#include "dem/state/wall.h"

#include <cstdint>
#include <vector>

namespace bergamo::dem
{

/// When and where, for messages.
struct Instant
{
  double time; ///< [s]
  std::int64_t n_steps;
};

/// Throws RunError naming grain, place and time if the state of any is not finite.
/// @param watch where a grain without a place was last seen
void check_finite(const Particles &particles, const NeighbourWatch &watch, const Instant &instant);

/// Throws RunError naming a wall whose place is not finite.
void check_finite(const std::vector<PlaneWall> &walls, const Instant &instant);

/// Throws RunError naming the grain because of which a step failed: one whose state or force is not finite, else the
/// one on which the largest force acts.
[[noreturn]] void report_divergence(const Particles &particles, const NeighbourWatch &watch, const Instant &instant);

} // namespace bergamo::dem
