#pragma once

#include "dem/core/types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Pairs (i, j), i < j, whose bounding spheres are nearer than the Verlet distance, sorted by i and then j.
/// Pairs of particle i: pair indices row[i] .. row[i + 1]; the other partner is second[pair].
struct VerletList
{
  std::vector<std::int32_t> row;
  std::vector<std::int32_t> first, second;

  std::size_t size() const { return second.size(); }
};

/// @param positions centres [m]; @param radii bounding radii [m]; @param verlet_distance [m], >= 0: the list holds
/// until any particle has moved half of it (Wellmann 3.48); @param masses pairs of two infinite ones, which are fixed,
/// are left out; none given, none is fixed [kg]
VerletList build_verlet_list(std::span<const Vec3> positions, std::span<const double> radii, double verlet_distance,
                             std::span<const double> masses = {});

} // namespace bergamo::dem
