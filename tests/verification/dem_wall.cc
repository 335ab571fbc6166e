#include "dem/simulation/simulation.h"

#include "tests/threads.h"
#include <algorithm>

#include <catch2/catch.hpp>
#include <cmath>
#include <omp.h>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double radius = 1e-3;
const Superquadric sphere{Vec3::Constant(radius), 1., 1.};

PlaneWall floor_at(const double z, const Vec3 &normal = Vec3::UnitZ())
{
  PlaneWall wall;
  wall.point = Vec3(0., 0., z);
  wall.normal = normal;
  return wall;
}

SimulationParameters soft_parameters()
{
  SimulationParameters p;
  p.grain() = {1e8, 0.25, 2500.};
  p.wall() = {3e8, 0.3, 7800.};
  p.between_grains().friction = 0.3;
  p.with_walls().friction = 0.2;
  p.set_damping(0.5);
  p.time_step = 1e-6;
  return p;
}

/// gamma E* of a sphere on a plane wall: (4/3) sqrt(r) E*.
double wall_coefficient(const SimulationParameters &p)
{
  const auto compliance = [](const Material &m) { return (1. - m.poisson_ratio * m.poisson_ratio) / m.young_modulus; };
  return 4. / 3. * std::sqrt(radius) / (compliance(p.grain()) + compliance(p.wall()));
}

/// A chain of pressed spheres along an oblique axis between two walls, in equilibrium to rounding.
struct Chain
{
  Particles grains;
  std::vector<PlaneWall> walls;
  double stiffness; ///< of a grain contact along its normal [N/m]
};

Chain pressed_chain(const SimulationParameters &p, const int n, const double overlap)
{
  const Vec3 axis = Vec3(0.3, -0.5, 0.7).normalized();
  Chain chain;
  const double e = p.grain().young_modulus / (2. * (1. - p.grain().poisson_ratio * p.grain().poisson_ratio));
  const double gamma = 4. / 3. * std::sqrt(0.5 * radius) * e;
  const double force = gamma * std::pow(overlap, 1.5);
  chain.stiffness = 1.5 * gamma * std::sqrt(overlap);
  const double wall_overlap = std::pow(force / wall_coefficient(p), 2. / 3.);
  const double spacing = 2. * radius - overlap;
  for (int i = 0; i < n; ++i)
    chain.grains.add(sphere, p.grain().density, (i * spacing) * axis, Quaternion::Identity());
  chain.walls.resize(2);
  chain.walls[0].normal = axis;
  chain.walls[0].point = -(radius - wall_overlap) * axis;
  chain.walls[1].normal = -axis;
  chain.walls[1].point = ((n - 1) * spacing + radius - wall_overlap) * axis;
  return chain;
}

} // namespace

TEST_CASE("a sphere settles on the floor at Hertz's static overlap")
{
  const Threads one_thread(1);
  // m g = gamma E* d^(3/2). Critically damped to half, contact frequency some 1e4/s: after 0.05 s the swing has died
  // by exp(-100) and more; d is a difference of lengths 1e4 times larger (1e-12).
  for (const Vec3 &normal : {Vec3(0., 0., 1.), Vec3(Vec3(0.3, -0.4, 0.8).normalized())})
  {
    SimulationParameters p = soft_parameters();
    p.gravity = -9.81 * normal;
    Particles grains;
    grains.add(sphere, p.grain().density, (radius + 1e-6) * normal, Quaternion(0.3, 0.1, 0.5, 0.7));
    Simulation simulation(p, grains, {floor_at(0., normal)});
    for (int i = 0; i < 50000; ++i)
      simulation.step();
    simulation.compute_forces();
    const double weight = simulation.particles.mass[0] * 9.81;
    const double expected = std::pow(weight / wall_coefficient(p), 2. / 3.);
    const double overlap = radius - normal.dot(simulation.particles.position[0]);
    CHECK(overlap == Approx(expected).epsilon(1e-9));
    CHECK((simulation.particles.force[0] - weight * normal).norm() < 1e-9 * weight);
    CHECK((simulation.walls[0].force + weight * normal).norm() < 1e-9 * weight);
    CHECK(simulation.particles.velocity[0].norm() < 1e-12);
    // The energy that it fell by: m g (drop) = stored + lost, and nothing was lost by friction.
    const GrainEnergy e = simulation.energy();
    CHECK(e.gravity_work == Approx(weight * (1e-6 + expected)).epsilon(1e-9));
    CHECK(e.normal == Approx(0.4 * weight * expected).epsilon(1e-8));
    CHECK(e.normal + e.viscous_loss - e.quadrature_work == Approx(e.gravity_work).epsilon(1e-6));
    CHECK(std::abs(e.quadrature_work) < 1e-3 * e.viscous_loss);
    CHECK(e.friction_loss < 1e-12 * e.gravity_work);
  }
}

