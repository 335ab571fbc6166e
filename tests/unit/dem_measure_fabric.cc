#include "dem/measure/coordination.h"
#include "dem/measure/fabric.h"
#include "tests/unit/dem_measure_contacts.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace bergamo;
using namespace bergamo::dem;
using measured::contact;

namespace
{

constexpr double rounding = 1e-13; // of sums of some hundred terms

/// Five grains that all touch each other, four contacts each, then a chain 4-5-6-7 and the lone grain 8.
std::vector<TouchingContact> cluster_with_chain()
{
  std::vector<TouchingContact> contacts;
  for (int i = 0; i < 5; ++i)
    for (int j = i + 1; j < 5; ++j)
      contacts.push_back(contact(i, j));
  for (int i = 4; i < 7; ++i)
    contacts.push_back(contact(i, i + 1));
  return contacts;
}

} // namespace

TEST_CASE("lattices have their coordination numbers and an isotropic fabric")
{
  const measured::Lattice sc = measured::simple_cubic(4, 1.), fcc = measured::face_centred_cubic(3, 1.);
  for (const auto &[lattice, expected] : {std::pair{sc, 6.}, std::pair{fcc, 12.}})
  {
    const CoordinationNumbers z =
        coordination_numbers(measured::unit_spheres(lattice.centres.size()), lattice.contacts);
    CHECK(z.mean == expected);
    CHECK(z.mechanical == expected);
    CHECK(z.without_rattlers == expected);
    CHECK(z.n_rattlers == 0);
    const Mat3 fabric = fabric_tensor(lattice.contacts);
    CHECK((fabric - Mat3::Identity() / 3.).norm() < rounding);
    CHECK(fabric_anisotropy(fabric) < rounding * 7.5);
  }
}

TEST_CASE("rattlers are removed until none is left")
{
  // 13 contacts of 9 grains: 2 x 13 / 9. Without the lone grain and grain 7, which has one: (26 - 1) / 7. The chain
  // falls from its end, 7, 6, 5; the cluster keeps its four contacts each.
  const Particles particles = measured::unit_spheres(9);
  const CoordinationNumbers z = coordination_numbers(particles, cluster_with_chain());
  CHECK(z.mean == Approx(26. / 9.).epsilon(rounding));
  // Numbers 4, 4, 4, 4, 5, 2, 2, 1 and 0: their squares add up to 98.
  CHECK(z.deviation == Approx(std::sqrt(98. / 9. - 26. * 26. / 81.)).epsilon(rounding));
  CHECK(z.mechanical == Approx(25. / 7.).epsilon(rounding));
  CHECK(z.without_rattlers == 4.);
  CHECK(z.n_rattlers == 4);

  const std::vector<bool> expected = {false, false, false, false, false, true, true, true, true};
  CHECK(find_rattlers(particles, cluster_with_chain()) == expected);
  CHECK(find_rattlers(particles, cluster_with_chain(), {}, 2) == expected);
  // No grain has five contacts but grain 4, which cannot keep them.
  CHECK(find_rattlers(particles, cluster_with_chain(), {}, 5) == std::vector<bool>(9, true));
  CHECK(find_rattlers(particles, cluster_with_chain(), {}, 1) ==
        std::vector<bool>({false, false, false, false, false, false, false, false, true}));
}

TEST_CASE("a chain that holds at both ends has no rattlers where two contacts suffice")
{
  std::vector<TouchingContact> contacts = cluster_with_chain();
  contacts.push_back(contact(0, 7));
  const Particles particles = measured::unit_spheres(9);
  CHECK(find_rattlers(particles, contacts, {}, 2) ==
        std::vector<bool>({false, false, false, false, false, false, false, false, true}));
  CHECK(coordination_numbers(particles, contacts).n_rattlers == 4);
}

TEST_CASE("walls and fixed grains support, but do not count as grains")
{
  // Grain 7 and three walls: the chain's end is held, the grains between still have two contacts each.
  const std::vector<TouchingContact> walls(3, contact(7, -1));
  Particles particles = measured::unit_spheres(9);
  CoordinationNumbers z = coordination_numbers(particles, cluster_with_chain(), walls);
  CHECK(z.mean == Approx((26. + 3.) / 9.).epsilon(rounding));
  CHECK(z.mechanical == Approx(29. / 8.).epsilon(rounding));
  CHECK(z.n_rattlers == 4); // 5, 6, then 7, which has only its walls, and 8

  std::vector<TouchingContact> four_walls = walls;
  four_walls.push_back(contact(7, -1));
  z = coordination_numbers(particles, cluster_with_chain(), four_walls);
  CHECK(z.n_rattlers == 3);
  CHECK(z.without_rattlers == 4.);

  // Grain 0 of the cluster fixed: the other four keep each three among them and one with it.
  particles.fix(0);
  z = coordination_numbers(particles, cluster_with_chain());
  CHECK(z.n_rattlers == 4);
  CHECK(z.without_rattlers == 4.);
  CHECK(z.mean == Approx((26. - 4.) / 8.).epsilon(rounding));

  // A fixed end of the chain holds it where two contacts suffice, with one contact itself.
  particles = measured::unit_spheres(9);
  particles.fix(7);
  CHECK(find_rattlers(particles, cluster_with_chain(), {}, 2) ==
        std::vector<bool>({false, false, false, false, false, false, false, false, true}));
}

