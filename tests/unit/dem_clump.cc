#include "dem/core/error.h"
#include "dem/geometry/clump_mass.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double pi = std::numbers::pi;

Superquadric sphere(const double radius)
{
  return {Vec3::Constant(radius), 1., 1.};
}

/// Spheres with their centres on the z axis: volume, centre and moments of their union by its profile, squares of its
/// radius rho^2 = max (R_i^2 - (z - z_i)^2), a polynomial between the places where two spheres meet.
struct Profile
{
  double volume = 0., first = 0., along = 0., across = 0.; ///< int 1, z, z^2, x^2

  explicit Profile(const std::vector<std::pair<double, double>> &spheres) ///< radius and place
  {
    std::vector<double> places;
    for (const auto &[r, z] : spheres)
    {
      places.push_back(z - r);
      places.push_back(z + r);
      for (const auto &[s, y] : spheres)
        if (y != z)
          places.push_back((r * r - s * s + y * y - z * z) / (2. * (y - z)));
    }
    std::sort(places.begin(), places.end());
    // Gauss' rule of three points is exact to the fifth power; the highest one, rho^4, is of the fourth.
    constexpr double node = 0.7745966692414834;
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
    {
      const double half = 0.5 * (places[k + 1] - places[k]), middle = places[k] + half;
      for (const auto &[t, weight] : {std::pair(-node, 5. / 9.), std::pair(0., 8. / 9.), std::pair(node, 5. / 9.)})
      {
        const double z = middle + half * t;
        double square = 0.;
        for (const auto &[r, y] : spheres)
          square = std::max(square, r * r - (z - y) * (z - y));
        const double disk = pi * square * weight * half;
        volume += disk;
        first += disk * z;
        along += disk * z * z;
        across += disk * square / 4.;
      }
    }
  }
};

void check_same(const MassProperties &a, const MassProperties &b, const double tolerance)
{
  CHECK(std::abs(a.volume - b.volume) <= tolerance);
  CHECK((a.centre - b.centre).norm() <= tolerance);
  CHECK((a.inertia - b.inertia).norm() <= tolerance);
}

const Superquadric box_like{{0.5, 0.9, 0.7}, 0.4, 0.6}, pointed{{0.8, 0.4, 0.6}, 1.4, 1.2};
const Quaternion turn = Quaternion(0.5, 0.3, -0.2, 0.7).normalized();

} // namespace

TEST_CASE("a clump of one part is that part, bit for bit")
{
  for (const Superquadric &shape : {box_like, pointed, sphere(0.3)})
  {
    const MassProperties mass = mass_properties({{{shape}}});
    CHECK(mass.volume == volume(shape));
    CHECK(mass.inertia == inertia_per_density(shape));
    CHECK(mass.centre == Vec3::Zero());
    CHECK(mass.orientation.coeffs() == Quaternion::Identity().coeffs());
    CHECK(mass.volume_error == 0.);
    CHECK(bounding_radius(ClumpShape{{{shape}}}) == bounding_radius(shape));

    // Given twice, in either sign of its orientation, or with another part inside, it is the same body.
    const ClumpPart part{shape, Vec3(1., 2., 3.), turn};
    ClumpPart twin = part, core{sphere(0.05), part.position + Vec3(0.02, 0., 0.01), turn};
    twin.orientation.coeffs() *= -1.;
    const ClumpShape twice{{part, twin}}, filled{{core, part}};
    for (const MassProperties &same : {mass_properties({{part}}), mass_properties(twice), mass_properties(filled)})
    {
      CHECK(same.volume == volume(shape));
      CHECK(same.inertia == inertia_per_density(shape));
      CHECK(same.centre == part.position);
      CHECK(same.orientation.coeffs() == turn.coeffs());
      CHECK(same.volume_error == 0.);
    }
  }
}

