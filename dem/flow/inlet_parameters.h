#pragma once

#include "dem/packing/grading.h"
#include "dem/packing/space.h"
#include "dem/simulation/simulation_parameters.h"

#include <cstdint>

namespace bergamo::dem
{

/// Where grains come in, which, how many and how fast. Their density is that of their material.
struct InletParameters
{
  Box box;                                ///< in which the bounding spheres of the new grains lie [m]
  Grading grading = UniformSizes();       ///< sizes and shapes; every orientation is as likely
  std::int32_t material = grain_material; ///< of the simulation's table
  double mass_rate = 0.;                  ///< [kg/s], or
  double number_rate = 0.;                ///< grains over time [1/s]: one of both is positive
  Vec3 velocity = Vec3::Zero();           ///< mean, at the half step before; without spin [m/s]
  Vec3 velocity_spread = Vec3::Zero();    ///< components are uniform in velocity -+ spread [m/s]
  std::uint64_t seed = 1;
  int step_interval = 100; ///< steps between two additions; each of them renews the neighbours
  int n_trials = 200;      ///< places that a grain tries at one addition before the box counts as full

  /// Throws ConfigError for a value out of its range, and for a box that is too narrow for some grain of the grading.
  /// @param n_materials of the simulation's table
  void validate(std::int32_t n_materials) const;
};

} // namespace bergamo::dem
