#include "dem/packing/distribution.h"

#include "dem/core/error.h"

#include <cmath>
#include <numbers>

namespace bergamo::dem
{
namespace
{

constexpr double least_share = 1e-3;

/// Of the draws of one half-axis, those that its bounds keep.
double share_within_bounds(const GrainDistribution &distribution, const int d)
{
  const double mean = distribution.mean_half_axes[d], deviation = distribution.relative_deviation * mean;
  if (deviation == 0.)
    return 1.;
  const auto below = [&](const double x) { return 0.5 * std::erfc((mean - x) / (std::numbers::sqrt2 * deviation)); };
  return below(distribution.largest_half_axis) - below(distribution.smallest_half_axis);
}

} // namespace

void GrainDistribution::validate() const
{
  require(smallest_half_axis >= shape_limits::smallest_half_axis, "smallest half-axis", smallest_half_axis,
          "positive, 1e-30 m at least");
  require(largest_half_axis > smallest_half_axis && largest_half_axis <= shape_limits::largest_half_axis,
          "largest half-axis", largest_half_axis, "larger than the smallest half-axis [m]");
  require(largest_half_axis <= shape_limits::largest_ratio * smallest_half_axis, "largest over smallest half-axis",
          largest_half_axis / smallest_half_axis, "at most 1e5");
  for (int d = 0; d < 3; ++d)
    require(mean_half_axes[d] >= smallest_half_axis && mean_half_axes[d] <= largest_half_axis, "mean half-axis",
            mean_half_axes[d], "between the smallest and the largest half-axis [m]");
  require(relative_deviation >= 0. && relative_deviation <= 1., "relative deviation of the half-axes",
          relative_deviation, "in [0, 1]");
  for (int d = 0; d < 3; ++d)
  {
    const double share = share_within_bounds(*this, d);
    require(share >= least_share, "share of the Gaussian half-axes between the smallest and the largest one", share,
            "at least 0.001, or grains would be drawn for ever: move the bounds apart or take a smaller deviation");
  }
  require(smallest_exponent >= shape_limits::smallest_exponent && smallest_exponent < 2., "smallest exponent",
          smallest_exponent, "in (0, 2), 1e-6 at least from both ends");
  require(largest_exponent >= smallest_exponent && largest_exponent <= shape_limits::largest_exponent,
          "largest exponent", largest_exponent, "in [smallest exponent, 2), 1e-6 at least below 2");
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
