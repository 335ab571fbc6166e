#pragma once

#include "dem/state/particles.h"

#include <cstddef>
#include <cstdint>

namespace bergamo::dem
{

/// What has passed an outlet or an inlet since the start.
struct Throughput
{
  std::int64_t n_grains = 0;
  double mass = 0.;             ///< [kg]
  double volume = 0.;           ///< of the solid [m^3]
  Vec3 momentum = Vec3::Zero(); ///< of each grain at the half step before it passed [kg m/s]

  /// Counts a grain that passes.
  void count(const Particles &grains, const std::size_t i)
  {
    ++n_grains;
    mass += grains.mass[i];
    volume += grains.volume[i];
    momentum += grains.mass[i] * grains.velocity[i];
  }

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("n_grains", self.n_grains);
    visit("mass", self.mass);
    visit("volume", self.volume);
    visit("momentum", self.momentum);
  }
};

} // namespace bergamo::dem
