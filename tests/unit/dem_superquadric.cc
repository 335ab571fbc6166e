#include "dem/core/error.h"
#include "dem/geometry/orientation.h"
#include "dem/geometry/superquadric.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double pi = std::numbers::pi;

/// int_0^1 f(u) du by the tanh-sinh rule, which takes end points where f has infinite slope; f gets u and 1 - u, both
/// exact.
template <class F>
double integrate(F &&f)
{
  constexpr double step = 1. / 64.;
  double sum = 0.;
  for (int k = -400; k <= 400; ++k)
  {
    const double s = 0.5 * pi * std::sinh(step * k);
    const double lower = 1. / (1. + std::exp(-2. * s)), upper = 1. / (1. + std::exp(2. * s));
    const double weight = 0.5 * pi * std::cosh(step * k) * 2. * lower * upper;
    if (lower > 0. && upper > 0. && weight > 1e-300)
      sum += weight * f(lower, upper);
  }
  return step * sum;
}

struct Moments
{
  double volume;
  Vec3 inertia;
};

/// Volume and inertia from slices: with y = x3/r3 and the slice's linear scale g(y) = (1 - y^(2/eps2))^(eps2/2), every
/// slice is the plane superellipse scaled by g, so V = 2 A r3 int g^2, int x1^2 = 2 A11 r3 int g^4, int x3^2 = 2 A r3^3
/// int y^2 g^2. The superellipse itself is sliced once more. No Gamma function enters.
Moments by_slices(const Superquadric &s)
{
  const double a = s.half_axes[0], b = s.half_axes[1], c = s.half_axes[2];
  // Half width of the unit superellipse, and 1 - u^p from 1 - u without cancellation.
  const auto width = [](const double exponent, const double u, const double one_minus_u)
  {
    const double p = 2. / exponent;
    const double rest = u > 0.5 ? -std::expm1(p * std::log1p(-one_minus_u)) : 1. - std::pow(u, p);
    return std::pow(rest, 1. / p);
  };
  const auto g1 = [&](double u, double w) { return width(s.eps1, u, w); };
  const auto g2 = [&](double u, double w) { return width(s.eps2, u, w); };
  const double area = 4. * a * b * integrate(g1);
  const double area_xx = 4. * a * a * a * b * integrate([&](double u, double w) { return u * u * g1(u, w); });
  const double area_yy = 4. * a * b * b * b * integrate([&](double u, double w) { return u * u * g1(u, w); });
  const double z0 = 2. * c * integrate([&](double u, double w) { return std::pow(g2(u, w), 2); });
  const double z2 = 2. * c * c * c * integrate([&](double u, double w) { return u * u * std::pow(g2(u, w), 2); });
  const double z4 = 2. * c * integrate([&](double u, double w) { return std::pow(g2(u, w), 4); });
  const double xx = area_xx * z4, yy = area_yy * z4, zz = area * z2;
  return {area * z0, Vec3(yy + zz, xx + zz, xx + yy)};
}

void check_relative(const double value, const double expected, const double tolerance)
{
  CHECK(std::abs(value - expected) <= tolerance * std::abs(expected));
}

} // namespace

TEST_CASE("volume and inertia of an ellipsoid")
{
  // V = 4/3 pi abc, I1 = V (b^2 + c^2)/5: exact up to the rounding of a few Gamma functions.
  const Superquadric s{{0.3, 1.7, 0.9}, 1., 1.};
  const double v = 4. / 3. * pi * 0.3 * 1.7 * 0.9;
  check_relative(volume(s), v, 1e-14);
  const Vec3 r2 = s.half_axes.cwiseAbs2(), inertia = inertia_per_density(s);
  check_relative(inertia[0], v * (r2[1] + r2[2]) / 5., 1e-14);
  check_relative(inertia[1], v * (r2[0] + r2[2]) / 5., 1e-14);
  check_relative(inertia[2], v * (r2[0] + r2[1]) / 5., 1e-14);
  check_relative(equivalent_radius(s), std::cbrt(0.3 * 1.7 * 0.9), 1e-14);
}

