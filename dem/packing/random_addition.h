#pragma once

#include "dem/geometry/rigid_clump.h"
#include "dem/packing/space.h"
#include "dem/state/particles.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Where grains lie: centres [m], and rotations from body to global.
struct GrainPlaces
{
  std::vector<Vec3> position;
  std::vector<Quaternion> orientation;
};

/// One round of the random addition, in which grains without a place are tried once each.
struct AdditionRound
{
  std::int32_t n_tried = 0, n_placed = 0;
};

struct RandomAddition
{
  GrainPlaces places;
  std::vector<AdditionRound> rounds;
};

/// Places grains at random places and orientations in a space so that none overlaps another or leaves the space
/// (random sequential addition; Wellmann 3.4.4, algorithm 1). Works up to a solid fraction of about 0.3.
///
/// In each round the largest grains without a place, a twentieth of all, draw one each, uniform over the whole space,
/// from the seed, the round and its own number; all are held against the placed grains at once, those that fit there
/// against each other, and the larger one takes the place. The same bits on any number of threads, and, unlike trials
/// divided by regions, no place or direction that is preferred. @throws ConfigError for impossible grains, and naming
/// the solid fraction reached if they find no place
RandomAddition place_at_random(std::span<const Superquadric> grains, const PackingSpace &space, std::uint64_t seed);
RandomAddition place_at_random(std::span<const Clump> grains, const PackingSpace &space, std::uint64_t seed);

/// The same as particles. @param density [kg/m^3]
Particles add_at_random(std::span<const Superquadric> grains, const PackingSpace &space, double density,
                        std::uint64_t seed);
Particles add_at_random(std::span<const Clump> grains, const PackingSpace &space, double density, std::uint64_t seed);

} // namespace bergamo::dem