TEST_CASE("the work of a moving wall is the energy that the grain gains")
{
  const Threads one_thread(1);
  // A wall that comes at speed V hits a resting sphere without damping: it leaves at 2 V, so the wall has done 2 m V^2.
  // Leapfrog's second order: some hundred steps a contact give 1e-4.
  SimulationParameters p = soft_parameters();
  p.set_damping(0.);
  p.contact.overlap_tolerance = 0.;
  const double speed = 0.1;
  for (const bool is_fine : {false, true})
  {
    p.time_step = is_fine ? 2.5e-7 : 1e-6;
    Particles grains;
    grains.add(sphere, p.grain().density, Vec3(0., 0., radius + 1e-5), Quaternion::Identity());
    PlaneWall wall = floor_at(0.);
    wall.velocity = Vec3(0., 0., speed);
    Simulation simulation(p, grains, {wall});
    bool met = false;
    for (int i = 0; i < 100000; ++i)
    {
      simulation.step();
      const bool touches = simulation.contacts.n_touching_walls() > 0;
      met = met || touches;
      if (met && !touches)
        break;
    }
    REQUIRE(met);
    const double mass = simulation.particles.mass[0], out = simulation.particles.velocity[0][2];
    CHECK(out == Approx(2. * speed).epsilon(1e-4));
    // Wall's work = V sum f dt = V m v, exact for leapfrog; and it is the kinetic energy but for what the trapezoidal
    // rule misses of the contact's spring, which has an entry of its own: both to rounding.
    CHECK(simulation.walls[0].work == Approx(mass * speed * out).epsilon(1e-12));
    simulation.compute_forces();
    const GrainEnergy e = simulation.energy();
    CHECK(e.wall_work == Approx(0.5 * mass * out * out - e.quadrature_work).epsilon(1e-12));
    CHECK(e.viscous_loss == 0.);
    CHECK(std::abs(e.quadrature_work) < 1e-4 * e.wall_work);
    CHECK(simulation.walls[0].work == Approx(2. * mass * speed * speed).epsilon(1e-4));
    CHECK(simulation.particles.velocity[0].head<2>().norm() < 1e-15);
  }
}

TEST_CASE("the account stays closed when a wall is taken away")
{
  const Threads one_thread(1);
  // What the wall did while it was there stays done: balance() is constant but for the elastic energy of its contacts,
  // which is none once the grain has left.
  SimulationParameters p = soft_parameters();
  Particles grains;
  grains.add(sphere, p.grain().density, Vec3(0., 0., radius + 1e-6), Quaternion::Identity());
  PlaneWall wall = floor_at(0.);
  wall.velocity = Vec3(0., 0., 0.1);
  Simulation simulation(p, grains, {wall, floor_at(1., -Vec3::UnitZ())});
  for (int i = 0; i < 2000; ++i)
    simulation.step();
  simulation.compute_forces();
  REQUIRE(simulation.walls[0].work > 0.);
  REQUIRE(simulation.contacts.n_touching_walls() == 0);
  const double before = simulation.energy().balance();
  const double scale = simulation.energy().kinetic;
  simulation.remove_wall(0);
  CHECK(simulation.walls.size() == 1);
  CHECK(std::abs(simulation.energy().balance() - before) < 1e-12 * scale);
}

