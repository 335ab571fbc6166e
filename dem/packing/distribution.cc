#include "dem/packing/distribution.h"

#include "dem/core/error.h"

#include <cmath>
#include <numbers>

namespace bergamo::dem
{
void GrainDistribution::validate() const
{
  require(smallest_half_axis > 0., "smallest half-axis", smallest_half_axis, "positive [m]");
  require(largest_half_axis > smallest_half_axis && std::isfinite(largest_half_axis), "largest half-axis",
          largest_half_axis, "larger than the smallest half-axis [m]");
  for (int d = 0; d < 3; ++d)
    require(mean_half_axes[d] >= smallest_half_axis && mean_half_axes[d] <= largest_half_axis, "mean half-axis",
            mean_half_axes[d], "between the smallest and the largest half-axis [m]");
  require(relative_deviation >= 0. && relative_deviation <= 1., "relative deviation of the half-axes",
          relative_deviation, "in [0, 1]");
  require(smallest_exponent > 0. && smallest_exponent < 2., "smallest exponent", smallest_exponent, "in (0, 2)");
  require(largest_exponent >= smallest_exponent && largest_exponent < 2., "largest exponent", largest_exponent,
          "in [smallest exponent, 2)");
}

Superquadric draw_grain(const GrainDistribution &distribution, std::mt19937_64 &generator)
{
  Superquadric grain;
  for (int d = 0; d < 3; ++d)
  {
    const double mean = distribution.mean_half_axes[d];
    std::normal_distribution<double> half_axis(mean, distribution.relative_deviation * mean);
    do
      grain.half_axes[d] = half_axis(generator);
    while (!(grain.half_axes[d] >= distribution.smallest_half_axis &&
             grain.half_axes[d] <= distribution.largest_half_axis));
  }
  std::uniform_real_distribution<double> exponent(distribution.smallest_exponent, distribution.largest_exponent);
  grain.eps1 = exponent(generator);
  grain.eps2 = exponent(generator);
  return grain;
}

Quaternion uniform_rotation(const double u, const double v, const double w)
{
  const double a = 2. * std::numbers::pi * v, b = 2. * std::numbers::pi * w;
  const double s = std::sqrt(1. - u), c = std::sqrt(u);
  return Quaternion(c * std::cos(b), s * std::sin(a), s * std::cos(a), c * std::sin(b));
}

Quaternion draw_orientation(std::mt19937_64 &generator)
{
  std::uniform_real_distribution<double> uniform(0., 1.);
  const double u = uniform(generator), v = uniform(generator), w = uniform(generator);
  return uniform_rotation(u, v, w);
}

} // namespace bergamo::dem
