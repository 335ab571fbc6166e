#pragma once

#include "dem/core/types.h"
#include "dem/geometry/superquadric.h"

#include <random>
#include <vector>

namespace bergamo::dem
{

/// Sizes and shapes of the grains of a sand. The defaults are Leighton Buzzard sand, fraction B (Wellmann 5.2, after
/// Clayton et al.): half-axes Gaussian about half the mean large, intermediate and small dimension, within bounds;
/// exponents uniform.
struct GrainDistribution
{
  Vec3 mean_half_axes{0.57e-3, 0.395e-3, 0.305e-3}; ///< [m]
  double relative_deviation = 0.2;                  ///< standard deviation over mean
  double smallest_half_axis = 0.25e-3;              ///< [m]
  double largest_half_axis = 0.75e-3;               ///< [m]
  double smallest_exponent = 0.6;
  double largest_exponent = 1.2;

  /// Throws ConfigError for a value out of its range, or bounds that exclude a mean or nearly all draws.
  void validate() const;
};

/// One random grain.
Superquadric draw_grain(const GrainDistribution &distribution, std::mt19937_64 &generator);

/// Uniform random rotation from three numbers uniform in [0, 1) (Shoemake 1992).
Quaternion uniform_rotation(double u, double v, double w);

Quaternion draw_orientation(std::mt19937_64 &generator);

} // namespace bergamo::dem
