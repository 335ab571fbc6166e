#pragma once

#include "dem/core/types.h"
#include "dem/state/particles.h"

#include <random>
#include <span>

namespace bergamo::dem
{

/// Axis-aligned box [m].
struct Box
{
  Vec3 low = Vec3::Zero(), high = Vec3::Ones();

  Vec3 edges() const { return high - low; }
  double volume() const { return edges().prod(); }
};

/// Places grains one by one at random places and orientations in a box so that none overlaps another or leaves the box
/// (random sequential addition; Wellmann 3.4.4). Works up to a solid fraction of about 0.3.
/// @param density [kg/m^3]; @throws ConfigError naming the solid fraction reached if a grain finds no place.
Particles add_at_random(std::span<const Superquadric> grains, const Box &box, double density,
                        std::mt19937_64 &generator);

} // namespace bergamo::dem
