#include "dem/core/error.h"
#include "dem/loading/compression.h"
#include "dem/measure/stress.h"
#include "dem/packing/distribution.h"
#include "tests/threads.h"
#include "tests/unit/dem_measure_contacts.h"

#include <catch2/catch.hpp>

using namespace bergamo;
using namespace bergamo::dem;
using Catch::Matchers::Contains;

namespace
{

constexpr double rounding = 1e-13; // of sums of some hundred terms

/// Grains of two shapes packed closer than they touch, in a box that is closing: far from equilibrium.
Simulation closing_box()
{
  constexpr int n = 3;
  constexpr double spacing = 1.97e-3;
  std::mt19937_64 generator(3);
  Particles particles;
  for (int k = 0; k < n * n * n; ++k)
  {
    const Superquadric sphere{Vec3::Constant(1e-3), 1., 1.}, sand{{1.03e-3, 1e-3, 0.97e-3}, 0.8, 1.1};
    const Vec3 place(k / (n * n) + 0.5, k / n % n + 0.5, k % n + 0.5);
    particles.add(k % 3 == 0 ? sphere : sand, 2650., spacing * place, draw_orientation(generator));
  }
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles.weight[i] = 1. - 0.02 * static_cast<double>(i);
  SimulationParameters p;
  p.grain().young_modulus = p.wall().young_modulus = 50e6;
  p.between_grains().friction = 0.4;
  p.with_walls().friction = 0.;
  p.time_step = 2e-7;
  Box box;
  box.low = Vec3::Zero();
  box.high = Vec3::Constant(n * spacing);
  Simulation simulation(p, particles, box_walls(box));
  for (PlaneWall &wall : simulation.walls)
    wall.velocity = 0.05 * wall.normal;
  for (int step = 0; step < 40; ++step)
    simulation.step();
  simulation.compute_forces();
  return simulation;
}

} // namespace

TEST_CASE("two spheres pressed together give a compression along their branch, with the contact's weight")
{
  const Threads one_thread(1);
  // Radii of 1 mm, centres 1.999 mm apart along x: the second pushes the first to -x with w f_N, so
  // sigma_xx = -1.999 mm w f_N / V and nothing else.
  const Superquadric sphere{Vec3::Constant(1e-3), 1., 1.};
  Particles particles;
  particles.add(sphere, 2650., Vec3(1e-3, 2e-3, 3e-3), Quaternion::Identity());
  particles.add(sphere, 2650., Vec3(2.999e-3, 2e-3, 3e-3), Quaternion::Identity());
  particles.weight = {0.2, 0.8};
  Simulation simulation(SimulationParameters(), particles, {});
  simulation.compute_forces();
  const std::vector<TouchingContact> contacts = simulation.contacts.touching(simulation.particles);
  REQUIRE(contacts.size() == 1);
  CHECK((contacts[0].branch - Vec3(1.999e-3, 0., 0.)).norm() < 1e-18);

  constexpr double volume = 4e-9;
  const double force_on_first = simulation.particles.force[0].x();
  REQUIRE(force_on_first < 0.);
  const Mat3 stress = mean_stress(contacts, volume);
  Mat3 expected = Mat3::Zero();
  expected(0, 0) = 1.999e-3 * force_on_first / volume;
  CHECK((stress - expected).norm() < rounding * expected.norm());
  CHECK(force_on_first == Approx(-0.5 * contacts[0].state.forces.normal).epsilon(1e-12));
}

TEST_CASE("a branch and a tangential force give a shear stress with the branch's index first")
{
  // Body 2 lies along x and drags body 1 along z: sigma_xz = l f_T / V.
  const std::vector<TouchingContact> contacts = {measured::contact(0, 1, {2., 0., 0.}, 3., {0., 0., 0.5})};
  Mat3 expected = Mat3::Zero();
  expected(0, 0) = -2. * 3. / 4.;
  expected(0, 2) = 2. * 0.5 / 4.;
  CHECK((mean_stress(contacts, 4.) - expected).norm() < rounding);
}

TEST_CASE("lattices of touching spheres have the stress of their contacts' force")
{
  // Per sphere of a simple cubic lattice: one contact along each axis in a volume a^3. Of a face-centred one: six,
  // whose normals give sum n (x) n = 2 I, in a volume d^3/sqrt(2).
  const measured::Lattice sc = measured::simple_cubic(4, 3.), fcc = measured::face_centred_cubic(3, 3.);
  const Mat3 identity = Mat3::Identity();
  CHECK((mean_stress(sc.contacts, sc.volume()) + 3. * identity).norm() < rounding * 3.);
  const double expected = 2. * std::sqrt(2.) * 3. / (fcc.spacing * fcc.spacing);
  const Mat3 stress = mean_stress(fcc.contacts, fcc.volume());
  CHECK((stress + expected * identity).norm() < rounding * expected);
  CHECK(pressure(stress) == Approx(expected).epsilon(rounding));
  CHECK(deviatoric_stress(stress) < rounding * expected);
}

TEST_CASE("pressure, deviatoric and principal stresses of a triaxial test, whatever the frame")
{
  // Axial compression 300, lateral 100: p = 500/3, q = 200.
  const Mat3 aligned = Vec3(-100., -300., -100.).asDiagonal();
  const Mat3 q = Quaternion(0.5, -0.3, 0.7, 0.2).normalized().toRotationMatrix();
  Mat3 spin = Mat3::Zero(); // an antisymmetric part says nothing of them
  spin(0, 1) = 40.;
  spin(1, 0) = -40.;
  for (const Mat3 &stress : {aligned, Mat3(q * aligned * q.transpose()), Mat3(aligned + spin)})
  {
    CHECK(pressure(stress) == Approx(500. / 3.).epsilon(rounding));
    CHECK(deviatoric_stress(stress) == Approx(200.).epsilon(rounding));
    CHECK((principal_stresses(stress) - Vec3(-300., -100., -100.)).norm() < rounding * 300.);
  }
}

