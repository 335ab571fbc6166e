#include "dem/packing/largest_grain.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{
namespace
{

/// Of half-axes in any order. @param axes [m], the largest first
double largest_radius(const Vec3 &axes, const double exponent)
{
  double largest = 0.;
  Vec3 order = axes.reverse();
  do
    largest = std::max(largest, bounding_radius({order, exponent, exponent}));
  while (std::next_permutation(order.begin(), order.end()));
  return largest;
}

double largest_bounding_radius(const GrainDistribution &distribution)
{
  return largest_radius(Vec3::Constant(distribution.largest_half_axis), distribution.smallest_exponent);
}

/// With half-axes x1 >= x2 >= x3 in [1, e], x1 over their geometric mean is at most e^(2/3), x2 e^(1/3), and x3 1; the
/// grain whose exponents are largest has the least volume, and is scaled most.
double largest_bounding_radius(const UniformSizes &sizes)
{
  const double third = std::cbrt(sizes.shapes.elongation), most = 1. + sizes.shapes.angularity;
  const double scale = 0.5 * sizes.largest_diameter / equivalent_radius({Vec3::Ones(), most, most});
  return largest_radius(scale * Vec3(third * third, third, 1.), 1. - sizes.shapes.angularity);
}

/// The intermediate half-axis follows from the sieve, the smallest is at most as large.
double largest_bounding_radius(const SieveCurve &curve)
{
  const double half = 0.5 * curve.points.back().size;
  return largest_radius(half * Vec3(curve.shapes.elongation, 1., 1.), 1. - curve.shapes.angularity);
}

} // namespace

double largest_bounding_radius(const Grading &grading)
{
  return std::visit([](const auto &sand) { return largest_bounding_radius(sand); }, grading);
}

} // namespace bergamo::dem
