#include "dem/core/error.h"
#include "dem/measure/force_statistics.h"
#include "dem/measure/histogram.h"
#include "tests/unit/dem_measure_contacts.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace bergamo;
using namespace bergamo::dem;
using Catch::Matchers::Contains;
using measured::contact;

namespace
{

/// Normal forces 1, 2, 3 and 6 N along x, tangential 0.5 N along y.
std::vector<TouchingContact> four_contacts()
{
  std::vector<TouchingContact> contacts;
  for (const double force : {1., 2., 3., 6.})
    contacts.push_back(contact(0, 1, Vec3::UnitX(), force, {0., 0.5, 0.}));
  contacts[0].state.weight = 0.1; // says nothing of the grains' forces
  return contacts;
}

} // namespace

TEST_CASE("a histogram holds every value once, as a density")
{
  // Bins of 0.5: the edge 0.5 belongs to the second, the end 2 to the last.
  const std::vector<double> values = {0., 0.1, 0.5, 1.99, 2., 2.01, 7., 0.4999};
  const Histogram h = histogram(values, {4, 2.});
  CHECK(h.width == 0.5);
  CHECK(h.density == std::vector<double>{3. / 8. / 0.5, 1. / 8. / 0.5, 0., 2. / 8. / 0.5});
  CHECK(h.share_above == 2. / 8.);
  CHECK(histogram({}, {2, 1.}).density == std::vector<double>{0., 0.});
}

TEST_CASE("bad bins are named")
{
  CHECK_THROWS_WITH(histogram({}, {0, 2.}), Contains("number of bins is 0") && Contains("1 or more"));
  CHECK_THROWS_WITH(histogram({}, {2, -1.}), Contains("end of the last bin is -1") && Contains("positive"));
  CHECK_THROWS_AS(direction_distribution({}, Vec3::UnitZ(), 0), ConfigError);
  CHECK_THROWS_WITH(direction_distribution({}, Vec3::Zero(), 4), Contains("length of the axis is 0"));
}

TEST_CASE("normal forces over their mean")
{
  CHECK(mean_normal_force(four_contacts()) == 3.);
  CHECK(relative_normal_forces(four_contacts()) == std::vector<double>{1. / 3., 2. / 3., 1., 2.});
  CHECK(mean_normal_force({}) == 0.);
  CHECK(relative_normal_forces(std::vector{contact(0, 1, Vec3::UnitX(), 0.)}) == std::vector<double>{0.});
}

TEST_CASE("mobilised friction and sliding contacts")
{
  // Limits 0.25 f_N = 0.25, 0.5, 0.75, 1.5 N against 0.5 N: beyond by a mistake of the caller's coefficient, at it, 2/3
  // and 1/3 of it.
  const std::vector<double> shares = mobilised_friction(four_contacts(), 0.25);
  REQUIRE(shares.size() == 4);
  CHECK(shares[0] == 1.);
  CHECK(shares[1] == 1.);
  CHECK(shares[2] == Approx(2. / 3.).epsilon(1e-14));
  CHECK(shares[3] == Approx(1. / 3.).epsilon(1e-14));
  CHECK(sliding_fraction(four_contacts(), 0.25) == 0.5);
  CHECK(sliding_fraction(four_contacts(), 0.250001) == 0.25);           // the second holds by four parts in a million
  CHECK(sliding_fraction(four_contacts(), 0.25 * (1. + 1e-13)) == 0.5); // rounding
  CHECK(sliding_fraction(four_contacts(), 0.) == 0.);
  CHECK(sliding_fraction({}, 0.25) == 0.);
  // Contacts without a normal force are among those that do not slide.
  CHECK(mobilised_friction(std::vector{contact(0, 1, Vec3::UnitX(), 0.)}, 0.3) == std::vector<double>{0.});
}

TEST_CASE("contacts of all directions have a density of one over the angle to any axis")
{
  // Normals at equal steps of cos(angle) to the axis, of either sign: a bin's count is right to one of them.
  constexpr int n = 20000, n_bins = 9;
  const Vec3 axis = Vec3(1., 2., -0.5);
  const Quaternion to_axis = Quaternion::FromTwoVectors(Vec3::UnitZ(), axis);
  std::vector<TouchingContact> contacts;
  for (int k = 0; k < n; ++k)
  {
    const double z = (k + 0.5) / n, rho = std::sqrt(1. - z * z), sign = k % 2 == 0 ? 1. : -1.;
    // Force 2 N along the axis, decreasing to 1 N across it as 1 + z.
    contacts.push_back(contact(0, 1, sign * (to_axis * Vec3(rho * std::cos(k), rho * std::sin(k), z)), 1. + z));
  }
  const DirectionDistribution directions = direction_distribution(contacts, axis, n_bins);
  REQUIRE(directions.density.size() == n_bins);
  for (int k = 0; k < n_bins; ++k)
  {
    const double low = std::cos((k + 1) * std::numbers::pi / 18.), high = std::cos(k * std::numbers::pi / 18.);
    const double tolerance = 1.01 / (n * (high - low));
    CAPTURE(k, tolerance);
    CHECK(tolerance < 0.01);
    CHECK(std::abs(directions.density[k] - 1.) < tolerance);
    CHECK(std::abs(directions.normal_force[k] - (1. + 0.5 * (low + high)) / 1.5) < tolerance);
  }
}

TEST_CASE("directions along and across an axis")
{
  const std::vector<TouchingContact> contacts = {contact(0, 1, -Vec3::UnitZ(), 3.), contact(0, 1, Vec3::UnitX(), 1.),
                                                 contact(0, 1, Vec3::UnitY(), 2.)};
  const DirectionDistribution z = direction_distribution(contacts, 5. * Vec3::UnitZ(), 3);
  const double polar = 1. - std::cos(std::numbers::pi / 6.), equatorial = 0.5;
  CHECK(z.density[0] == Approx(1. / 3. / polar).epsilon(1e-13));
  CHECK(z.density[1] == 0.);
  CHECK(z.density[2] == Approx(2. / 3. / equatorial).epsilon(1e-13));
  CHECK(z.normal_force == std::vector<double>{1.5, 0., 0.75});
}

TEST_CASE("statistics of forces do not depend on which body comes first or on the frame")
{
  const std::vector<TouchingContact> contacts = measured::random_contacts(50, 200, 0.3);
  const std::vector<TouchingContact> other = measured::exchanged(contacts);
  const Quaternion q = Quaternion(0.4, 0.1, -0.6, 0.5).normalized();
  CHECK(mean_normal_force(other) == mean_normal_force(contacts));
  CHECK(mobilised_friction(other, 0.3) == mobilised_friction(contacts, 0.3));
  const double sliding = sliding_fraction(contacts, 0.3);
  CHECK(sliding > 0.1); // a sixth is at the limit
  CHECK(sliding < 0.3);
  CHECK(sliding_fraction(measured::rotated(contacts, q), 0.3) == sliding);
  const DirectionDistribution directions = direction_distribution(contacts, Vec3::UnitX(), 6);
  CHECK(direction_distribution(other, Vec3::UnitX(), 6).density == directions.density);
  CHECK(direction_distribution(measured::rotated(contacts, q), q * Vec3::UnitX(), 6).density == directions.density);
}