TEST_CASE("the stable time step of one sphere on a wall in closed form")
{
  const Threads one_thread(1);
  // Modes of the pressed sphere: along the normal k, c; sideways the stiffness kT with the mass and, by the arm, with
  // the inertia 2/5 m r^2: kT (1/m + (r - d/2)^2/I). Each allows the dt that solves s dt^2/4 + c' dt/2 = 1 (s stiffness
  // and c' damping over mass); the shortest counts. Forty iterations of the power method, thrice, on modes 1.3 apart:
  // 1e-6.
  for (const Vec3 &normal : {Vec3(0., 0., 1.), Vec3(1., 0., 0.), Vec3(Vec3(0.3, -0.4, 0.8).normalized())})
    for (const double zeta : {0., 0.2, 0.9, 2.})
    {
      SimulationParameters p = soft_parameters();
      p.set_damping(zeta);
      const double overlap = 1e-6;
      Particles grains;
      grains.add(sphere, p.grain().density, (radius - overlap) * normal, Quaternion::Identity());
      Simulation simulation(p, grains, {floor_at(0., normal)});
      simulation.compute_forces();
      const double m = simulation.particles.mass[0], k = 1.5 * wall_coefficient(p) * std::sqrt(overlap);
      const double c = 2. * zeta * std::sqrt(k * m);
      const auto longest = [](const double s, const double d)
      { return 2. / s * (std::sqrt(0.25 * d * d + s) - 0.5 * d); };
      const double g1 = p.grain().young_modulus / (2. * (1. + p.grain().poisson_ratio));
      const double g2 = p.wall().young_modulus / (2. * (1. + p.wall().poisson_ratio));
      const double kt =
          8. * std::sqrt(radius * overlap) / ((2. - p.grain().poisson_ratio) / g1 + (2. - p.wall().poisson_ratio) / g2);
      const double arm = radius - 0.5 * overlap;
      const double normal_step = longest(k / m, c / m);
      const double sideways_step = longest(kt / m * (1. + 2.5 * arm * arm / radius / radius), 0.);
      CAPTURE(normal.transpose(), zeta, normal_step, sideways_step);
      CHECK(longest(k / m, c / m) ==
            Approx(2. / std::sqrt(k / m) * (std::sqrt(1. + zeta * zeta) - zeta)).epsilon(1e-12));
      CHECK(simulation.stable_time_step() == Approx(std::min(normal_step, sideways_step)).epsilon(1e-6));
    }
  // No contact: no limit.
  Particles grains;
  grains.add(sphere, 2500., Vec3(0., 0., 5. * radius), Quaternion::Identity());
  Simulation simulation(soft_parameters(), grains, {floor_at(0.)});
  simulation.compute_forces();
  CHECK(std::isinf(simulation.stable_time_step()));
}

TEST_CASE("a pressed chain is stable just below the stable time step and not just above it")
{
  const Threads one_thread(1);
  // Small random velocities in all degrees of freedom about an equilibrium in which everything sticks: linear. At 1.05
  // of the limit the fastest mode's multiplier is mu + 1/mu = 4 * 1.05^2 - 2, mu = 1.88 undamped: 1.88^100. At 0.95 the
  // swing stays bounded, but for the chain's buckling by rolling, at sqrt(overlap/radius) = 1e-3 of the contact's
  // frequency: exp(2e-3 n) in n steps, which is 8 here. The estimate is from below in stiffness, so 5 % also bound its
  // error.
  for (const double zeta : {0., 0.5})
  {
    SimulationParameters p = soft_parameters();
    p.between_grains().friction = p.with_walls().friction = 1e4;
    p.set_damping(zeta);
    p.contact.overlap_tolerance = 0.;
    const double overlap = 1e-9;
    Chain chain = pressed_chain(p, 5, overlap);
    std::mt19937_64 generator(3);
    std::normal_distribution<double> normal;
    const double speed = 1e-11;
    for (std::size_t i = 0; i < chain.grains.size(); ++i)
    {
      chain.grains.velocity[i] = speed * Vec3(normal(generator), normal(generator), normal(generator));
      chain.grains.angular_velocity[i] = speed / radius * Vec3(normal(generator), normal(generator), normal(generator));
      chain.grains.angular_momentum[i] = chain.grains.inertia[i][0] * chain.grains.angular_velocity[i];
    }
    Simulation probe(p, chain.grains, chain.walls);
    probe.compute_forces();
    // Equilibrium: without the velocities a grain's acceleration over a millisecond gives less than their speed.
    Chain still = chain;
    for (std::size_t i = 0; i < still.grains.size(); ++i)
      still.grains.velocity[i] = still.grains.angular_velocity[i] = still.grains.angular_momentum[i] = Vec3::Zero();
    Simulation resting(p, still.grains, still.walls);
    resting.compute_forces();
    for (std::size_t i = 0; i < resting.particles.size(); ++i)
      CHECK(resting.particles.force[i].norm() / resting.particles.mass[i] * 1e-3 < speed);
    const double limit = probe.stable_time_step();
    // The fastest pair mode lies between the one of a lone contact and twice it: 2/sqrt(4 k/m) < limit.
    CHECK(limit < 2. / std::sqrt(2. * chain.stiffness / probe.particles.mass[0]));

    const auto largest_speed_after = [&](const double share, const int n)
    {
      Simulation s(p, chain.grains, chain.walls);
      SimulationParameters stepped = p;
      stepped.time_step = share * limit;
      s.change(stepped);
      double largest = 0.;
      for (int i = 0; i < n; ++i)
      {
        s.step();
        largest = 0.;
        for (std::size_t k = 0; k < s.particles.size(); ++k)
          largest = std::max(largest, s.particles.velocity[k].norm() + radius * s.particles.angular_velocity[k].norm());
      }
      return largest;
    };
    CAPTURE(zeta, limit);
    CHECK(largest_speed_after(0.95, 1000) < 100. * speed);
    CHECK(largest_speed_after(1.05, 100) > 1e3 * speed);
  }
}
