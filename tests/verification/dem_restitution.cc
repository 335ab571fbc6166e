#include "dem/geometry/superquadric.h"
#include "dem/law/hertz.h"
#include "dem/law/restitution.h"
#include "dem/simulation/simulation.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

TEST_CASE("two spheres rebound with the restitution that their relaxation time was chosen for")
{
  const Threads one_thread(1);
  // The damping force takes the velocity of the half step before: first order in the time step. Halving the step twice
  // must halve the error each time; the remaining error of a step of T/400 is below 1 % of the 1 - e that it is about.
  const double radius = 1e-3, speed = 0.5;
  SimulationParameters p;
  p.grain() = {1e9, 0.25, 2500.};
  p.between_grains().friction = 0.;
  p.set_damping(0.);
  p.contact.overlap_tolerance = 0.;
  const Superquadric sphere{Vec3::Constant(radius), 1., 1.};
  const double reduced_mass = 0.5 * p.grain().density * volume(sphere);
  const double stiffness = 4. / 3. * std::sqrt(0.5 * radius) * elastic_pair(p.grain(), p.grain()).effective_modulus;
  const double duration = 2.9432751 * std::pow(1.25 * reduced_mass / stiffness, 0.4) / std::pow(speed, 0.2); // Hertz
  std::printf("    e  error at duration/100, /200, /400\n");
  for (const double e : {0.97, 0.7, 0.3})
  {
    p.set_damping(0., relaxation_time(e, stiffness, reduced_mass, speed));
    std::vector<double> errors;
    for (const int n : {100, 200, 400})
    {
      p.time_step = duration / n;
      Particles grains;
      // Contact begins at an arbitrary part of a step: an error of second order, kept the same here.
      const double gap = 0.37 * p.time_step * speed;
      grains.add(sphere, p.grain().density, Vec3(-radius - 0.5 * gap, 0., 0.), Quaternion::Identity());
      grains.add(sphere, p.grain().density, Vec3(radius + 0.5 * gap, 0., 0.), Quaternion::Identity());
      grains.velocity[0] = Vec3(0.5 * speed, 0., 0.);
      grains.velocity[1] = Vec3(-0.5 * speed, 0., 0.);
      Simulation simulation(p, grains, {});
      for (int i = 0; i < 12 * n; ++i)
        simulation.step();
      const auto &v = simulation.particles.velocity;
      const Vec3 apart = v[simulation.index_of(1)] - v[simulation.index_of(0)];
      errors.push_back(apart[0] / speed - e);
    }
    std::printf("%5.2f %10.2e %10.2e %10.2e\n", e, errors[0], errors[1], errors[2]);
    CAPTURE(e, errors);
    CHECK(std::abs(errors[2]) < 0.01 * (1. - e));
    const double order = 0.5 * std::log2(std::abs(errors[0] / errors[2]));
    CHECK(order > 0.8);
  }
}
