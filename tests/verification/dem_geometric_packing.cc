#include "dem/core/error.h"
#include "dem/geometry/common_normal.h"
#include "dem/packing/pack_grains.h"
#include "tests/threads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

// Packings made geometrically, after Wellmann 3.4.4: random addition and tightening.

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// No overlap, by the full search over all pairs and images; returns the pairs near enough to be searched.
int count_near_pairs(const Particles &p, const PackingSpace &space)
{
  int n_near = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j)
    {
      const Vec3 line = space.nearest_image(p.position[j] - p.position[i]);
      if (line.norm() >= p.bounding_radius[i] + p.bounding_radius[j])
        continue;
      ++n_near;
      const ContactGeometry g = find_contact(make_pose(p.parts.shape[i], Vec3::Zero(), p.orientation[i]),
                                             make_pose(p.parts.shape[j], line, p.orientation[j]));
      REQUIRE(g.status == ContactStatus::separated);
    }
  return n_near;
}

/// Points of the surface of a grain, not from its support function.
std::vector<Vec3> surface_of(const Particles &p, const std::size_t i)
{
  constexpr double pi = std::numbers::pi;
  std::vector<Vec3> points;
  for (int j = -16; j <= 16; ++j)
    for (int k = -16; k < 16; ++k)
      points.push_back(p.position[i] +
                       p.orientation[i] * surface_point(p.parts.shape[i], 0.5 * pi * j / 16, pi * k / 16));
  return points;
}

double solid_volume(const Particles &p)
{
  double sum = 0.;
  for (const Superquadric &grain : p.parts.shape)
    sum += volume(grain);
  return sum;
}

PackingSpace periodic_cube(const double edge)
{
  return PackingSpace::periodic({Vec3::Zero(), Vec3::Constant(edge)});
}

bool same_bits(const Particles &a, const Particles &b)
{
  const auto same = [](const auto &x, const auto &y)
  { return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0; };
  return same(a.position, b.position) && same(a.orientation, b.orientation) && same(a.mass, b.mass);
}

/// Largest distance of two empirical distribution functions.
double kolmogorov_smirnov(std::vector<double> a, std::vector<double> b)
{
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double largest = 0.;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const auto below = std::lower_bound(b.begin(), b.end(), a[i]) - b.begin();
    const double share = static_cast<double>(below) / b.size();
    largest = std::max({largest, std::abs(share - static_cast<double>(i) / a.size()),
                        std::abs(share - static_cast<double>(i + 1) / a.size())});
  }
  return largest;
}

} // namespace

TEST_CASE("sand in a periodic cube of 10 mm at a solid fraction of 0.55")
{
  const PackingSpace space = periodic_cube(10e-3);
  const PackedGrains packed = pack_grains({}, space, {}, 11);
  const Particles &p = packed.particles;
  const PackingReport &report = packed.report;
  const std::size_t n = p.size();
  REQUIRE(n > 1500);
  CHECK(report.has_reached_target);
  CHECK(std::abs(report.solid_fraction - 0.55) < 0.001);
  CHECK(solid_volume(p) / space.volume() == Approx(report.solid_fraction).epsilon(1e-12));
  CHECK(count_near_pairs(p, space) > 3000);
  for (std::size_t i = 0; i < n; ++i)
    REQUIRE((p.position[i] == space.wrap(p.position[i])));

  // Sizes: each grain has the size drawn for it, times one factor for all near 1 (fig. 3.21).
  CHECK(report.smallest_size == 1.);
  CHECK(std::abs(report.size_factor - 1.) < 0.001);
  std::mt19937_64 generator(11), other(99);
  const auto drawn = draw_grains({}, 0.55 * space.volume(), generator);
  REQUIRE(drawn.size() == n);
  std::vector<double> diameters, expected;
  for (std::size_t i = 0; i < n; ++i)
  {
    REQUIRE((p.parts.shape[i].half_axes - report.size_factor * drawn[i].half_axes).norm() < 1e-14);
    diameters.push_back(2. * equivalent_radius(p.parts.shape[i]));
  }
  // And another sample of the sand does not tell from them: two-sided Kolmogorov-Smirnov, level 0.001.
  for (int i = 0; i < 20000; ++i)
    expected.push_back(2. * equivalent_radius(draw_grain(GrainDistribution(), other)));
  CHECK(kolmogorov_smirnov(diameters, expected) < 1.95 * std::sqrt(1. / n + 1. / 20000.));

  // No direction is preferred: the second moments of n uniform directions scatter by sqrt(4/45/n) about 1/3 on the
  // diagonal, by sqrt(1/15/n) about 0 beside it. For the longest and the shortest axis.
  for (const bool is_longest : {true, false})
  {
    Mat3 moments = Mat3::Zero();
    for (std::size_t i = 0; i < n; ++i)
    {
      int d;
      is_longest ? p.parts.shape[i].half_axes.maxCoeff(&d) : p.parts.shape[i].half_axes.minCoeff(&d);
      const Vec3 axis = p.orientation[i] * Vec3::Unit(d);
      moments += axis * axis.transpose() / static_cast<double>(n);
    }
    CHECK((moments - Mat3::Identity() / 3.).cwiseAbs().maxCoeff() < 4. * std::sqrt(4. / 45. / n));
  }

  // No place is preferred: solid volume in eighths of the cube, and in slabs across each edge. Independent grains would
  // scatter by sqrt(N <v^2>/<v>^2 p (1 - p)) / N in a share p; in a packing they keep apart, and scatter less.
  double square = 0., all = solid_volume(p);
  for (const Superquadric &grain : p.parts.shape)
    square += std::pow(volume(grain), 2);
  const auto bound = [&](const double share) { return 4. * std::sqrt(square * share * (1. - share)) / all; };
  std::vector<double> eighths(8, 0.), slabs(3 * 5, 0.);
  for (std::size_t i = 0; i < n; ++i)
  {
    int eighth = 0;
    for (int d = 0; d < 3; ++d)
    {
      const double x = p.position[i][d] / 10e-3;
      eighth += (x >= 0.5 ? 1 : 0) << d;
      slabs[5 * d + std::min(4, static_cast<int>(5. * x))] += volume(p.parts.shape[i]) / all;
    }
    eighths[eighth] += volume(p.parts.shape[i]) / all;
  }
  for (const double share : eighths)
    CHECK(std::abs(share - 0.125) < bound(0.125));
  for (const double share : slabs)
    CHECK(std::abs(share - 0.2) < bound(0.2));
}

