#include "dem/core/error.h"
#include "dem/simulation/simulation.h"
#include "tests/threads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double radius = 1e-3;
const Superquadric sphere{Vec3::Constant(radius), 1., 1.};
const Superquadric nearly_a_sphere{Vec3(1.05, 1., 0.95) * radius, 0.9, 1.1};

SimulationParameters parameters()
{
  SimulationParameters p;
  p.grain() = {1e8, 0.25, 2500.};
  p.wall() = p.grain();
  p.between_grains().friction = 0.3;
  p.with_walls().friction = 0.3;
  p.set_damping(0.2);
  p.time_step = 1e-6;
  return p;
}

PlaneWall floor_at(const double z)
{
  PlaneWall wall;
  wall.point = Vec3(0., 0., z);
  return wall;
}

/// A grain on a floor beside a sphere, all of which touch and slide: contacts of every kind with history.
Simulation sliding_grains()
{
  SimulationParameters p = parameters();
  p.gravity = Vec3(1., 0.5, -9.81);
  Particles grains;
  grains.add(nearly_a_sphere, p.grain().density, Vec3(0., 0., 0.9495 * radius), Quaternion::Identity());
  grains.add(sphere, p.grain().density, Vec3(2.048 * radius, 0., 0.9995 * radius), Quaternion::Identity());
  grains.add(sphere, p.grain().density, Vec3(4.0475 * radius, 0., 0.9995 * radius), Quaternion::Identity());
  grains.velocity[1] = Vec3(0., 2e-3, 0.);
  return Simulation(p, grains, {floor_at(0.)});
}

} // namespace

TEST_CASE("forces and energies may be asked for as often as one likes")
{
  const Threads one_thread(1);
  Simulation once = sliding_grains(), often = sliding_grains();
  int most_pairs = 0, most_walls = 0;
  for (int n = 0; n < 200; ++n)
  {
    once.step();
    most_pairs = std::max(most_pairs, once.contacts.n_touching());
    most_walls = std::max(most_walls, once.contacts.n_touching_walls());
    often.energy(); // before the forces of the step: of no use, but of no harm
    for (int k = 0; k <= n % 3; ++k)
      often.compute_forces();
    often.energy();
    often.compute_forces();
    often.kick();
    often.energy();
    often.kick();
    often.compute_forces();
    often.drift();
    often.energy();
  }
  REQUIRE(most_pairs == 2);
  REQUIRE(most_walls == 3);
  CHECK(state_hash(often) == state_hash(once));
}

TEST_CASE("a sphere sheared on a wall feels the tangential stiffness times the way, however often it is asked")
{
  const Threads one_thread(1);
  // Mindlin: k_t = 8 a / ((2 - nu) / G + (2 - nu) / G) with a = sqrt(R delta), here of equal materials.
  SimulationParameters p = parameters();
  p.with_walls().friction = 1e3; // sticks
  p.set_damping(0.);
  const double overlap = 1e-6, way = 1e-7;
  Particles grains;
  grains.add(sphere, 1e15, Vec3(0., 0., radius - overlap), Quaternion::Identity()); // too heavy to move
  const double shear_modulus = p.grain().young_modulus / (2. * (1. + p.grain().poisson_ratio));
  const double stiffness = 4. * shear_modulus * std::sqrt(radius * overlap) / (2. - p.grain().poisson_ratio);
  for (const int asked_every : {1, 10, 1000})
  {
    Simulation s(p, grains, {floor_at(0.)});
    s.walls[0].velocity = Vec3(1e-3, 0., 0.);
    const int n_steps = static_cast<int>(std::lround(way / (1e-3 * p.time_step)));
    for (int n = 0; n < n_steps; ++n)
    {
      s.compute_forces();
      if (n % asked_every == 0)
        s.compute_forces();
      s.integrate();
    }
    s.compute_forces();
    // The sphere turns with the wall by way / radius / inertia .. : not at all, it is too heavy.
    CHECK(s.particles.force[0][0] == Approx(stiffness * way).epsilon(1e-6));
  }
}

