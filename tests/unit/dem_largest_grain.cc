#include "dem/packing/largest_grain.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

TEST_CASE("no grain of a grading reaches further than its bound, and some reach half as far")
{
  GrainDistribution gaussian;
  gaussian.relative_deviation = 0.5;
  const GrainShapes long_ones{2.5, 0.6};
  const std::vector<Grading> gradings{GrainDistribution(), gaussian, UniformSizes{1e-3, 2e-3, long_ones},
                                      SieveCurve::through(1e-3, 1.5e-3, 1.7e-3, long_ones)};
  for (const Grading &grading : gradings)
  {
    const double bound = largest_bounding_radius(grading);
    std::mt19937_64 generator(1);
    double largest = 0.;
    for (int n = 0; n < 20000; ++n)
      largest = std::max(
          largest, bounding_radius(std::visit([&](const auto &sand) { return draw_grain(sand, generator); }, grading)));
    CAPTURE(grading.index(), largest, bound);
    CHECK(largest <= bound);
    CHECK(largest > 0.5 * bound);
  }
  const GrainShapes spheres{1., 0.};
  CHECK(largest_bounding_radius(UniformSizes{1e-3, 2e-3, spheres}) == Approx(1e-3).epsilon(1e-12));
  CHECK(largest_bounding_radius(SieveCurve{{{1e-3, 0.}, {4e-3, 1.}}, spheres}) == Approx(2e-3).epsilon(1e-12));
}
