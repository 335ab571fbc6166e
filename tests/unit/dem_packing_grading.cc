#include "dem/core/error.h"
#include "dem/packing/draw_until.h"
#include "dem/packing/grading.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

using namespace bergamo;
using namespace bergamo::dem;

TEST_CASE("uniform sizes of random shapes")
{
  // Diameters uniform in [a, b]: mean (a + b)/2, deviation (b - a)/sqrt(12).
  const UniformSizes sand{0.4e-3, 1.2e-3, {2., 0.5}};
  std::mt19937_64 generator(1);
  constexpr int n = 20000;
  double sum = 0., squares = 0., longest = 0., most_angular = 0.;
  for (int i = 0; i < n; ++i)
  {
    const Superquadric g = draw_grain(sand, generator);
    const double d = 2. * equivalent_radius(g);
    REQUIRE(d > 0.4e-3 * (1. - 1e-12));
    REQUIRE(d < 1.2e-3 * (1. + 1e-12));
    sum += d;
    squares += d * d;
    longest = std::max(longest, g.half_axes.maxCoeff() / g.half_axes.minCoeff());
    most_angular = std::max({most_angular, std::abs(g.eps1 - 1.), std::abs(g.eps2 - 1.)});
  }
  const double mean = sum / n, deviation = std::sqrt(squares / n - mean * mean), expected = 0.8e-3 / std::sqrt(12.);
  CHECK(std::abs(mean - 0.8e-3) < 5. * expected / std::sqrt(n));
  CHECK(std::abs(deviation - expected) < 5. * expected / std::sqrt(n));
  CHECK(longest <= 2.);
  CHECK(longest > 1.8);
  CHECK(most_angular <= 0.5);
  CHECK(most_angular > 0.499);
}

TEST_CASE("more grains than can be numbered are refused before they fill the memory")
{
  std::size_t n_drawn = 0;
  const auto draw = [&]
  {
    ++n_drawn;
    return Superquadric{Vec3::Constant(1e-4), 1., 1.};
  };
  CHECK_THROWS_AS(draw_until(1., draw), ConfigError); // 2.4e11 of them
  CHECK(n_drawn <= 1000);
  CHECK(draw_until(4.18879e-9, draw).size() == 1000);
}

TEST_CASE("the mass of many grains follows their sieve curve")
{
  // The share of the mass below d is a mean over grains weighted by their masses m: it scatters by
  // sqrt(sum m^2 (1[below] - P)^2) / sum m about P. Sampling by number instead of by mass would give a share of more
  // than 0.9 below d50, and sizes without shapes scaled to them another d.
  const SieveCurve curve = SieveCurve::through(0.3e-3, 0.6e-3, 0.7e-3, {1.6, 0.4});
  std::mt19937_64 generator(4);
  std::vector<Superquadric> grains(100000);
  for (Superquadric &g : grains)
    g = draw_grain(curve, generator);
  for (const auto &[size, passing] : {SievePoint{0.3e-3, 0.1}, SievePoint{0.6e-3, 0.5}, SievePoint{0.7e-3, 0.6},
                                      SievePoint{std::sqrt(0.3e-3 * 0.6e-3), 0.3}})
  {
    double all = 0., below = 0., square = 0.;
    for (const Superquadric &g : grains)
    {
      const double m = volume(g);
      const bool passes = sieve_size(g) < size;
      all += m;
      below += passes ? m : 0.;
      square += std::pow(m * ((passes ? 1. : 0.) - passing), 2);
    }
    const double deviation = std::sqrt(square) / all;
    CAPTURE(size, passing, deviation);
    REQUIRE(deviation < 0.005);
    CHECK(std::abs(below / all - passing) < 5. * deviation);
  }
  CHECK(curve.points.front().size == Approx(0.3e-3 * std::pow(0.5, 0.25)));
  CHECK(curve.points.back().size == Approx(0.7e-3 * std::pow(7. / 6., 4.)));
  CHECK(sieve_size({Vec3(3., 1., 2.), 1., 1.}) == 4.);
}