TEST_CASE("volume and inertia tend to those of box, cylinder and octahedron")
{
  const Vec3 r(0.4, 1.1, 0.8), r2 = r.cwiseAbs2();
  const auto check_limit =
      [&](const double eps1, const double eps2, const double v, const Vec3 &inertia, const double tolerance)
  {
    const Superquadric s{r, eps1, eps2};
    CAPTURE(eps1, eps2);
    check_relative(volume(s), v, tolerance);
    for (int d = 0; d < 3; ++d)
      check_relative(inertia_per_density(s)[d], inertia[d], tolerance);
  };
  // Box: V = 8abc, I1 = V (b^2 + c^2)/3. Rounding the edges removes volume of second order in eps: int_0^1
  // (1-u^p)^(1/p) du = 1 - zeta(2) eps^2/4 + ..., with eps^2 = 4/p^2; in all V = 8abc (1 - 3 zeta(2) eps^2/4 + ...) and
  // for the moments, whose weight sits at the edges, less than twenty times eps^2.
  const double box = 8. * r.prod();
  for (const double eps : {0.1, 0.03, 0.01, 0.003})
  {
    check_limit(eps, eps, box, box / 3. * Vec3(r2[1] + r2[2], r2[0] + r2[2], r2[0] + r2[1]), 20. * eps * eps);
    check_relative(volume({r, eps, eps}) - box, -0.75 * pi * pi / 6. * eps * eps * box, 5. * eps);
  }
  // Elliptic cylinder: V = 2 pi abc, I1 = V (b^2/4 + c^2/3), I3 = V (a^2 + b^2)/4.
  const double cylinder = 2. * pi * r.prod();
  for (const double eps : {0.1, 0.01})
    check_limit(1., eps, cylinder, cylinder * Vec3(r2[1] / 4 + r2[2] / 3, r2[0] / 4 + r2[2] / 3, (r2[0] + r2[1]) / 4),
                20. * eps * eps);
  // Octahedron: V = 4/3 abc, I1 = V (b^2 + c^2)/10; the exponents are smooth there, so first order in 2 - eps.
  const double octahedron = 4. / 3. * r.prod();
  for (const double rest : {1e-2, 1e-4, 1e-6})
    check_limit(2. - rest, 2. - rest, octahedron, octahedron / 10. * Vec3(r2[1] + r2[2], r2[0] + r2[2], r2[0] + r2[1]),
                5. * rest);
  // Double cone: eps1 = 1, eps2 = 2: V = 2/3 pi abc, I3 = V 3 (a^2 + b^2)/20, I1 = V (3 b^2/20 + c^2/10).
  const double cone = 2. / 3. * pi * r.prod();
  check_limit(1., 2. - 1e-6, cone,
              cone * Vec3(0.15 * r2[1] + 0.1 * r2[2], 0.15 * r2[0] + 0.1 * r2[2], 0.15 * (r2[0] + r2[1])), 5e-6);
}

TEST_CASE("volume and inertia of general exponents against quadrature by slices")
{
  // Tanh-sinh quadrature converges to rounding; the integrand's end slopes cost some digits at most.
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> axis(0.2, 3.), exponent(0.05, 1.95);
  for (int i = 0; i < 100; ++i)
  {
    const Superquadric s{{axis(generator), axis(generator), axis(generator)}, exponent(generator), exponent(generator)};
    const Moments reference = by_slices(s);
    CAPTURE(s.eps1, s.eps2);
    check_relative(volume(s), reference.volume, 1e-11);
    for (int d = 0; d < 3; ++d)
      check_relative(inertia_per_density(s)[d], reference.inertia[d], 1e-11);
  }
}

TEST_CASE("volume and inertia against points thrown at the inside-outside function")
{
  // Monte Carlo on a lattice shifted at random: a check of F against volume(), not of digits. n points thrown into the
  // box hit a share q with deviation sqrt(q (1-q)/n): five deviations.
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  for (const auto &[eps1, eps2] : {std::pair(0.4, 1.6), std::pair(1.5, 0.7), std::pair(0.8, 0.8)})
  {
    const Superquadric s{{0.7, 1.3, 0.5}, eps1, eps2};
    constexpr int n = 200000;
    int hits = 0;
    double moment = 0.;
    for (int i = 0; i < n; ++i)
    {
      const Vec3 x = s.half_axes.cwiseProduct(Vec3(uniform(generator), uniform(generator), uniform(generator)));
      if (inside_outside(s, x) < 1.)
      {
        ++hits;
        moment += x[0] * x[0] + x[1] * x[1];
      }
    }
    const double box = 8. * s.half_axes.prod(), share = volume(s) / box;
    CHECK(std::abs(double(hits) / n - share) < 5. * std::sqrt(share * (1. - share) / n));
    const double largest = s.half_axes[0] * s.half_axes[0] + s.half_axes[1] * s.half_axes[1]; // bounds each term
    CHECK(std::abs(moment / n * box - inertia_per_density(s)[2]) < 5. * box * largest * std::sqrt(share / n));
  }
}

