#include "dem/core/error.h"
#include "dem/geometry/rigid_clump.h"
#include "dem/packing/random_addition.h"
#include "dem/simulation/simulation.h"
#include "dem/state/repeated.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <vector>

/// Copies of a periodic cell side by side.
using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double infinite = std::numeric_limits<double>::infinity(), density = 2500., size = 1e-3;

SimulationParameters soft()
{
  SimulationParameters p;
  p.grain() = {1e7, 0.25, density};
  p.wall() = p.grain();
  p.between_grains().friction = 0.4;
  p.with_walls().friction = 0.3;
  p.set_damping(0.5);
  p.time_step = 5e-6; // stable up to some 4e-5 s
  p.gravity = {0., 0., -9.81};
  return p;
}

/// Grains of a kind settled on a floor in a cell of 7 x 8 mm.
Simulation layer_of(const std::string &kind)
{
  const Vec3 edges(7e-3, 8e-3, 12e-3);
  const PackingSpace space = PackingSpace::periodic({Vec3::Zero(), edges}, {true, true, false});
  const Superquadric sphere{Vec3::Constant(size), 1., 1.}, brick{Vec3(1.2 * size, size, 0.8 * size), 0.8, 0.9};
  Particles grains;
  if (kind == "clumps")
  {
    const Clump pair(ClumpShape{{{{Vec3::Constant(0.7 * size), 1., 1.}, Vec3(0.5 * size, 0., 0.)},
                                 {{Vec3::Constant(0.8 * size), 1., 1.}, Vec3(-0.5 * size, 0., 0.)}}});
    grains = add_at_random(std::vector<Clump>(40, pair), space, density, 3);
  }
  else
    grains = add_at_random(std::vector<Superquadric>(36, kind == "spheres" ? sphere : brick), space, density, 3);
  grains.cell = PeriodicCell(Vec3(edges[0], edges[1], infinite));
  Simulation s(soft(), grains, {PlaneWall{}});
  for (int k = 0; k < 20000; ++k)
    s.step();
  return s;
}

/// The same grains without the history of their contacts.
Simulation without_history(const Simulation &s)
{
  return Simulation(s.parameters(), s.particles, s.walls);
}

/// Largest difference of a force on a grain of any copy from that on the cell's own [N].
double force_difference(const Simulation &one, const Simulation &many)
{
  const auto n = static_cast<std::int64_t>(one.particles.size());
  double largest = 0.;
  for (std::size_t i = 0; i < many.particles.size(); ++i)
    largest = std::max(largest,
                       (many.particles.force[i] - one.particles.force[one.index_of(many.particles.id[i] % n)]).norm());
  return largest;
}

} // namespace

TEST_CASE("copies of a periodic cell are in its balance, with the springs of its contacts")
{
  const std::string kind = GENERATE("superquadrics", "spheres", "clumps");
  const bool are_forces_known = GENERATE(false, true);
  CAPTURE(kind, are_forces_known);
  Simulation one = layer_of(kind);
  if (are_forces_known)
    one.compute_forces();
  const CellCopies copies{{3, 2, 1}};
  Simulation many = one.repeated(copies), forgetful = without_history(one);
  CHECK(many.particles.size() == 6 * one.particles.size());
  CHECK(std::set(many.particles.id.begin(), many.particles.id.end()).size() == many.particles.size());
  CHECK((many.particles.cell.edges - Vec3(21e-3, 16e-3, infinite)).head<2>().norm() < 1e-15);
  CHECK(many.particles.cell.directions() == "x and y");
  const auto sum = [](const std::vector<double> &values) { return std::accumulate(values.begin(), values.end(), 0.); };
  CHECK(sum(many.particles.volume) == Approx(6. * sum(one.particles.volume)).epsilon(1e-12));

  double typical = 0.;
  for (int k = 0; k < 3; ++k) // the state itself, and as it goes on
  {
    for (Simulation *s : {&one, &many, &forgetful})
      s->compute_forces();
    for (const TouchingContact &c : one.contacts.touching(one.particles))
      typical = std::max(typical, c.state.force().norm());
    CHECK(many.contacts.n_touching() == 6 * one.contacts.n_touching());
    CHECK(many.contacts.n_touching_walls() == 6 * one.contacts.n_touching_walls());
    CHECK((many.walls[0].force - 6. * one.walls[0].force).norm() < 1e-9 * typical);
    CHECK(force_difference(one, many) < 1e-9 * typical);
    CHECK(force_difference(one, forgetful) > 1e-3 * typical);
    const ContactEnergy of_one = one.contacts.total_energy(), of_many = many.contacts.total_energy();
    CHECK(of_one.tangential > 0.);
    CHECK(of_many.normal == Approx(6. * of_one.normal).epsilon(1e-9));
    CHECK(of_many.tangential == Approx(6. * of_one.tangential).epsilon(1e-9));
    for (Simulation *s : {&one, &many, &forgetful})
      s->integrate();
  }
}