TEST_CASE("random addition prefers no place")
{
  // At a solid fraction of 0.1 centres are nearly independent: a share p of n grains scatters by sqrt(p (1 - p)/n).
  const PackingSpace space = periodic_cube(17e-3);
  std::mt19937_64 generator(21);
  auto grains = draw_grains({}, 0.1 * space.volume(), generator);
  const GrainPlaces places = place_at_random(grains, space, 22).places;
  const double n = static_cast<double>(grains.size());
  REQUIRE(n > 1400.);
  std::vector<double> slabs(3 * 5, 0.);
  for (const Vec3 &x : places.position)
    for (int d = 0; d < 3; ++d)
      slabs[5 * d + std::min(4, static_cast<int>(5. * x[d] / 17e-3))] += 1. / n;
  for (const double share : slabs)
    CHECK(std::abs(share - 0.2) < 4. * std::sqrt(0.16 / n));
}

TEST_CASE("packings in a box, a cylinder and a polyhedron keep inside")
{
  const double edge = 7e-3;
  const auto check = [&](const PackingSpace &space, const auto &distance_outside)
  {
    PackingParameters parameters;
    parameters.solid_fraction = 0.5;
    parameters.start_solid_fraction = 0.22; // the middle is denser: centres keep away from the walls
    const PackedGrains packed = pack_grains({}, space, parameters, 5);
    CHECK(packed.report.has_reached_target);
    CHECK(std::abs(solid_volume(packed.particles) / space.volume() - 0.5) < 0.001);
    REQUIRE(packed.particles.size() > 100);
    CHECK(count_near_pairs(packed.particles, space) > 100);
    double nearest = -edge;
    for (std::size_t i = 0; i < packed.particles.size(); ++i)
      for (const Vec3 &x : surface_of(packed.particles, i))
        nearest = std::max(nearest, distance_outside(x));
    CHECK(nearest < 1e-15);
    CHECK(nearest > -0.02e-3); // grains come near the walls
  };
  SECTION("box")
  {
    check(Box{Vec3::Zero(), Vec3::Constant(edge)},
          [&](const Vec3 &x) { return std::max(-x.minCoeff(), x.maxCoeff() - edge); });
  }
  SECTION("cylinder")
  {
    const double radius = 0.5 * edge;
    check(PackingSpace::cylinder(Vec3(radius, -radius, 1e-3), radius, edge),
          [&](const Vec3 &x) {
            return std::max({1e-3 - x[2], x[2] - 1e-3 - edge, std::hypot(x[0] - radius, x[1] + radius) - radius});
          });
  }
  SECTION("polyhedron: a box without a corner")
  {
    std::vector<HalfSpace> planes;
    for (int d = 0; d < 3; ++d)
    {
      planes.push_back({-Vec3::Unit(d), 0.});
      planes.push_back({Vec3::Unit(d), edge});
    }
    planes.push_back({Vec3::Ones(), 2.2 * edge});
    check(PackingSpace::polyhedron(planes),
          [&](const Vec3 &x) {
            return std::max({-x.minCoeff(), x.maxCoeff() - edge, (x.sum() - 2.2 * edge) / std::sqrt(3.)});
          });
  }
}