TEST_CASE("points of the surface satisfy F = 1")
{
  // x_i carries a relative rounding error of a few 1e-16, magnified by the powers 2/eps: 40 at eps = 0.05, and the
  // powers of sine and cosine add as much.
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> exponent(0.05, 1.95), latitude(-0.5 * pi, 0.5 * pi), longitude(-pi, pi);
  double worst = 0.;
  for (int i = 0; i < 20000; ++i)
  {
    const Superquadric s{{0.3, 2., 1.1}, exponent(generator), exponent(generator)};
    const Vec3 x = surface_point(s, latitude(generator), longitude(generator));
    worst = std::max(worst, std::abs(inside_outside(s, x) - 1.) * std::min({s.eps1, s.eps2, 1.}));
  }
  CHECK(worst < 1e-14);

  // The poles and the axes are hit exactly.
  const Superquadric s{{0.3, 2., 1.1}, 0.5, 1.5};
  CHECK(std::abs(surface_point(s, 0.5 * pi, 0.)[2] - 1.1) < 1e-15);
  CHECK(std::abs(surface_point(s, 0., 0.)[0] - 0.3) < 1e-15);
  CHECK(std::abs(surface_point(s, 0., 0.5 * pi)[1] - 2.) < 1e-15);
  CHECK(std::abs(surface_point(s, -0.5 * pi, 0.)[2] + 1.1) < 1e-15);
}

TEST_CASE("the bounding sphere holds the body and touches it")
{
  // No point of the surface lies outside (rounding 1e-14). Samples at angles that are at most 1/500 apart miss the
  // farthest point, a smooth maximum, by less than a half times the curvature of |X| times 1/1000 squared: 1e-4 of the
  // radius suffices for a coarse search, and a local refinement by shrinking steps comes within 1e-9.
  std::mt19937_64 generator(17);
  std::uniform_real_distribution<double> axis(0.5, 3.), exponent(0.05, 1.95);
  for (int i = 0; i < 60; ++i)
  {
    const Superquadric s{{axis(generator), axis(generator), axis(generator)}, exponent(generator), exponent(generator)};
    const double radius = bounding_radius(s);
    const auto distance = [&](const double u, const double v) { return surface_point(s, u, v).norm(); };
    double best = 0., best_u = 0., best_v = 0.;
    constexpr int n = 200;
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k <= n; ++k)
        if (const double d = distance(0.5 * pi * j / n, 0.5 * pi * k / n); d > best)
        {
          best = d;
          best_u = 0.5 * pi * j / n;
          best_v = 0.5 * pi * k / n;
        }
    for (double step = 0.5 * pi / n; step > 1e-9; step *= 0.5)
      for (bool better = true; better;)
      {
        better = false;
        for (const auto &[du, dv] : {std::pair(1., 0.), std::pair(-1., 0.), std::pair(0., 1.), std::pair(0., -1.)})
        {
          const double u = std::clamp(best_u + du * step, 0., 0.5 * pi),
                       v = std::clamp(best_v + dv * step, 0., 0.5 * pi);
          if (const double d = distance(u, v); d > best)
          {
            best = d;
            best_u = u;
            best_v = v;
            better = true;
          }
        }
      }
    CAPTURE(s.half_axes.transpose(), s.eps1, s.eps2);
    CHECK(best <= radius * (1. + 1e-14));
    CHECK(best >= radius * (1. - 1e-9));
  }
  // Ellipsoid: the longest half-axis. Box limit: half the diagonal, from below at first order in eps.
  CHECK(bounding_radius({{1., 3., 2.}, 1., 1.}) == 3.);
  const double diagonal = std::sqrt(14.);
  for (const double eps : {0.1, 0.01, 0.001})
  {
    CHECK(bounding_radius({{1., 3., 2.}, eps, eps}) < diagonal);
    CHECK(bounding_radius({{1., 3., 2.}, eps, eps}) > diagonal * (1. - eps));
  }
}