TEST_CASE("copies of a periodic cell go on as the cell does, and their energies add up")
{
  Simulation one = layer_of("superquadrics");
  for (Vec3 &v : one.particles.velocity)
    v += Vec3(0.02, 0.03, 0.); // through the faces
  Simulation many = one.repeated({{2, 1, 1}});
  one.reset_accounts();
  one.compute_forces();
  many.compute_forces();
  const double kinetic = many.energy().kinetic, balance = many.energy().balance();
  CHECK(kinetic == Approx(2. * one.energy().kinetic).epsilon(1e-12));
  CHECK(balance == Approx(2. * one.energy().balance()).epsilon(1e-9));
  for (int k = 0; k < 400; ++k)
  {
    one.step();
    many.step();
  }
  one.compute_forces();
  many.compute_forces();
  CHECK(many.energy().friction_loss == Approx(2. * one.energy().friction_loss).epsilon(1e-6));
  CHECK(std::abs(many.energy().balance() - balance) < 2e-3 * kinetic);
  CHECK((many.walls[0].force - 2. * one.walls[0].force).norm() < 1e-6 * many.walls[0].force.norm());
}

TEST_CASE("a cell that is opened keeps all contacts but those across its faces, and its energy account")
{
  Simulation closed = layer_of("superquadrics");
  Simulation s = closed.repeated({{3, 1, 1}});
  s.compute_forces();
  double across = 0.;
  int n_across = 0;
  std::set<std::int64_t> at_ends;
  for (const TouchingContact &c : s.contacts.touching(s.particles))
    if (c.image != own_image)
    {
      ++n_across;
      across += stored_energy(c.state).normal;
      at_ends.insert(s.particles.id[c.first]);
      at_ends.insert(s.particles.id[c.second]);
    }
  REQUIRE(n_across > 0);
  const Simulation before = s;
  const double stored = before.energy().normal;
  const Vec3 shift(-10.5e-3, 1e-3, 0.);
  s.open_cell(shift);
  CHECK_FALSE(s.particles.cell.is_periodic());
  CHECK(s.contacts.n_touching() == before.contacts.n_touching() - n_across);
  CHECK(s.energy().exchanged == Approx(-across).epsilon(1e-12));
  CHECK(std::abs(s.energy().balance() - before.energy().balance()) < 1e-12 * stored);
  for (std::size_t i = 0; i < s.particles.size(); ++i)
  {
    const Vec3 old = before.particles.position[before.index_of(s.particles.id[i])];
    Vec3 moved = s.particles.position[i] - old - shift; // those outside had not yet been put back
    for (int d = 0; d < 2; ++d)
      moved[d] -= before.particles.cell.edges[d] * std::round(moved[d] / before.particles.cell.edges[d]);
    CHECK(moved.norm() < 1e-15);
  }
  Simulation all = before;
  s.integrate();
  all.integrate();
  s.compute_forces();
  all.compute_forces();
  double inside = 0., ends = 0.;
  for (std::size_t i = 0; i < s.particles.size(); ++i)
  {
    const std::int64_t id = s.particles.id[i];
    const double change = (s.particles.force[i] - all.particles.force[all.index_of(id)]).norm();
    double &largest = at_ends.count(id) ? ends : inside;
    largest = std::max(largest, change);
  }
  const double weight = 9.81 * s.particles.mass[0];
  CHECK(inside < 1e-8 * weight);
  CHECK(ends > 0.1 * weight);
}

TEST_CASE("copies that cannot be are refused")
{
  Particles grain;
  grain.add({Vec3::Constant(size), 1., 1.}, density, Vec3::Constant(2e-3), Quaternion::Identity());
  grain.cell = PeriodicCell(Vec3(8e-3, infinite, 9e-3));
  CHECK_THROWS_WITH(repeated(grain, {{2, 2, 1}}),
                    Catch::Contains("along y is 2") && Catch::Contains("does not repeat itself"));
  CHECK_THROWS_WITH(repeated(grain, {{2, 1, 0}}), Catch::Contains("along z is 0") && Catch::Contains("at least 1"));
  SimulationParameters weightless = soft();
  weightless.gravity.setZero();
  Simulation s(weightless, grain, {});
  CHECK_THROWS_WITH(s.repeated({{-1, 1, 1}}), Catch::Contains("along x is -1"));
  CHECK_THROWS_WITH(s.open_cell(Vec3(0., 1e-3, 0.)), Catch::Contains("along y is 0.001"));
  CHECK(s.particles.cell.directions() == "x and z");
  CHECK(repeated(grain, {{1, 1, 3}}).size() == 3);
}