TEST_CASE("stress turns with the contacts and does not depend on which body comes first")
{
  const std::vector<TouchingContact> contacts = measured::random_contacts(50, 200, 0.3);
  const Quaternion q = Quaternion(0.4, 0.1, -0.6, 0.5).normalized();
  const Mat3 r = q.toRotationMatrix(), stress = mean_stress(contacts, 2.);
  CHECK(mean_stress(measured::exchanged(contacts), 2.) == stress);
  CHECK((mean_stress(measured::rotated(contacts, q), 2.) - r * stress * r.transpose()).norm() <
        rounding * stress.norm());
}

TEST_CASE("contacts in a packing between smooth walls give the walls' pressure")
{
  const Threads one_thread(1);
  const Simulation simulation = closing_box();
  const Particles &p = simulation.particles;
  const std::vector<TouchingContact> pairs = simulation.contacts.touching(p),
                                     walls = simulation.contacts.touching_walls(simulation.particles);
  REQUIRE(simulation.contacts.sphere_sphere[0].n_touching() > 5); // contacts of both kinds
  REQUIRE(simulation.contacts.grain_grain[0].n_touching() > 20);
  REQUIRE(walls.size() > 30);

  // Sum of what the contacts of every grain do about its centre: force_moment of pairs and walls = sum x_c (x) f over
  // the walls' contacts - sum x (x) resultant over the grains. Exact, also where grains accelerate.
  Mat3 resultants = Mat3::Zero(), boundary = Mat3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i)
    resultants += p.position[i] * p.force[i].transpose();
  double largest_overlap = 0.;
  for (const TouchingContact &wall : walls)
  {
    CHECK(wall.second == no_grain);
    boundary += contact_point(wall, p) * force_on_body1(wall).transpose();
    largest_overlap = std::max(largest_overlap, wall.state.overlap);
  }
  const Mat3 moment = force_moment(pairs) + force_moment(walls);
  CHECK((moment + resultants - boundary).norm() < rounding * boundary.norm());
  CHECK(resultants.norm() > 1e-3 * boundary.norm()); // the box is far from equilibrium

  // The points of the contacts lie within half of an overlap of the walls; a factor of two for the motion since the
  // last search.
  const Box box = box_between(simulation.walls);
  const double volume = box.volume();
  const Mat3 stress = mean_stress(pairs, volume) + mean_stress(walls, volume) + resultants / volume;
  const Vec3 on_walls = wall_pressure(simulation.walls);
  for (int d = 0; d < 3; ++d)
  {
    // At the mean place of both walls the difference of their forces does no more than the mean resultant.
    const double low = -simulation.walls[2 * d].force[d], high = simulation.walls[2 * d + 1].force[d];
    const double skew = 0.5 * (box.low[d] + box.high[d]) * (low - high) / volume;
    const double tolerance = largest_overlap * (low + high) / volume;
    CAPTURE(d, stress(d, d), on_walls[d], skew, tolerance);
    CHECK(on_walls[d] > 0.);
    CHECK(tolerance < 0.05 * on_walls[d]);
    CHECK(std::abs(stress(d, d) - (-on_walls[d] + skew)) < tolerance);
  }
}

TEST_CASE("cells that make up a lattice hold its stress among them, every contact once")
{
  // Points of contacts of the simple cubic lattice lie on the faces of some cells: a contact counts for one of them.
  measured::Lattice lattice = measured::simple_cubic(4, 3.);
  Particles particles = measured::unit_spheres(lattice.centres.size());
  particles.position = lattice.centres;
  for (Vec3 &x : particles.position) // points of contacts at whole and half places in [-1, 4)
    x += Vec3(0., 0.5, 0.5);
  Mat3 sum = Mat3::Zero();
  double volume = 0.;
  for (int k = 0; k < 8; ++k)
  {
    const Vec3 low = Vec3::Constant(-1.) + 2.5 * Vec3(k / 4, k / 2 % 2, k % 2);
    const Eigen::AlignedBox3d cell(low, low + Vec3::Constant(2.5));
    sum += cell.volume() * mean_stress(lattice.contacts, particles, cell);
    volume += cell.volume();
  }
  CHECK(volume == Approx(125.));
  CHECK((sum - force_moment(lattice.contacts)).norm() < rounding * sum.norm());

  // One cube between the centres along x = 1 .. 2: the contact along x at its middle alone.
  const Eigen::AlignedBox3d cube(Vec3(1.2, 1.2, 1.2), Vec3(1.8, 1.8, 1.8));
  Mat3 expected = Mat3::Zero();
  expected(0, 0) = -3. / (0.6 * 0.6 * 0.6);
  CHECK((mean_stress(lattice.contacts, particles, cube) - expected).norm() < rounding * expected.norm());
}

TEST_CASE("a stress needs a volume")
{
  CHECK_THROWS_AS(mean_stress({}, 0.), ConfigError);
  CHECK_THROWS_WITH(mean_stress({}, -2.), Contains("volume of the stress is -2") && Contains("positive"));
  CHECK_THROWS_AS(mean_stress({}, Particles(), Eigen::AlignedBox3d()), ConfigError);
  CHECK(mean_stress({}, 1.) == Mat3::Zero());
}