TEST_CASE("gradings out of range are refused")
{
  std::mt19937_64 generator(1);
  const auto draw = [&](const Grading &grading) { return draw_grains(grading, 1e-9, generator); };
  CHECK_THROWS_WITH(draw(UniformSizes{1e-3, 0.5e-3, {}}), Catch::Contains("largest diameter"));
  CHECK_THROWS_WITH(draw(UniformSizes{0., 0.5e-3, {}}), Catch::Contains("smallest diameter"));
  CHECK_THROWS_WITH(draw(UniformSizes{0.5e-3, 1e-3, {0.9, 0.3}}), Catch::Contains("elongation"));
  CHECK_THROWS_WITH(draw(UniformSizes{0.5e-3, 1e-3, {1.2, 1.}}), Catch::Contains("angularity"));
  CHECK_THROWS_WITH(SieveCurve::through(0.5e-3, 0.4e-3, 0.6e-3), Catch::Contains("d50"));
  CHECK_THROWS_WITH(SieveCurve::through(0.3e-3, 0.4e-3, 0.4e-3), Catch::Contains("d60"));
  CHECK_THROWS_WITH(draw(SieveCurve{{{1e-3, 0.}}, {}}), Catch::Contains("at least 2"));
  CHECK_THROWS_WITH(draw(SieveCurve{{{1e-3, 0.1}, {2e-3, 1.}}, {}}), Catch::Contains("smallest grains"));
  CHECK_THROWS_WITH(draw(SieveCurve{{{1e-3, 0.}, {2e-3, 0.9}}, {}}), Catch::Contains("largest grains"));
  CHECK_THROWS_AS(draw(SieveCurve{{{1e-3, 0.}, {1e-3, 1.}}, {}}), ConfigError);
  CHECK_THROWS_AS(draw(SieveCurve{{{1e-3, 0.}, {2e-3, 0.8}, {3e-3, 0.5}, {4e-3, 1.}}, {}}), ConfigError);
  CHECK_NOTHROW(draw(SieveCurve{{{1e-4, 0.}, {2e-4, 1.}}, {}}));
}

TEST_CASE("numbers that would draw grains for ever are refused")
{
  // No number and infinity in every place; a solid volume that no sum of grains reaches, or that too many would; bounds
  // that all but exclude what is drawn.
  std::mt19937_64 generator(1);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const double wrong : {nan, infinite, -infinite, 0., -1e-9})
    CHECK_THROWS_WITH(draw_grains(UniformSizes(), wrong, generator), Catch::Contains("solid volume"));
  for (const double wrong : {nan, infinite, -infinite, -1., 1e-40, 1e40})
  {
    const auto refused = [](const auto &sand) { CHECK_THROWS_AS(sand.validate(), ConfigError); };
    CAPTURE(wrong);
    refused(UniformSizes{wrong, 1e-3, {}});
    refused(UniformSizes{1e-3, wrong, {}});
    refused(GrainShapes{wrong, 0.3});
    refused(SieveCurve{{{wrong, 0.}, {1e-3, 1.}}, {}});
    refused(SieveCurve{{{1e-3, 0.}, {wrong, 1.}}, {}});
    if (wrong != 1e-40)
    {
      refused(GrainShapes{1.5, wrong});
      refused(SieveCurve{{{1e-3, 0.}, {2e-3, wrong}, {3e-3, 1.}}, {}});
      GrainDistribution sand;
      sand.relative_deviation = wrong;
      refused(sand);
    }
    for (double GrainDistribution::*const value :
         {&GrainDistribution::smallest_half_axis, &GrainDistribution::largest_half_axis,
          &GrainDistribution::smallest_exponent, &GrainDistribution::largest_exponent})
    {
      GrainDistribution sand;
      sand.*value = wrong;
      refused(sand);
    }
    GrainDistribution sand;
    sand.mean_half_axes[1] = wrong;
    refused(sand);
    CHECK_THROWS_AS(SieveCurve::through(wrong, 1e-3, 2e-3).validate(), ConfigError);
    CHECK_THROWS_AS(SieveCurve::through(1e-4, 1e-3, wrong).validate(), ConfigError);
  }
  GrainDistribution narrow;
  narrow.mean_half_axes.setConstant(0.5e-3);
  narrow.smallest_half_axis = 0.5e-3 * (1. - 1e-9);
  narrow.largest_half_axis = 0.5e-3 * (1. + 1e-9);
  CHECK_THROWS_WITH(narrow.validate(), Catch::Contains("share of the Gaussian") && Catch::Contains("deviation"));
  narrow.relative_deviation = 0.;
  CHECK_NOTHROW(narrow.validate());
}
