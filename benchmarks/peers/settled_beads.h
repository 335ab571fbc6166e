#pragma once

#include "benchmarks/peers/bulk_case.h"
#include "dem/packing/space.h"
#include "dem/state/wall.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace bergamo::benchmark
{

/// Beads that are to lie in a vessel.
struct BeadFilling
{
  int n_beads = 1000;
  double radius = 2e-3; ///< [m]
  std::uint64_t seed = 1;
  dem::PackingSpace space;                               ///< of the vessel, with room for beads that have yet to fall
  std::vector<dem::PlaneWall> stoppers;                  ///< that close the vessel while it is filled
  std::function<std::int32_t(const Vec3 &)> material_at; ///< of beads that have come to lie there
};

/// Lets beads fall into the vessel of a case, which has its surface and parameters by now, and puts them there at rest.
/// They come to rest as softer ones, which takes fewer steps, and then as what they are. Throws RunError if they do
/// not.
void fill(BulkCase &bulk, const BeadFilling &filling);

/// Fills at most this share of a space with beads that have yet to fall.
constexpr double loose_fraction = 0.28;

} // namespace bergamo::benchmark
