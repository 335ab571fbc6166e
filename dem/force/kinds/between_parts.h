#pragma once

#include "dem/force/contact_scene.h"

#include <cstdint>

namespace bergamo::dem
{

/// What kinds of contact between parts of two particles have in common; see ContactSet.
struct BetweenParts
{
  static constexpr bool second_is_wall = false;
  static constexpr bool takes_over = false;
  static constexpr bool counts_friction = false;
  static constexpr bool is_interleaved = true;
  static constexpr std::int32_t near_reach = 64;

  static std::int32_t body_of_second(const std::int32_t second, const BodyCount &) { return second; }

  static double travelled(const ContactScene &scene, const std::int32_t first_part, const std::int32_t second_part)
  {
    const Particles &p = scene.particles;
    return p.parts.motion[first_part] + p.parts.motion[second_part] + p.cell.motion;
  }
};

} // namespace bergamo::dem
