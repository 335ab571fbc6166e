#pragma once

#include "dem/core/types.h"
#include "dem/state/periodic_cell.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Pairs (i, j), i < j, whose bounding spheres are nearer than the Verlet distance, sorted by i and then j.
/// Pairs of particle i: pair indices row[i] .. row[i + 1]; the other partner is that image of second[pair].
struct VerletList
{
  std::vector<std::int32_t> row;
  std::vector<std::int32_t> first, second;
  std::vector<Image> image; ///< of the second particle

  std::size_t size() const { return second.size(); }
};

/// @param positions centres [m]; @param radii bounding radii [m]; @param verlet_distance [m], >= 0: the list holds
/// until any particle has moved half of it (Wellmann 3.48); @param masses pairs of two infinite ones, which are fixed,
/// are left out; none given, none is fixed [kg]
/// @param cell in which all positions lie, if it is periodic; its edges at least twice as long as the largest range of
/// two particles, so that a pair has one image at most
VerletList build_verlet_list(std::span<const Vec3> positions, std::span<const double> radii, double verlet_distance,
                             std::span<const double> masses = {}, const PeriodicCell &cell = {});

} // namespace bergamo::dem
