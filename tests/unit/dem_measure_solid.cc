#include "dem/core/error.h"
#include "dem/measure/inertial_number.h"
#include "dem/measure/solid_fraction.h"
#include "tests/threads.h"
#include "tests/unit/dem_measure_contacts.h"

#include <catch2/catch.hpp>
#include <limits>
#include <numbers>

using namespace bergamo;
using namespace bergamo::dem;
using Catch::Matchers::Contains;

namespace
{

constexpr double pi = std::numbers::pi;

double ball(const double radius)
{
  return 4. / 3. * pi * radius * radius * radius;
}

/// Cap of a sphere beyond a plane at a signed distance from its centre.
double cap(const double radius, const double distance)
{
  const double height = radius - distance;
  return pi * height * height * (3. * radius - height) / 3.;
}

double shared(const double radius1, const double radius2, const double distance)
{
  const Vec3 centre(0.3, -2., 1.);
  return shared_volume({centre, radius1}, {centre + distance * Vec3(2., -1., 2.) / 3., radius2});
}

} // namespace

TEST_CASE("spheres share a lens, the smaller one, or nothing")
{
  // Equal spheres: pi (4 r + d) (2 r - d)^2 / 12. Others: a cap of each, beyond the plane of the common circle.
  CHECK(shared(1.5, 1.5, 1.) == Approx(pi * 7. * 4. / 12.).epsilon(1e-13));
  for (const double d : {0.61, 0.8, 1.2, 1.9, 2.5, 2.59})
  {
    const double plane = (d * d + 1.6 * 1.6 - 1.) / (2. * d);
    CAPTURE(d);
    CHECK(shared(1.6, 1., d) == Approx(cap(1.6, plane) + cap(1., d - plane)).epsilon(1e-12));
    CHECK(shared(1., 1.6, d) == Approx(shared(1.6, 1., d)).epsilon(1e-13));
  }
  CHECK(shared(1.6, 1., 0.) == Approx(ball(1.)).epsilon(1e-14));
  CHECK(shared(1., 1.6, 0.59) == Approx(ball(1.)).epsilon(1e-14));
  CHECK(shared(1., 1., 0.) == Approx(ball(1.)).epsilon(1e-14));
  CHECK(shared(1., 1., 1e-9) == Approx(ball(1.) - pi * 1e-9).epsilon(1e-14)); // thinner by a disc's area times d
  CHECK(shared(1.6, 1., 2.6 * (1. + 1e-15)) == 0.);
  CHECK(shared(1.6, 1., 100.) == 0.);
  // No jump at the ends: there the volume leaves its limit with the square of the distance (pi r1 r2 / (r1 + r2)
  // outside).
  constexpr double h = 1e-6;
  CHECK(shared(1.6, 1., 2.6 - h) == Approx(pi * 1.6 / 2.6 * h * h).epsilon(1e-5));
  CHECK(ball(1.) - shared(1.6, 1., 0.6 + h) == Approx(pi * 1.6 / 0.6 * h * h).epsilon(1e-3));
}

TEST_CASE("solid fraction of grains in a volume")
{
  // A sphere of radius 1, an ellipsoid of half-axes 1, 2, 3, and a fixed grain, which is a wall.
  Particles particles = measured::unit_spheres(2);
  particles.add({{1., 2., 3.}, 1., 1.}, 1., Vec3::Zero(), Quaternion::Identity());
  particles.fix(1);
  CHECK(solid_volume(particles) == Approx(ball(1.) * 7.).epsilon(1e-12));
  CHECK(solid_fraction(particles, 50.) == Approx(ball(1.) * 7. / 50.).epsilon(1e-12));
  CHECK_THROWS_WITH(solid_fraction(particles, 0.), Contains("volume of the solid fraction is 0"));
  const std::vector<Sphere> spheres = equivalent_spheres(particles);
  REQUIRE(spheres.size() == 2);
  CHECK(spheres[1].radius == Approx(std::cbrt(6.)).epsilon(1e-12));
}

TEST_CASE("sampled solid fraction of single grains")
{
  const std::vector<Sphere> grains = {{Vec3::Zero(), 0.5}, {Vec3(1., 0., 0.), 0.25}, {Vec3(5., 0., 0.), 0.5}};
  const std::vector<Vec3> centres = {Vec3(0.2, 0., 0.), Vec3(5., 0., 0.), Vec3(20., 0., 0.), Vec3(7., 0., 0.)};
  const std::vector<double> fractions = sampled_solid_fraction(grains, centres, 2.);
  REQUIRE(fractions.size() == 4);
  CHECK(fractions[0] == Approx((0.125 + 0.015625) / 8.).epsilon(1e-13)); // two inside
  CHECK(fractions[1] == Approx(0.125 / 8.).epsilon(1e-13));
  CHECK(fractions[2] == 0.);
  CHECK(fractions[3] == Approx(shared(2., 0.5, 2.) / ball(2.)).epsilon(1e-13)); // cut
  CHECK(sampled_solid_fraction(grains, {}, 2.).empty());
  CHECK_THROWS_WITH(sampled_solid_fraction(grains, centres, 0.), Contains("radius of the sampling spheres is 0"));
}

