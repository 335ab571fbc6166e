#include "dem/packing/grading.h"

#include "dem/core/error.h"
#include "dem/packing/draw_until.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{
namespace
{

constexpr double smallest_size = 100. * shape_limits::smallest_half_axis,
                 largest_size = 0.01 * shape_limits::largest_half_axis; // [m], whatever the shapes

Superquadric draw_shape(const GrainShapes &shapes, std::mt19937_64 &generator)
{
  std::uniform_real_distribution<double> half_axis(1., shapes.elongation),
      exponent(1. - shapes.angularity, 1. + shapes.angularity);
  Superquadric grain;
  for (int d = 0; d < 3; ++d)
    grain.half_axes[d] = half_axis(generator);
  grain.eps1 = exponent(generator);
  grain.eps2 = exponent(generator);
  return grain;
}

/// Sizes by number. Grains of size d and random shape weigh k d^3 on average, so between two sieves, where the mass per
/// d is p/d with p constant, their number per d goes with p d^-4, and d^-3 is uniform.
double draw_size(const SieveCurve &curve, std::mt19937_64 &generator)
{
  const auto &points = curve.points;
  const auto inverse_cube = [](const double d) { return 1. / (d * d * d); };
  const auto number = [&](const std::size_t k)
  {
    return (points[k].passing - points[k - 1].passing) / std::log(points[k].size / points[k - 1].size) *
           (inverse_cube(points[k - 1].size) - inverse_cube(points[k].size));
  };
  double all = 0.;
  for (std::size_t k = 1; k < points.size(); ++k)
    all += number(k);
  std::uniform_real_distribution<double> uniform(0., 1.);
  double below = uniform(generator) * all;
  std::size_t part = 1;
  for (; part + 1 < points.size() && below >= number(part); ++part)
    below -= number(part);
  const double fine = inverse_cube(points[part - 1].size), coarse = inverse_cube(points[part].size);
  return 1. / std::cbrt(coarse + (fine - coarse) * uniform(generator));
}

} // namespace

void GrainShapes::validate() const
{
  require(elongation >= 1. && elongation <= 20., "elongation of the grains", elongation, "in [1, 20]");
  require(angularity >= 0. && angularity <= 0.9, "angularity of the grains", angularity, "in [0, 0.9]");
}

void UniformSizes::validate() const
{
  shapes.validate();
  require(smallest_diameter >= smallest_size, "smallest diameter of the grains", smallest_diameter,
          "positive, 1e-28 m at least");
  require(largest_diameter >= smallest_diameter && largest_diameter <= largest_size, "largest diameter of the grains",
          largest_diameter, "at least the smallest diameter, and at most 1e28 m");
}

SieveCurve SieveCurve::through(const double d10, const double d50, const double d60, const GrainShapes &shapes)
{
  require(d10 > 0., "d10 of the sieve curve", d10, "positive [m]");
  require(d50 > d10, "d50 of the sieve curve", d50, "larger than d10 [m]");
  require(d60 > d50 && std::isfinite(d60), "d60 of the sieve curve", d60, "larger than d50 [m]");
  const double smallest = d10 * std::pow(d10 / d50, 0.25), largest = d60 * std::pow(d60 / d50, 4.);
  return {{{smallest, 0.}, {d10, 0.1}, {d50, 0.5}, {d60, 0.6}, {largest, 1.}}, shapes};
}

void SieveCurve::validate() const
{
  shapes.validate();
  require(points.size() >= 2, "number of points of the sieve curve", static_cast<double>(points.size()),
          "at least 2: the sizes that nothing and that everything passes");
  require(points.front().size >= smallest_size, "smallest size of the sieve curve", points.front().size,
          "positive, 1e-28 m at least");
  require(points.front().passing == 0., "share that passes the first point of the sieve curve", points.front().passing,
          "0: add the size of the smallest grains");
  require(points.back().passing == 1., "share that passes the last point of the sieve curve", points.back().passing,
          "1: add the size of the largest grains");
  for (std::size_t k = 1; k < points.size(); ++k)
  {
    require(points[k].size > points[k - 1].size && points[k].size <= largest_size, "size of the sieve curve",
            points[k].size, "larger than that of the point before [m], and at most 1e28 m");
    require(points[k].passing >= points[k - 1].passing, "share that passes the sieve curve", points[k].passing,
            "at least that of the point before");
  }
}

Superquadric draw_grain(const UniformSizes &sizes, std::mt19937_64 &generator)
{
  Superquadric grain = draw_shape(sizes.shapes, generator);
  std::uniform_real_distribution<double> uniform(0., 1.);
  const double diameter =
      sizes.smallest_diameter + (sizes.largest_diameter - sizes.smallest_diameter) * uniform(generator);
  grain.half_axes *= 0.5 * diameter / equivalent_radius(grain);
  return grain;
}

Superquadric draw_grain(const SieveCurve &curve, std::mt19937_64 &generator)
{
  Superquadric grain = draw_shape(curve.shapes, generator);
  grain.half_axes *= draw_size(curve, generator) / sieve_size(grain);
  return grain;
}

std::vector<Superquadric> draw_grains(const Grading &grading, const double solid_volume, std::mt19937_64 &generator)
{
  return std::visit(
      [&](const auto &sand)
      {
        sand.validate();
        return draw_until(solid_volume, [&] { return draw_grain(sand, generator); });
      },
      grading);
}

double sieve_size(const Superquadric &grain)
{
  Vec3 r = grain.half_axes;
  std::sort(r.begin(), r.end());
  return 2. * r[1];
}

} // namespace bergamo::dem
