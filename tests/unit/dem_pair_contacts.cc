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

TEST_CASE("what each of two bodies would have of a contact by its own weight is known")
{
  const Threads one_thread(1);
  // The contact counts 0.5 times; by their own weights the bodies would have 0.2 and 0.8 of its force. Searched in the
  // first step, followed in the others, while they roll over one another.
  CHECK_FALSE(two_spheres(1., 1.).particles.are_weighted());
  Simulation pair = two_spheres(0.2, 0.8);
  for (int step = 0; step < 3; ++step)
  {
    pair.particles.velocity = {Vec3(0.001, 0.002, 0.), Vec3::Zero()};
    pair.compute_forces();
    const Particles &p = pair.particles;
    const TouchingContact contact = pair.contacts.touching(p)[0];
    const int first = contact.first, second = contact.second;
    const Vec3 force = contact.state.force(), half_line = 0.5 * contact.branch; // without a weight, on the first
    const Vec3 torque1 = (half_line + contact.state.point).cross(force),
               torque2 = (half_line - contact.state.point).cross(force);
    REQUIRE(force.norm() > 0.01);
    REQUIRE((step == 0 || torque2.norm() > 1e-6 * force.norm() * half_line.norm()));
    CHECK((p.transfer_force[first] - (p.weight[first] - 0.5) * force).norm() < 1e-12 * force.norm());
    CHECK((p.transfer_force[second] + (p.weight[second] - 0.5) * force).norm() < 1e-12 * force.norm());
    const double size = force.norm() * half_line.norm();
    CHECK((p.transfer_torque[first] - (p.weight[first] - 0.5) * torque1).norm() < 1e-12 * size);
    CHECK((p.transfer_torque[second] - (p.weight[second] - 0.5) * torque2).norm() < 1e-12 * size);
    pair.drift();
  }
}

TEST_CASE("a contact with a grain of weight 1 counts wholly, and transfers nothing to it")
{
  // Such a grain may lie outside of the overlap, where there is no element to take anything.
  const Threads one_thread(1);
  const auto is_superquadric = GENERATE(false, true);
  Simulation pair = two_spheres(0.4, 1.);
  if (is_superquadric)
  {
    Particles grains;
    for (const double x : {0., 1.999e-3})
      grains.add({Vec3::Constant(1e-3), 0.9, 0.9}, 2650., Vec3(x, 1e-5, 0.), Quaternion::Identity());
    grains.weight = {0.4, 1.};
    pair = Simulation(SimulationParameters(), grains, {});
  }
  pair.compute_forces();
  const Particles &p = pair.particles;
  REQUIRE(p.force[0].norm() > 0.1);
  CHECK(pair.contacts.touching(p)[0].state.weight == 1.);
  CHECK((p.transfer_force[0] + 0.6 * p.force[0]).norm() < 1e-12 * p.force[0].norm());
  CHECK(p.transfer_force[1] == Vec3::Zero());
  CHECK(p.transfer_torque[1] == Vec3::Zero());
}

TEST_CASE("a torque from outside turns a grain")
{
  Simulation pair = two_spheres(1., 1.);
  Particles &p = pair.particles;
  p.position[1] += Vec3(1e-3, 0., 0.); // apart
  pair.refresh_contacts();
  p.external_torque.assign(2, Vec3::Zero());
  p.external_torque[1] = Vec3(0., 3e-9, 4e-9);
  for (int step = 0; step < 5; ++step)
  {
    pair.step();
    CHECK(pair.energy().kinetic >= 0.);
  }
  const double time = 5. * pair.parameters().time_step;
  CHECK((p.angular_momentum[1] - time * p.external_torque[1]).norm() < 1e-14 * p.angular_momentum[1].norm());
  CHECK(p.angular_momentum[0] == Vec3::Zero());
  p.external_torque.pop_back();
  CHECK_THROWS_WITH(pair.step(), Catch::Contains("1 external torques for 2 grains"));
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