TEST_CASE("sampling spheres all over a lattice find its solid fraction on average, on any number of threads")
{
  // Face-centred cubic: pi / sqrt(18). The sampled fraction over the place of the sphere, R = 2 d, has Fourier
  // coefficients of at most 9 / ((k r)^2 (k R)^2) times the mean (transforms of two balls); a mean over m^3 places, m =
  // 4, leaves those of k = 2 pi m n alone: 9 / (2 pi m)^4 / (r R)^2 times the lattice sum of 1/|n|^4, 16.6.
  const measured::Lattice lattice = measured::face_centred_cubic(3, 1.);
  const double r = 0.5 * lattice.spacing, radius = 2. * lattice.spacing;
  std::vector<Sphere> grains;
  for (int k = 0; k < 27; ++k)
    for (const Vec3 &centre : lattice.centres)
      grains.push_back({centre + lattice.edge * Vec3(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1), r});
  constexpr int m = 4;
  std::vector<Vec3> centres;
  for (int k = 0; k < m * m * m; ++k)
    centres.push_back(Vec3(1.1, 1.2, 1.3) + Vec3(k / (m * m), k / m % m, k % m) / m);
  std::vector<double> fractions;
  {
    const Threads one_thread(1);
    fractions = sampled_solid_fraction(grains, centres, radius);
  }
  {
    const Threads two_threads(2);
    CHECK(sampled_solid_fraction(grains, centres, radius) == fractions);
  }
  double mean = 0., least = 1., largest = 0.;
  for (const double fraction : fractions)
  {
    mean += fraction / static_cast<double>(fractions.size());
    least = std::min(least, fraction);
    largest = std::max(largest, fraction);
  }
  const double k = 2. * pi * m, tolerance = 16.6 * 9. / (std::pow(k, 4) * std::pow(r * radius, 2));
  const double expected = pi / std::sqrt(18.);
  CAPTURE(mean, expected, tolerance, least, largest);
  CHECK(tolerance < 5e-3);
  CHECK(std::abs(mean - expected) < tolerance * expected);
  CHECK(largest - least > 2. * tolerance); // single places differ
}

TEST_CASE("inertial number of an assembly's mean grain")
{
  // Spheres of diameter 2 mm and 4 mm of 2000 kg/m^3, and an ellipsoid of the volume of the first; a fixed one is none.
  Particles particles;
  const auto add = [&](const Vec3 &half_axes) {
    particles.add({half_axes, 1., 1.}, 2000., Vec3::Zero(), Quaternion::Identity());
  };
  add(Vec3::Constant(1e-3));
  add(Vec3::Constant(2e-3));
  add({0.5e-3, 1e-3, 2e-3});
  add(Vec3::Constant(9e-3));
  particles.fix(3);
  const MeanGrain grain = mean_grain(particles);
  CHECK(grain.mass == Approx(2000. * ball(1e-3) * 10. / 3.).epsilon(1e-12));
  CHECK(grain.diameter == Approx(8e-3 / 3.).epsilon(1e-12));

  // m = 9e-6 kg, d = 1 mm, p = 10 kPa: sqrt(9e-6 / 10) = 9.4868e-4 s.
  const MeanGrain round = {9e-6, 1e-3};
  CHECK(inertial_number(round, -0.5, 1e4) == Approx(0.5 * std::sqrt(9e-7)).epsilon(1e-14));
  CHECK(strain_rate_of(round, 1e-4, 1e4) == Approx(1e-4 / std::sqrt(9e-7)).epsilon(1e-14));
  CHECK(inertial_number(round, strain_rate_of(round, 1e-4, 2e5), 2e5) == Approx(1e-4).epsilon(1e-14));
  CHECK(inertial_number(round, 0.5, 0.) == std::numeric_limits<double>::infinity());
  CHECK(inertial_number(round, 0.5, -1.) == std::numeric_limits<double>::infinity());
  CHECK(strain_rate_of(round, 1e-4, -1.) == 0.);
  CHECK(mean_grain(Particles()).mass == 0.);
}