TEST_CASE("a velocity set between two steps counts for the drift to come")
{
  const Threads one_thread(1);
  // Pressed to 2 um and stopped: Hertz, f = 4/3 sqrt(R) E* delta^1.5 with 1/E* = 2 (1 - nu^2) / E.
  SimulationParameters p = parameters();
  p.set_damping(0.);
  const double overlap = 2e-6;
  const double modulus = 0.5 * p.grain().young_modulus / (1. - std::pow(p.grain().poisson_ratio, 2));
  for (const double speed : {1e-2, 1e-1, 0.5})
  {
    const int n_steps = static_cast<int>(std::lround(overlap / (speed * p.time_step)));
    const auto press = [&](Simulation &s, Vec3 &velocity, const Vec3 &direction)
    {
      velocity = speed * direction;
      for (int n = 0; n < n_steps; ++n)
        s.step();
      velocity.setZero();
      for (int n = 0; n < 5; ++n)
        s.step();
      s.compute_forces();
    };
    for (const Superquadric &shape : {sphere, Superquadric{Vec3::Constant(radius), 1., 1. + 1e-9}})
    {
      CAPTURE(speed, shape.eps2);
      Particles heavy; // so that it stays where it is
      heavy.add(shape, 1e15, Vec3(0., 0., radius), Quaternion::Identity());
      Simulation on_wall(p, heavy, {floor_at(0.)});
      press(on_wall, on_wall.walls[0].velocity, Vec3::UnitZ());
      CHECK(on_wall.particles.force[0][2] ==
            Approx(4. / 3. * std::sqrt(radius) * modulus * std::pow(overlap, 1.5)).epsilon(1e-6));

      heavy.add(shape, 1e15, Vec3(0., 0., 3. * radius), Quaternion::Identity());
      Simulation pair(p, heavy, {});
      const auto moved = pair.index_of(0);
      press(pair, pair.particles.velocity[moved], Vec3::UnitZ());
      CHECK(pair.particles.force[pair.index_of(1)][2] ==
            Approx(4. / 3. * std::sqrt(0.5 * radius) * modulus * std::pow(overlap, 1.5)).epsilon(1e-6));
    }
  }
}

TEST_CASE("a change of the time step kicks with the mean of both steps")
{
  const Threads one_thread(1);
  // Leapfrog is exact for a constant force at any steps. It starts from rest half a step before the beginning, that is
  // with the velocity g dt / 2 at time 0.
  SimulationParameters p = parameters();
  p.gravity = Vec3(0., 0., -9.81);
  p.time_step = 1e-3;
  Particles grains;
  grains.add(sphere, p.grain().density, Vec3::Zero(), Quaternion::Identity());
  Simulation s(p, grains, {});
  s.particles.external_force.assign(1, Vec3(s.particles.mass[0], 0., 0.)); // a = 1 m/s^2
  double largest_miss = 0.;
  const auto run_to = [&](const double time)
  {
    while (s.time < time - 0.5 * s.parameters().time_step)
    {
      s.compute_forces();
      largest_miss = std::max(largest_miss, std::abs(s.energy().balance()));
      s.integrate();
    }
  };
  run_to(0.1);
  p.time_step = 1e-4;
  s.change(p);
  run_to(0.15);
  p.time_step = 7e-4;
  s.change(p);
  run_to(0.2 - 1e-9);
  const double t = s.time, start = 0.5e-3;
  CHECK(t == Approx(0.2).epsilon(0.01));
  CHECK(s.particles.position[0][2] == Approx(-9.81 * t * (0.5 * t + start)).epsilon(1e-12));
  CHECK(s.particles.position[0][0] == Approx(t * (0.5 * t + start)).epsilon(1e-12));
  // Works of the trapezoidal rule, of the changes of the step too: the balance closes to rounding.
  CHECK(largest_miss < 1e-12 * s.energy().kinetic);
}

TEST_CASE("a change of the time step keeps the history of contacts")
{
  const Threads one_thread(1);
  // Pressed against a wall by a moving wall while the step changes: what counts is the way, not the steps.
  SimulationParameters p = parameters();
  p.set_damping(0.);
  Particles heavy;
  heavy.add(sphere, 1e15, Vec3(0., 0., radius), Quaternion::Identity());
  Simulation s(p, heavy, {floor_at(0.)});
  s.walls[0].velocity = Vec3(0., 0., 1e-2);
  for (int n = 0; n < 100; ++n)
    s.step();
  p.time_step = 2.5e-7;
  s.change(p);
  for (int n = 0; n < 400; ++n)
    s.step();
  s.compute_forces();
  const double modulus = 0.5 * p.grain().young_modulus / (1. - std::pow(p.grain().poisson_ratio, 2));
  CHECK(s.particles.force[0][2] == Approx(4. / 3. * std::sqrt(radius) * modulus * std::pow(2e-6, 1.5)).epsilon(1e-6));
  CHECK(s.walls[0].work == Approx(0.4 * 4. / 3. * std::sqrt(radius) * modulus * std::pow(2e-6, 2.5)).epsilon(1e-4));
}

TEST_CASE("two spheres at one place are pushed apart, with equal and opposite forces")
{
  const Threads one_thread(1);
  SimulationParameters p = parameters();
  p.set_damping(0.);
  for (const double apart : {0., 1e-200, 1e-12})
    for (const Superquadric &shape : {sphere, nearly_a_sphere})
    {
      CAPTURE(apart, shape.eps1);
      Particles grains;
      grains.add(shape, p.grain().density, Vec3::Zero(), Quaternion::Identity());
      grains.add(shape, p.grain().density, Vec3(apart, 0., 0.), Quaternion::Identity());
      Simulation s(p, grains, {});
      s.compute_forces();
      CHECK(s.contacts.n_touching() == 1);
      CHECK(s.particles.force[0].norm() > 1.);
      CHECK(s.particles.force[0] == -s.particles.force[1]);
      for (int n = 0; n < 10; ++n)
        s.step();
      CHECK((s.particles.position[0] - s.particles.position[1]).norm() > apart);
    }
}