TEST_CASE("parts apart add up exactly")
{
  // Closed forms and Steiner's theorem. The spheres about both bodies cross, the bodies do not. Rounding of a few
  // terms.
  const Superquadric slab{{1., 1., 0.1}, 0.3, 0.3};
  const ClumpShape clump{{{slab, Vec3(0., 0., 0.11)}, {slab, Vec3(0.4, 0., -0.11)}}};
  const MassProperties mass = mass_properties(clump);
  const double v = volume(slab);
  const Vec3 own = inertia_per_density(slab);
  CHECK(std::abs(mass.volume - 2. * v) <= 1e-15 * v);
  CHECK(mass.volume_error == 0.);
  CHECK((mass.centre - Vec3(0.2, 0., 0.)).norm() < 1e-15);
  // About the centre: I = 2 (own + v (|a|^2 1 - a a^T)), a = (0.2, 0, -0.11); in the plane of x and z a 2 x 2 problem.
  const double a = 0.2, c = 0.11;
  const double xx = 2. * (own[0] + v * c * c), yy = 2. * (own[1] + v * (a * a + c * c)), zz = 2. * (own[2] + v * a * a),
               xz = 2. * v * a * c;
  const double mean = 0.5 * (xx + zz), radius = std::hypot(0.5 * (xx - zz), xz);
  std::vector<double> moments{mean - radius, mean + radius, yy};
  std::sort(moments.begin(), moments.end());
  for (int d = 0; d < 3; ++d)
    CHECK(std::abs(mass.inertia[d] - moments[d]) < 1e-14 * yy);
}

TEST_CASE("overlapping spheres have the volume, centre and moments of their profile")
{
  // Along any line, of two and of three spheres that all overlap one another; the errors lie within what is estimated,
  // and the estimate within some hundred tolerances.
  const std::vector<std::vector<std::pair<double, double>>> chains{
      {{1., 0.}, {1., 1.2}}, {{1., 0.}, {0.6, 0.9}}, {{1., 0.}, {0.7, 0.8}, {0.5, 1.1}}};
  for (const auto &chain : chains)
    for (const Vec3 &line : {Vec3(0., 0., 1.), Vec3(1., 0., 0.), Vec3(1. / 3., 2. / 3., -2. / 3.)})
    {
      const Vec3 origin(0.3, -0.2, 0.1);
      ClumpShape clump;
      for (const auto &[r, z] : chain)
        clump.parts.push_back({sphere(r), origin + z * line});
      const Profile exact(chain);
      const double place = exact.first / exact.volume, along = exact.along - exact.volume * place * place;
      const Vec3 moments(2. * exact.across, exact.across + along, exact.across + along);
      for (const double tolerance : {1e-3, 1e-5})
      {
        const MassProperties mass = mass_properties(clump, tolerance);
        CAPTURE(chain.size(), line.transpose(), tolerance, mass.volume_error);
        CHECK(mass.volume_error < 300. * tolerance);
        CHECK(std::abs(mass.volume - exact.volume) <= mass.volume_error);
        CHECK((mass.centre - origin - place * line).norm() <= mass.centre_error);
        for (int d = 0; d < 3; ++d)
          CHECK(std::abs(mass.inertia[d] - moments[d]) <= 3. * mass.inertia_error);
        CHECK(std::abs(std::abs((mass.orientation * Vec3::UnitX()).dot(line)) - 1.) < 1e-3);
      }
    }
}

TEST_CASE("errors of the union fall with the tolerance")
{
  // Two spheres across the axes; then two sharp-edged boxes, shifted, crossed and turned by 45 degrees (an octagon is
  // shared); corners of exponent 1e-6 miss 1e-12.
  const double distance = 1.2, lens = pi * (4. + distance) * (2. - distance) * (2. - distance) / 12.;
  const ClumpShape spheres{{{sphere(1.)}, {sphere(1.), distance * Vec3(1., 2., 2.) / 3.}}};
  double before = 1.;
  for (const double tolerance : {1e-3, 1e-5, 1e-7})
  {
    const MassProperties mass = mass_properties(spheres, tolerance);
    const double error = std::abs(mass.volume - 8. / 3. * pi + lens);
    CHECK(error <= mass.volume_error);
    CHECK(mass.volume_error < before);
    before = mass.volume_error;
  }
  CHECK(before < 1e-7);

  const auto check = [](const ClumpShape &clump, const double expected)
  {
    const MassProperties mass = mass_properties(clump);
    CHECK(std::abs(mass.volume - expected) <= mass.volume_error);
    CHECK(mass.volume_error < 1e-5);
  };
  const Superquadric box{{1., 0.7, 0.5}, 1e-6, 1e-6}, beam{{1., 0.2, 0.2}, 1e-6, 1e-6};
  check({{{box}, {box, Vec3(0.3, 0.2, 0.1)}}}, 2. * 2.8 - 1.7 * 1.2 * 0.9);
  const auto crossed = [&](const double angle) {
    return ClumpShape{{{beam}, {beam, Vec3::Zero(), Quaternion(Eigen::AngleAxisd(angle, Vec3::UnitZ()))}}};
  };
  check(crossed(0.5 * pi), 2. * 0.32 - 0.064);
  check(crossed(0.25 * pi), 2. * 0.32 - 0.4 * 0.4 * 0.4 * std::sqrt(2.));
}

