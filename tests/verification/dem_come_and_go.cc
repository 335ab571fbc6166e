#include "dem/core/error.h"
#include "dem/simulation/simulation.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double radius = 1e-3, density = 2500.;
const Superquadric rounded{Vec3::Constant(radius), 0.9, 0.95};
const Superquadric sphere{Vec3::Constant(radius), 1., 1.};

/// Two columns of three grains that settle on a floor, and one that flies above.
Simulation columns(const double damping = 0.3)
{
  SimulationParameters p;
  p.grain() = p.wall() = {1e8, 0.25, density};
  p.with_walls().friction = 0.3;
  p.set_damping(damping);
  p.gravity = Vec3(0., 0., -9.81);
  p.time_step = 1e-6;
  p.sort_interval = 1;
  Particles grains;
  for (int i = 0; i < 6; ++i)
    grains.add(i < 3 ? sphere : rounded, density, Vec3(i < 3 ? 0. : 5e-3, 0., (1.999 * (i % 3) + 0.9995) * radius),
               Quaternion::Identity());
  grains.add(rounded, density, Vec3(0., 8e-3, 0.5), Quaternion::Identity());
  grains.velocity[6] = Vec3(0.1, 0., 1.);
  grains.angular_momentum[6] = 20. * grains.inertia[6];
  Simulation s(p, grains, {PlaneWall()});
  for (int n = 0; n < 300; ++n)
    s.step();
  return s;
}

double balance(Simulation &s)
{
  s.compute_forces();
  return s.energy().balance();
}

double scale(Simulation &s)
{
  s.compute_forces();
  const GrainEnergy e = s.energy();
  return e.kinetic + e.normal + std::abs(e.gravity_work);
}

} // namespace

TEST_CASE("a grain that flies out takes its mass, momentum and energy with it, and the accounts stay closed")
{
  const Threads one_thread(1);
  Simulation s = columns();
  const double before = balance(s);
  const auto i = s.index_of(6);
  const double mass = s.particles.mass[i];
  const Vec3 velocity = s.particles.velocity[i];
  const Exchange gone = s.remove({i});
  CHECK(gone.n_particles == 1);
  CHECK(gone.ids == std::vector<std::int64_t>{6});
  CHECK(gone.mass == mass);
  CHECK(gone.momentum == mass * velocity);
  CHECK(s.particles.size() == 6);
  CHECK_FALSE(s.has(6));
  CHECK_THROWS_AS(s.index_of(6), ConfigError);
  CHECK(std::abs(balance(s) - before) < 1e-12 * scale(s));
  for (int n = 0; n < 300; ++n)
    s.step();
  CHECK(std::abs(balance(s) - before) < 1e-9 * scale(s));
}

TEST_CASE("the others neither notice that a grain has left nor that one has come")
{
  const Threads one_thread(1);
  // Grains that touch none of those that leave or come go on along the same path; orders of sums may change.
  Simulation straight = columns(), changed = columns();
  changed.remove({changed.index_of(6)});
  Particles more;
  more.add(sphere, density, Vec3(0., 0.02, 0.02), Quaternion::Identity());
  more.add(rounded, density, Vec3(0.01, 0.02, 0.02), Quaternion::Identity());
  changed.compute_forces();
  CHECK_THROWS_AS(changed.add(more), ConfigError); // not in the middle of a step
  changed.integrate();
  straight.step();
  const Exchange come = changed.add(more);
  CHECK(come.ids == std::vector<std::int64_t>{7, 8});
  CHECK(changed.particles.id[changed.index_of(7)] == 7);
  for (int n = 0; n < 500; ++n)
  {
    straight.step();
    changed.step();
  }
  CHECK(changed.contacts.n_touching() == straight.contacts.n_touching());
  for (std::int64_t id = 0; id < 6; ++id)
  {
    const auto i = straight.index_of(id), j = changed.index_of(id);
    CHECK((straight.particles.position[i] - changed.particles.position[j]).norm() < 1e-12 * radius);
    CHECK((straight.particles.velocity[i] - changed.particles.velocity[j]).norm() < 1e-9);
  }
}