TEST_CASE("packings have the same bits on any number of threads")
{
  const auto check = [](const PackingSpace &space)
  {
    const auto pack = [&](const int n_threads, const std::uint64_t seed)
    {
      const Threads threads(n_threads);
      PackingParameters parameters;
      parameters.solid_fraction = 0.5;
      return pack_grains({}, space, parameters, seed).particles;
    };
    const Particles alone = pack(1, 3);
    REQUIRE(alone.size() > 200);
    for (const int n_threads : {2, 3, 8})
      CHECK(same_bits(pack(n_threads, 3), alone));
    CHECK_FALSE(same_bits(pack(1, 4), alone));
  };
  SECTION("periodic")
  {
    check(periodic_cube(6.2e-3));
  }
  SECTION("cylinder")
  {
    check(PackingSpace::cylinder(Vec3::Zero(), 3.3e-3, 7e-3));
  }
}

TEST_CASE("a packing by its sieve curve")
{
  PackingParameters parameters;
  parameters.solid_fraction = 0.5;
  const PackingSpace space = periodic_cube(6e-3);
  const SieveCurve curve = SieveCurve::through(0.35e-3, 0.5e-3, 0.55e-3, {1.4, 0.3});
  const PackedGrains packed = pack_grains(curve, space, parameters, 2);
  CHECK(packed.report.has_reached_target);
  CHECK(packed.report.smallest_size == 1.);
  CHECK(count_near_pairs(packed.particles, space) > 1000);
  for (const Superquadric &grain : packed.particles.parts.shape)
  {
    REQUIRE(sieve_size(grain) >= packed.report.size_factor * curve.points.front().size * (1. - 1e-12));
    REQUIRE(sieve_size(grain) <= packed.report.size_factor * curve.points.back().size * (1. + 1e-12));
  }
}

TEST_CASE("packings that cannot be are refused")
{
  const auto pack = [](const PackingSpace &space, const PackingParameters &parameters = {})
  { return pack_grains({}, space, parameters, 1); };
  CHECK_THROWS_WITH(pack(periodic_cube(2.5e-3)),
                    Catch::Contains("along x is 0.0025 m") && Catch::Contains("larger box"));
  CHECK_THROWS_WITH(pack(Box{Vec3::Zero(), Vec3(20e-3, 20e-3, 0.3e-3)}), Catch::Contains("shortest edge"));
  CHECK_THROWS_WITH(pack(Box{Vec3::Zero(), Vec3::Constant(0.2e-3)}), Catch::Contains("whole grains"));
  PackingParameters parameters;
  parameters.solid_fraction = 0.9;
  CHECK_THROWS_WITH(pack(periodic_cube(10e-3), parameters),
                    Catch::Contains("solid fraction of the packing is 0.9") && Catch::Contains("compression"));
  parameters = {};
  parameters.start_solid_fraction = 0.5;
  CHECK_THROWS_WITH(pack(periodic_cube(10e-3), parameters), Catch::Contains("random addition is 0.5"));
  parameters = {};
  parameters.tightening.size_step = 0.;
  CHECK_THROWS_WITH(pack(periodic_cube(10e-3), parameters), Catch::Contains("size step"));
}

TEST_CASE("a packing that gets stuck says how far it came")
{
  // One iteration grows the sizes by the size step at most.
  PackingParameters parameters;
  parameters.tightening.max_iterations = 10;
  const PackedGrains packed = pack_grains({}, periodic_cube(6e-3), parameters, 1);
  CHECK_FALSE(packed.report.has_reached_target);
  CHECK(packed.report.tightening.size() == 10);
  const double largest = 0.26 * std::pow(1.0015, 30.);
  CHECK(packed.report.solid_fraction < largest * (1. + 1e-9));
  CHECK(packed.report.solid_fraction > 0.26);
  CHECK(packed.report.smallest_size < 1.);
  CHECK(solid_volume(packed.particles) / std::pow(6e-3, 3) == Approx(packed.report.solid_fraction).epsilon(1e-12));
}

TEST_CASE("a packing that is stopped ends with the iteration, until then the same bits")
{
  PackingParameters parameters;
  int n_asked = 0;
  parameters.tightening.is_stopped = [&] { return n_asked++ == 10; };
  const PackedGrains stopped = pack_grains({}, periodic_cube(6e-3), parameters, 1);
  CHECK(stopped.report.tightening.size() == 10);
  CHECK_FALSE(stopped.report.has_reached_target);
  parameters = {};
  parameters.tightening.max_iterations = 10;
  CHECK(same_bits(stopped.particles, pack_grains({}, periodic_cube(6e-3), parameters, 1).particles));
}