TEST_CASE("any clump agrees with points thrown at it, in any order of its parts and any frame")
{
  // n points in a box about the body: deviation sqrt(q (1 - q)/n) of the share q that hits, five of them.
  const ClumpShape clump{{{box_like}, {pointed, Vec3(0.5, 0.3, 0.2), turn}, {sphere(0.5), Vec3(-0.4, 0.6, 0.)}}};
  const MassProperties mass = mass_properties(clump, 1e-4);
  std::mt19937_64 generator(7);
  const double radius = bounding_radius(clump);
  std::uniform_real_distribution<double> uniform(-radius, radius);
  constexpr int n = 200000;
  int hits = 0;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < n; ++i)
  {
    const Vec3 x(uniform(generator), uniform(generator), uniform(generator));
    if (!contains(clump, x))
      continue;
    ++hits;
    sum += x;
  }
  const double box = std::pow(2. * radius, 3), share = mass.volume / box;
  CHECK(std::abs(double(hits) / n - share) < 5. * std::sqrt(share * (1. - share) / n));
  CHECK((sum / hits - mass.centre).cwiseAbs().maxCoeff() < 5. * radius / std::sqrt(hits));

  const ClumpShape reversed{{clump.parts[2], clump.parts[1], clump.parts[0]}};
  check_same(mass_properties(reversed, 1e-4), mass, 1e-14);

  // In its principal frame: centre and axes at rest, the same moments, within the error of the integrals.
  const ClumpShape principal = in_principal_frame(clump, mass);
  const MassProperties again = mass_properties(principal, 1e-4);
  CHECK(std::abs(again.volume - mass.volume) <= 2. * mass.volume_error);
  CHECK(again.centre.norm() <= 2. * mass.centre_error);
  CHECK((again.inertia - mass.inertia).norm() <= 4. * mass.inertia_error);
  CHECK(again.orientation.toRotationMatrix().cwiseAbs().diagonal().minCoeff() > 0.999);
  CHECK(mass.inertia[0] <= mass.inertia[1]);
  CHECK(mass.inertia[1] <= mass.inertia[2]);
  CHECK(std::abs(mass.orientation.toRotationMatrix().determinant() - 1.) < 1e-14);
  for (int i = 0; i < 1000; ++i)
  {
    const Vec3 x(uniform(generator), uniform(generator), uniform(generator));
    const Vec3 moved = mass.orientation.conjugate() * (x - mass.centre);
    CHECK(contains(principal, moved) == contains(clump, x));
    if (contains(principal, moved))
      CHECK(moved.norm() <= bounding_radius(principal));
  }
}

TEST_CASE("impossible clumps are refused")
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(ClumpShape{}.validate(), Catch::Contains("parts of a clump is 0"));
  CHECK_THROWS_AS(mass_properties(ClumpShape{}), ConfigError);
  for (const double wrong : {nan, infinite, -infinite})
  {
    CHECK_THROWS_WITH(mass_properties({{{sphere(1.), Vec3(0., wrong, 0.)}}}), Catch::Contains("place"));
    CHECK_THROWS_WITH(mass_properties({{{sphere(1.), Vec3::Zero(), Quaternion(wrong, 0., 0., 0.)}}}),
                      Catch::Contains("orientation"));
    CHECK_THROWS_WITH(mass_properties({{{sphere(wrong)}}}), Catch::Contains("half-axis"));
    CHECK_THROWS_WITH(mass_properties({{{sphere(1.)}}}, wrong), Catch::Contains("tolerance"));
  }
  CHECK_THROWS_AS(mass_properties({{{sphere(1.), Vec3::Zero(), Quaternion(0., 0., 0., 0.)}}}), ConfigError);
  CHECK_THROWS_AS(mass_properties({{{sphere(1.)}}}, 0.), ConfigError);
}
