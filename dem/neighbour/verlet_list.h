#pragma once

#include "dem/neighbour/bounding_spheres.h"
#include "dem/state/periodic_cell.h"

#include <cstdint>
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

/// The list holds until any sphere has moved half of the Verlet distance (Wellmann 3.48). Pairs of two fixed spheres
/// and of two spheres of one body are left out, and those of two that are not sought. The same bits on any number of
/// threads; time and memory grow with the number of spheres and of pairs, wherever the spheres lie and however much
/// their sizes differ.
/// @param verlet_distance [m], >= 0
/// @param cell in which all positions lie, if it is periodic, or outside by half of an edge less the largest range of
/// two spheres at most; its edges at least twice as long as that range, so that a pair has one image at most
VerletList build_verlet_list(const BoundingSpheres &spheres, double verlet_distance, const PeriodicCell &cell = {});

} // namespace bergamo::dem
