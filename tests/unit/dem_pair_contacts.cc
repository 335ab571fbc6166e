#include "dem/simulation/simulation.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// Two spheres of radius 1 mm that overlap by 1 um along x, with given weights.
Simulation two_spheres(const double weight1, const double weight2)
{
  const Superquadric sphere{Vec3::Constant(1e-3), 1., 1.};
  Particles particles;
  particles.add(sphere, 2650., Vec3::Zero(), Quaternion::Identity());
  particles.add(sphere, 2650., Vec3(1.999e-3, 0., 0.), Quaternion::Identity());
  particles.weight = {weight1, weight2};
  return Simulation(SimulationParameters(), particles, {});
}

} // namespace

TEST_CASE("a contact counts with the weight at its place between the centres")
{
  const Threads one_thread(1);
  // Equal spheres touch half way: w = (w1 + w2) / 2 (Wellmann 6.29); force and stored energy count w times.
  Simulation plain = two_spheres(1., 1.), weighted = two_spheres(0.2, 0.8);
  plain.compute_forces();
  weighted.compute_forces();
  REQUIRE(plain.particles.force[0].norm() > 0.1);
  CHECK(weighted.contacts.touching(weighted.particles)[0].state.weight == Approx(0.5).epsilon(1e-12));
  CHECK((weighted.particles.force[0] - 0.5 * plain.particles.force[0]).norm() <
        1e-12 * plain.particles.force[0].norm());
  CHECK((weighted.particles.force[0] + weighted.particles.force[1]).norm() == 0.);
  CHECK(weighted.energy().normal == Approx(0.5 * plain.energy().normal).epsilon(1e-12));
}

TEST_CASE("a weighted grain accelerates by its weighted force over its weighted mass")
{
  const Threads one_thread(1);
  // With both weights alike, the weight cancels from the motion.
  Simulation plain = two_spheres(1., 1.), weighted = two_spheres(0.25, 0.25);
  plain.step();
  weighted.step();
  CHECK((weighted.particles.velocity[0] - plain.particles.velocity[0]).norm() <
        1e-14 * plain.particles.velocity[0].norm());
}
