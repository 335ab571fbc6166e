#include "dem/simulation/simulation.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

using namespace bergamo;
using namespace bergamo::dem;

TEST_CASE("a fixed grain stays where it is and carries what falls on it")
{
  const Threads one_thread(1);
  // A free sphere falls on a fixed one that rests on a plane and overlaps another fixed one: neither of these contacts
  // may act, and the force on the fixed one is the free one's with the opposite sign.
  constexpr double radius = 1e-3;
  const Superquadric sphere{Vec3::Constant(radius), 1., 1.};
  Particles particles;
  particles.add(sphere, 2650., Vec3(0., 0., 0.99 * radius), Quaternion::Identity());
  particles.add(sphere, 2650., Vec3(radius, 0., 0.99 * radius), Quaternion::Identity());
  particles.add(sphere, 2650., Vec3(0., 0., 2.995 * radius), Quaternion::Identity());
  particles.fix(0);
  particles.fix(1);
  SimulationParameters parameters;
  parameters.grain().young_modulus = 1e8;
  parameters.time_step = 2e-6;
  parameters.gravity = Vec3(0., 0., -9.81);
  Simulation simulation(parameters, particles, {{Vec3::Zero(), Vec3::UnitZ()}});

  double largest_force = 0.;
  for (int n = 0; n < 2000; ++n)
  {
    simulation.compute_forces();
    const auto lower = simulation.index_of(0), upper = simulation.index_of(2);
    const Vec3 &force = simulation.particles.force[upper];
    CHECK((simulation.particles.force[lower] + force).norm() == 0.);
    largest_force = std::max(largest_force, force.norm());
    simulation.integrate();
  }
  CHECK(largest_force > 10. * particles.mass[2] * 9.81); // it did land
  for (const std::int64_t id : {0, 1})
  {
    const auto i = simulation.index_of(id);
    CHECK(simulation.particles.position[i] == particles.position[id]);
    CHECK(simulation.particles.velocity[i].norm() == 0.);
    CHECK(simulation.particles.angular_velocity[i].norm() == 0.);
  }
  // What the free grain has lost of its height is all that moved: the books close without the infinite masses.
  simulation.compute_forces();
  CHECK(std::isfinite(simulation.energy().balance()));
  CHECK(std::isfinite(simulation.stable_time_step()));
}