TEST_CASE("an assembly without contacts has coordination numbers and fabric of zero")
{
  const CoordinationNumbers z = coordination_numbers(measured::unit_spheres(3), {});
  CHECK(z.mean == 0.);
  CHECK(z.deviation == 0.);
  CHECK(z.mechanical == 0.);
  CHECK(z.without_rattlers == 0.);
  CHECK(z.n_rattlers == 3);
  CHECK(coordination_numbers(Particles(), {}).mean == 0.);
  CHECK(fabric_tensor({}) == Mat3::Zero());
}

TEST_CASE("fabric of parallel contacts")
{
  const std::vector<TouchingContact> contacts = {contact(0, 1, {0., 0., 2.}, 1.), contact(1, 2, {0., 0., -3.}, 5.)};
  const Mat3 expected = Vec3(0., 0., 1.).asDiagonal();
  const Mat3 fabric = fabric_tensor(contacts);
  CHECK((fabric - expected).norm() < rounding);
  CHECK(equivalent(fabric) == Approx(1.).epsilon(rounding));
  CHECK(fabric_anisotropy(fabric) == Approx(7.5).epsilon(rounding));
}

TEST_CASE("fabric counts contacts whatever their forces and weights")
{
  std::vector<TouchingContact> contacts = {contact(0, 1, Vec3::UnitX(), 5.), contact(1, 2, Vec3::UnitY(), 1.),
                                           contact(2, 3, Vec3::UnitY(), 1.), contact(3, 4, Vec3::UnitZ(), 1.)};
  contacts[0].state.weight = 0.1;
  const Mat3 expected = Vec3(0.25, 0.5, 0.25).asDiagonal();
  CHECK((fabric_tensor(contacts) - expected).norm() < rounding);
}

TEST_CASE("anisotropy is the difference of the normals' density along and across the axis")
{
  // Density (1 + b (3 cos^2 - 1)) / 4 pi, b = 0.2: along less across 3 b = 0.6. z = cos(theta) is distributed by
  // F(z) = z + b (z^3 - z) on [0, 1], drawn at the middles of n equal shares: mean z^2 is off by less than 1/n.
  constexpr double b = 0.2;
  constexpr int n = 4000;
  std::vector<TouchingContact> contacts;
  for (int k = 0; k < n; ++k)
  {
    const double share = (k + 0.5) / n;
    double z = share;
    for (int newton = 0; newton < 30; ++newton)
      z -= (z + b * (z * z * z - z) - share) / (1. + b * (3. * z * z - 1.));
    const double rho = std::sqrt(1. - z * z);
    for (int quarter = 0; quarter < 4; ++quarter)
    {
      const double angle = 0.5 * std::numbers::pi * quarter;
      contacts.push_back(contact(0, 1, {rho * std::cos(angle), rho * std::sin(angle), z}, 1.));
    }
  }
  const Mat3 fabric = fabric_tensor(contacts);
  CHECK(fabric.trace() == Approx(1.).epsilon(1e-12));
  CHECK(fabric_anisotropy(fabric) == Approx(3. * b).margin(7.5 * 1.5 / n)); // F' has 3/2 of the error of mean z^2
}

TEST_CASE("fabric and coordination do not depend on which body comes first, and fabric turns with the contacts")
{
  const std::vector<TouchingContact> contacts = measured::random_contacts(50, 200, 0.3);
  const Particles particles = measured::unit_spheres(50);
  const Quaternion q = Quaternion(0.4, 0.1, -0.6, 0.5).normalized();
  const Mat3 r = q.toRotationMatrix(), fabric = fabric_tensor(contacts);
  CHECK(fabric_tensor(measured::exchanged(contacts)) == fabric);
  const Mat3 turned = fabric_tensor(measured::rotated(contacts, q));
  CHECK((turned - r * fabric * r.transpose()).norm() < rounding);
  CHECK(fabric_anisotropy(turned) == Approx(fabric_anisotropy(fabric)).epsilon(1e-12));

  const CoordinationNumbers z = coordination_numbers(particles, contacts),
                            other = coordination_numbers(particles, measured::exchanged(contacts));
  CHECK(z.mean == 8.);
  CHECK(z.n_rattlers > 0);
  CHECK(z.n_rattlers < 50);
  CHECK(z.n_rattlers == other.n_rattlers);
  CHECK(z.without_rattlers == other.without_rattlers);
}
