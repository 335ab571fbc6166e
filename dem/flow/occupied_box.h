#pragma once

#include "dem/packing/grain_grid.h"
#include "dem/packing/overlap.h"
#include "dem/packing/space.h"
#include "dem/state/particles.h"
#include "dem/state/wall.h"

#include <cstdint>
#include <vector>

namespace bergamo::dem
{

/// What stands in a box, where grains are to be placed: bodies, fixed ones included, those that were placed before, and
/// walls. Overlap is decided by a plane between the bodies themselves, part by part: bounding spheres come first, for
/// they decide most pairs, but alone they would keep long grains from most of the room they have.
class OccupiedBox
{
public:
  /// All are kept by reference. @param placed grains, none at first; @param largest their bounding radius at most [m]
  OccupiedBox(const PackingSpace &box, const Particles &grains, const std::vector<PlaneWall> &walls,
              const Particles &placed, double largest);

  /// Whether a grain in the box overlaps nothing.
  bool has_room_for(const PlacedGrain &grain) const;

  /// Takes in the last one of the placed grains.
  void take_last();

private:
  bool is_apart_from_walls(const PlacedGrain &grain) const;
  static bool is_apart_from(const Particles &bodies, const GrainGrid &by_part, const PlacedGrain &grain);

  const Particles &grains;
  const std::vector<PlaneWall> &walls;
  const Particles &placed;
  GrainGrid grid_of_grains, grid_of_placed;
};

} // namespace bergamo::dem