TEST_CASE("energy accounts close over grains that come, fall and are taken away in contact")
{
  const Threads one_thread(1);
  // Taken away in contact, a grain leaves half a step's work of its contacts unaccounted: of first order in the step.
  double previous = 0.;
  for (const double step : {2e-6, 1e-6, 5e-7})
  {
    Simulation s = columns(0.);
    SimulationParameters p = s.parameters();
    p.time_step = step;
    s.change(p);
    s.step();
    const double before = balance(s);
    s.integrate();
    Particles more;
    more.add(sphere, density, Vec3(0., 0., 7.5e-3), Quaternion::Identity());
    more.velocity[0] = Vec3(0., 0., -0.5);
    Simulation without = s;
    s.add(more);
    CHECK(std::abs(balance(s) - balance(without)) < 1e-12 * scale(s));
    while (s.time < 3.5e-3)
      s.step();
    const double fallen = balance(s);
    CHECK(std::abs(fallen - before) < 1e-3 * scale(s)); // the friction's trapezoidal rule
    s.remove({s.index_of(7), s.index_of(1)});
    const double missed = std::abs(balance(s) - fallen);
    CHECK(missed < 1e-12 * scale(s));
    for (int n = 0; n < 3; ++n)
      s.step();
    const double after = std::abs(balance(s) - fallen) / scale(s);
    CAPTURE(step, after, previous);
    CHECK(after < 2e-2);
    previous = after;
  }
}

TEST_CASE("ids with gaps survive sorting, and walls may come and go")
{
  const Threads one_thread(1);
  Simulation s = columns();
  s.remove({s.index_of(0), s.index_of(4)});
  s.sort_by_place();
  std::map<std::int64_t, Vec3> places;
  for (std::size_t i = 0; i < s.particles.size(); ++i)
  {
    CHECK(s.index_of(s.particles.id[i]) == static_cast<std::int32_t>(i));
    places[s.particles.id[i]] = s.particles.position[i];
  }
  CHECK(places.size() == 5);
  const double before = balance(s);
  s.integrate();
  PlaneWall roof;
  roof.point = Vec3(0., 0., 1.);
  roof.normal = -Vec3::UnitZ();
  s.add_wall(roof);
  CHECK(s.walls.size() == 2);
  s.remove_wall(0); // presses against the grains
  CHECK(std::abs(balance(s) - before) < 1e-2 * scale(s));
  for (int n = 0; n < 100; ++n)
    s.step();
  CHECK(s.contacts.n_touching_walls() == 0);
  CHECK_THROWS_AS(s.remove_wall(1), ConfigError);
}

TEST_CASE("the last grain is not taken away")
{
  const Threads one_thread(1);
  Simulation s = columns();
  std::vector<std::int32_t> all(s.particles.size());
  std::iota(all.begin(), all.end(), 0);
  CHECK_THROWS_AS(s.remove(all), RunError);
}

TEST_CASE("who is removed are those meant, also when the grains are sorted in between")
{
  const Threads one_thread(1);
  SimulationParameters p;
  p.grain() = p.wall() = {1e8, 0.25, density};
  p.time_step = 1e-5;
  p.sort_interval = 1;
  // Two rows that pass one another.
  Particles grains;
  for (int i = 0; i < 12; ++i)
  {
    grains.add(sphere, density, Vec3(3e-3 * (i % 6), 3e-3 * (i / 6), 0.), Quaternion::Identity());
    grains.velocity[i] = Vec3(i < 6 ? 20. : -20., 0., 0.);
  }
  Simulation s(p, grains, {});
  int n_sorted = 0;
  for (int n = 0; n < 100; ++n)
  {
    Simulation other = s;
    const std::vector<std::int64_t> ids = s.particles.id;
    const Exchange gone = other.remove({0, 7});
    CHECK(std::set(gone.ids.begin(), gone.ids.end()) == std::set{ids[0], ids[7]});
    CHECK_FALSE(other.has(ids[0]));
    CHECK_FALSE(other.has(ids[7]));
    s.step();
    n_sorted += s.particles.id != ids ? 1 : 0;
  }
  CHECK(n_sorted > 0);
}