TEST_CASE("impossible superquadrics are refused")
{
  const auto refused = [](const Vec3 &half_axes, const double eps1, const double eps2) {
    CHECK_THROWS_AS((Superquadric{half_axes, eps1, eps2}.validate()), ConfigError);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const double denormal = 5e-324;
  for (const double wrong : {0., -1., nan, infinite, -infinite, denormal, 1e-31, 1e31, 1e-6})
  {
    refused({wrong, 1., 1.}, 1., 1.);
    refused({1., wrong, 1.}, 1., 1.);
    refused({1., 1., wrong}, 1., 1.);
  }
  for (const double wrong : {0., -0.5, 2., 2.5, 3., 1e-9, 2. - 1e-9, nan, infinite})
  {
    refused({1., 1., 1.}, wrong, 1.);
    refused({1., 1., 1.}, 1., wrong);
  }
  CHECK_NOTHROW((Superquadric{{1e-3, 2e-3, 3e-3}, 0.05, 1.95}.validate()));
  CHECK_NOTHROW((Superquadric{{1., 1e-4, 9.9e4 * 1e-4}, 1e-6, 2. - 1e-6}.validate()));
  CHECK_THROWS_WITH((Superquadric{{1., 1e-6, 1.}, 1., 1.}.validate()),
                    Catch::Contains("ratio") && Catch::Contains("1e+06") && Catch::Contains("1e5"));
  CHECK_THROWS_WITH((Superquadric{{1., 1., 1.}, 2.5, 1.}.validate()),
                    Catch::Contains("exponent") && Catch::Contains("2.5") && Catch::Contains("(0, 2)"));
  CHECK((Superquadric{{1., 1., 1.}, 1., 1.}.is_sphere()));
  CHECK_FALSE((Superquadric{{1., 1., 1.1}, 1., 1.}.is_sphere()));
  CHECK_FALSE((Superquadric{{1., 1., 1.}, 0.9, 1.}.is_sphere()));
}

TEST_CASE("shapes at the limits have finite, positive volumes and moments of inertia")
{
  // Half-axes to the fifth power at the smallest size, 1e-150, are far from the smallest number; powers scale exactly.
  using namespace shape_limits;
  for (const double eps1 : {smallest_exponent, 0.1, 1., largest_exponent})
    for (const double eps2 : {smallest_exponent, 0.1, 1., largest_exponent})
      for (const double size : {smallest_half_axis, 1., 0.5 * largest_half_axis / largest_ratio})
      {
        const Superquadric s{size * Vec3(1., 1e5, 300.), eps1, eps2}, unit{Vec3(1., 1e5, 300.), eps1, eps2};
        CAPTURE(eps1, eps2, size);
        s.validate();
        CHECK(volume(s) > 0.);
        check_relative(volume(s) / std::pow(size, 3), volume(unit), 1e-13);
        for (int d = 0; d < 3; ++d)
        {
          CHECK(inertia_per_density(s)[d] > 0.);
          check_relative(inertia_per_density(s)[d] / std::pow(size, 5), inertia_per_density(unit)[d], 1e-13);
        }
        CHECK(bounding_radius(s) >= s.half_axes.maxCoeff());
        CHECK(bounding_radius(s) <= s.half_axes.norm() * (1. + 1e-12));
      }
}

TEST_CASE("orientations and places are checked")
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  CHECK((unit_orientation(Quaternion(0., 3., 0., 4.)).coeffs() - Quaternion(0., 0.6, 0., 0.8).coeffs()).norm() < 1e-15);
  CHECK(std::abs(unit_orientation(Quaternion(1e-99, 0., 0., 1e-99)).norm() - 1.) < 1e-15);
  CHECK(std::abs(unit_orientation(Quaternion(1e99, 0., 0., 1e99)).norm() - 1.) < 1e-15);
  for (const double wrong : {0., nan, infinite, 1e-300, 1e300})
  {
    CHECK_THROWS_AS(unit_orientation(Quaternion(wrong, 0., 0., 0.)), ConfigError);
    CHECK_THROWS_AS(unit_orientation(Quaternion(0., 0., wrong, wrong)), ConfigError);
  }
  CHECK_THROWS_WITH(unit_orientation(Quaternion(0., 0., 0., 0.)),
                    Catch::Contains("quaternion is 0") && Catch::Contains("(1, 0, 0, 0)"));
  CHECK_NOTHROW(require_finite(Vec3(1., -2., 0.), "centre"));
  CHECK_THROWS_WITH(require_finite(Vec3(1., infinite, 0.), "centre"), Catch::Contains("centre is inf"));
  CHECK_THROWS_AS(require_finite(Vec3(1., 0., nan), "centre"), ConfigError);
}
