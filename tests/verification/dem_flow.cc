#include "dem/core/error.h"
#include "dem/core/state.h"
#include "dem/flow/inlet.h"
#include "dem/flow/outlet.h"
#include "dem/io/snapshot.h"
#include "tests/temporary_folder.h"
#include "tests/threads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double density = 2500., fall = 9.81;

SimulationParameters soft_grains()
{
  SimulationParameters p;
  p.grain() = p.wall() = {1e7, 0.25, density};
  p.set_damping(0.2);
  p.gravity = Vec3(0., 0., -fall);
  p.time_step = 5e-6;
  return p;
}

/// A fixed sphere.
Particles obstacle(const Vec3 &centre, const double radius)
{
  Particles fixed;
  fixed.add({Vec3::Constant(radius), 1., 1.}, density, centre, Quaternion::Identity());
  fixed.fix(0);
  return fixed;
}

UniformSizes spheres(const double diameter)
{
  return {diameter, diameter, {1., 0.}};
}

/// Grains of 1 to 2 mm that rain from 20 to 32 mm.
InletParameters rain()
{
  InletParameters p;
  p.box = {Vec3(-6e-3, -6e-3, 20e-3), Vec3(6e-3, 6e-3, 32e-3)};
  p.grading = UniformSizes{1e-3, 2e-3, {1.4, 0.2}};
  p.mass_rate = 1e-2;
  p.velocity = Vec3(0., 0., -1.);
  p.velocity_spread = Vec3(0.1, 0.1, 0.2);
  p.step_interval = 20;
  p.seed = 7;
  return p;
}

OutletParameters below(const double height, const OutletRule rule = OutletRule::centre)
{
  return {HalfSpace{Vec3::UnitZ(), height}, rule, 10};
}

double balance(Simulation &s)
{
  s.compute_forces();
  return s.energy().balance();
}

bool touches(const Simulation &s, const std::vector<std::int64_t> &ids)
{
  const std::set<std::int64_t> wanted(ids.begin(), ids.end());
  for (const auto &some : {s.contacts.touching(s.particles), s.contacts.touching_walls(s.particles)})
    for (const TouchingContact &contact : some)
      if (wanted.contains(s.particles.id[contact.first]) ||
          (contact.second != no_grain && wanted.contains(s.particles.id[contact.second])))
        return true;
  return false;
}

std::uint64_t hash_of(const Inlet &inlet, const Outlet &outlet)
{
  StateHash hash;
  Inlet::visit_state(inlet, hash);
  Outlet::visit_state(outlet, hash);
  return hash.value();
}

void step(Simulation &s, Inlet &inlet, Outlet &outlet)
{
  s.step();
  inlet.act(s);
  outlet.act(s);
}

} // namespace

TEST_CASE("what flows in is inside or has flowed out, grain by grain, and the accounts close over both")
{
  const Threads one_thread(1);
  const double largest_mass = density * volume(Superquadric{Vec3::Constant(1e-3), 1., 1.}) * (1. + 4. * eps);
  Simulation s(soft_grains(), obstacle(Vec3(0., 0., 5e-3), 4e-3), {});
  Inlet inlet(rain(), s);
  Outlet outlet(below(-15e-3, OutletRule::whole_grain));
  std::map<std::int64_t, double> come, left; // masses by id
  Vec3 momentum = Vec3::Zero();
  double momenta = 0.; // sum of their lengths
  std::int64_t n_touching = 0;
  for (int n = 0; n < 14000; ++n)
  {
    Simulation without = s;
    const Exchange in = inlet.act(s);
    if (in.n_particles > 0)
    {
      const GrainEnergy before = (without.compute_forces(), without.energy());
      CHECK(std::abs(balance(s) - before.balance()) <
            1e-12 * (before.stored() + std::abs(before.gravity_work)) + 1e-18);
      CHECK_FALSE(touches(s, in.ids));
    }
    for (const std::int64_t id : in.ids)
    {
      CHECK(come.emplace(id, s.particles.mass[s.index_of(id)]).second);
      CHECK(id == static_cast<std::int64_t>(come.size()));
    }
    if (n % rain().step_interval == 0)
    {
      CHECK(inlet.debt(s) >= 0.);
      CHECK(inlet.debt(s) < inlet.next_share()); // never full here
      CHECK(inlet.n_waiting(s) == 0);
      CHECK(std::abs(rain().mass_rate * s.time - inlet.passed().mass) < largest_mass);
    }

    s.compute_forces();
    n_touching += s.contacts.n_touching();
    const Particles grains = s.particles;
    const GrainEnergy before = s.energy();
    const Exchange out = outlet.act(s);
    std::set<std::int64_t> gone(out.ids.begin(), out.ids.end());
    for (std::size_t i = 0; i < grains.size(); ++i)
    {
      const bool is_below = grains.position[i][2] + grains.bounding_radius[i] <= -15e-3;
      if (n % 10 == 0)
        CHECK(gone.contains(grains.id[i]) == is_below);
      if (!gone.contains(grains.id[i]))
        continue;
      CHECK(left.emplace(grains.id[i], grains.mass[i]).second);
      momentum += grains.mass[i] * grains.velocity[i];
      momenta += grains.mass[i] * grains.velocity[i].norm();
    }
    if (out.n_particles > 0)
      CHECK(std::abs(s.energy().balance() - before.balance()) <
            1e-12 * (before.stored() + std::abs(before.gravity_work) + std::abs(before.exchanged)));
    s.integrate();
  }
  CHECK(n_touching > 0);
  CHECK(outlet.passed().n_grains > 20);
  CHECK(s.particles.size() > 30);

  double inside = 0., outside = 0.;
  for (std::size_t i = 0; i < s.particles.size(); ++i)
    if (!s.particles.is_fixed(i))
    {
      const std::int64_t id = s.particles.id[i];
      CHECK_FALSE(left.contains(id));
      CHECK(come.at(id) == s.particles.mass[i]);
      inside += s.particles.mass[i];
    }
  for (const auto &[id, mass] : left)
  {
    CHECK(come.at(id) == mass);
    outside += mass;
  }
  CHECK(come.size() == left.size() + s.particles.size() - 1);
  CHECK(inlet.passed().n_grains == static_cast<std::int64_t>(come.size()));
  CHECK(outlet.passed().n_grains == static_cast<std::int64_t>(left.size()));
  // Sums of the same masses in another order.
  const double rounding = static_cast<double>(come.size()) * eps;
  CHECK(std::abs(outside - outlet.passed().mass) <= rounding * outside);
  CHECK(std::abs(inside + outside - inlet.passed().mass) <= rounding * inlet.passed().mass);
  CHECK(std::abs(outlet.passed().volume * density - outside) <= 2. * rounding * outside);
  CHECK((outlet.passed().momentum - momentum).norm() <= rounding * momenta);
}

TEST_CASE("over rain that touches nothing the balance of the energy keeps closed to rounding")
{
  const Threads one_thread(1);
  Simulation s(soft_grains(), obstacle(Vec3(1., 0., 0.), 1e-3), {});
  InletParameters p = rain();
  // One grain after the other: the next one comes when the one before is 4 mm below.
  p.box = {Vec3(-6e-3, -6e-3, 20e-3), Vec3(6e-3, 6e-3, 22.1e-3)};
  p.grading = spheres(2e-3);
  p.mass_rate = 0.;
  p.number_rate = 250.;
  p.velocity_spread.setZero();
  Inlet inlet(p, s);
  Outlet outlet(below(-15e-3));
  constexpr int n_steps = 15000;
  for (int n = 0; n < n_steps; ++n)
  {
    step(s, inlet, outlet);
    CHECK(s.contacts.n_touching() == 0);
  }
  CHECK(inlet.passed().n_grains == 18); // 18.75 are due
  CHECK(outlet.passed().n_grains > 5);
  // Each grain's step rounds its velocity and its place, and the sums of the energies round each term.
  const double deepest = 0.05, fastest = 1. + 2. * fall * deepest; // squared [m^2/s^2]
  const double scale = inlet.passed().mass * (fastest + fall * deepest);
  CHECK(std::abs(balance(s)) < 4. * n_steps * eps * scale);
  CHECK(std::abs(s.energy().exchanged) > 1e6 * std::abs(balance(s)));
}

TEST_CASE("in a full box grains wait, none overlaps and none overtakes, and their debt is kept until there is room")
{
  const Threads one_thread(1);
  SimulationParameters still = soft_grains();
  still.gravity.setZero();
  // A box about a fixed sphere and cut by an inclined wall.
  PlaneWall wall;
  wall.normal = Vec3(1., 0., 1.).normalized();
  wall.point = Vec3(-2e-3, 0., -2e-3);
  Simulation s(still, obstacle(Vec3(0., 0., 0.), 2e-3), {wall});
  InletParameters p = rain();
  p.box = {Vec3::Constant(-5e-3), Vec3::Constant(5e-3)};
  p.grading = UniformSizes{1.5e-3, 2e-3, {3., 0.3}};
  p.mass_rate = 100.;
  p.velocity.setZero();
  p.velocity_spread.setZero();
  p.step_interval = 1;
  p.n_trials = 1000;
  Inlet inlet(p, s);
  for (int n = 0; n < 5; ++n)
  {
    s.step();
    const Exchange in = inlet.act(s);
    s.compute_forces();
    CHECK(s.contacts.n_touching() == 0);
    CHECK(s.contacts.n_touching_walls() == 0);
  }
  CHECK(inlet.passed().n_grains > 20);
  const std::int64_t n_waiting = inlet.n_waiting(s);
  CHECK(n_waiting > 10);
  CHECK(inlet.debt(s) == p.mass_rate * s.time - inlet.passed().mass);
  CHECK(inlet.debt(s) >= inlet.next_share());

  bool spheres_overlap = false;
  for (std::size_t i = 0; i < s.particles.size(); ++i)
  {
    if (s.particles.is_fixed(i))
      continue;
    const double r = s.particles.bounding_radius[i];
    CHECK((s.particles.position[i].array().abs() + r <= 5e-3 * (1. + 2. * eps)).all());
    CHECK(wall.normal.dot(s.particles.position[i] - wall.point) > 0.);
    for (std::size_t j = 0; j < i; ++j)
      spheres_overlap = spheres_overlap ||
                        (s.particles.position[i] - s.particles.position[j]).norm() < r + s.particles.bounding_radius[j];
  }
  CHECK(spheres_overlap); // bodies are held apart, not their spheres

  // The same grains as where there is room at once, in the same order.
  InletParameters wide = p;
  wide.box = {Vec3(0.1, 0., 0.), Vec3(0.2, 0.1, 0.1)};
  Simulation roomy(still, obstacle(Vec3::Zero(), 2e-3), {});
  Inlet other(wide, roomy);
  for (int n = 0; n < 5; ++n)
  {
    roomy.step();
    other.act(roomy);
  }
  CHECK(other.n_waiting(roomy) == 0);
  CHECK(other.passed().n_grains == inlet.passed().n_grains + n_waiting);
  for (std::int64_t id = 1; id <= inlet.passed().n_grains; ++id)
    CHECK(s.particles.mass[s.index_of(id)] == roomy.particles.mass[roomy.index_of(id)]);

  // Room is made: those that wait come.
  s.integrate();
  const std::int64_t before = inlet.passed().n_grains;
  Outlet outlet({Box{Vec3::Constant(-1.), Vec3::Constant(1.)}, OutletRule::centre, 1});
  inlet.act(s);
  CHECK(outlet.act(s).n_particles > 0);
  CHECK(s.particles.size() == 1); // the fixed one stays
  s.integrate();
  inlet.act(s);
  CHECK(inlet.passed().n_grains > before + 10);
}

TEST_CASE("flow has the same bits on any number of threads and after a restart")
{
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "flow.h5";
  // So many grains that threads share the work: the outlet eats into them layer by layer, the inlet fills their gaps.
  SimulationParameters p = soft_grains();
  p.sort_interval = 1;
  InletParameters in = rain();
  in.box = {Vec3(2.1e-3, 2.1e-3, 40e-3), Vec3(20e-3, 20e-3, 50e-3)};
  in.grading = UniformSizes{0.5e-3, 1e-3, {1.5, 0.3}};
  in.mass_rate = 4.; // more than there is room for
  in.step_interval = 7;
  in.n_trials = 20;
  OutletParameters out = below(3e-3);
  std::vector<std::uint64_t> hashes;
  for (const int n_threads : {1, 2, 3, 1})
  {
    const Threads threads(n_threads);
    const bool restarts = hashes.size() == 3;
    Particles lattice;
    for (int i = 0; i < 3000; ++i)
      lattice.add({Vec3::Constant(0.9e-3), 1., 1.}, density, 2.1e-3 * Vec3(i % 10, i / 10 % 10, i / 100),
                  Quaternion::Identity());
    for (Vec3 &velocity : lattice.velocity)
      velocity = Vec3(0., 0., -2.);
    auto s = std::make_unique<Simulation>(p, lattice, std::vector<PlaneWall>{});
    auto inlet = std::make_unique<Inlet>(in, *s);
    auto outlet = std::make_unique<Outlet>(out);
    for (int n = 0; n < 200; ++n)
    {
      step(*s, *inlet, *outlet);
      if (!restarts || n != 101)
        continue;
      {
        ArchiveWriter archive(file, "flow");
        write_simulation(archive, *s);
        StateWriter inlet_writer(archive, "inlet"), outlet_writer(archive, "outlet");
        Inlet::visit_state(*inlet, inlet_writer);
        Outlet::visit_state(*outlet, outlet_writer);
        archive.commit();
      }
      const ArchiveReader archive(file, "flow");
      s = read_simulation(archive, p);
      inlet = std::make_unique<Inlet>(in, *s);
      outlet = std::make_unique<Outlet>(out);
      StateReader inlet_reader(archive, "inlet"), outlet_reader(archive, "outlet");
      Inlet::visit_state(*inlet, inlet_reader);
      Outlet::visit_state(*outlet, outlet_reader);
    }
    CHECK(inlet->passed().n_grains > 10);
    CHECK(inlet->n_waiting(*s) > 0);
    CHECK(outlet->passed().n_grains > 100);
    hashes.push_back(state_hash(*s) ^ hash_of(*inlet, *outlet));
  }
  CHECK(hashes[1] == hashes[0]);
  CHECK(hashes[2] == hashes[0]);
  CHECK(hashes[3] == hashes[0]);
}

TEST_CASE("an outlet takes grains by their centre or as a whole, and leaves fixed ones")
{
  const Threads one_thread(1);
  SimulationParameters p = soft_grains();
  p.gravity.setZero();
  const Superquadric sphere{Vec3::Constant(1e-3), 1., 1.};
  Particles grains;
  for (const double x : {0., 0.75e-3, 3e-3, 5.5e-3, 9.5e-3, 9.9e-3})
    grains.add(sphere, density, Vec3(x, 3e-3 * static_cast<double>(grains.size()), 0.), Quaternion::Identity());
  grains.fix(2);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Box slab{Vec3(0.5e-3, -infinite, -infinite), Vec3(9.7e-3, infinite, infinite)};
  using Ids = std::set<std::int64_t>;
  const auto gone = [&](const OutletParameters &parameters)
  {
    Simulation s(p, grains, {});
    Outlet outlet(parameters);
    const Exchange exchange = outlet.act(s);
    CHECK(outlet.ids_of_last_check() == exchange.ids);
    CHECK(outlet.passed().mass == exchange.mass);
    s.integrate();
    CHECK(outlet.act(s).n_particles == 0);
    CHECK(outlet.ids_of_last_check().size() == (parameters.step_interval == 1 ? 0 : exchange.ids.size()));
    return Ids(exchange.ids.begin(), exchange.ids.end());
  };
  CHECK(gone({slab, OutletRule::centre, 1}) == Ids{1, 3, 4});
  CHECK(gone({slab, OutletRule::whole_grain, 1}) == Ids{3});
  CHECK(gone({HalfSpace{-Vec3::UnitX(), -9e-3}, OutletRule::centre, 2}) == Ids{4, 5});
  CHECK(gone({HalfSpace{-Vec3::UnitX(), -8.7e-3}, OutletRule::whole_grain, 2}) == Ids{5});
}

TEST_CASE("an inlet's and an outlet's bad input is refused by name")
{
  const Threads one_thread(1);
  Simulation s(soft_grains(), obstacle(Vec3::Zero(), 1e-3), {PlaneWall()});
  const auto check_inlet = [&](const std::string &name, const auto &change)
  {
    InletParameters p = rain();
    change(p);
    CHECK_THROWS_WITH(Inlet(p, s), Catch::Contains(name));
    CHECK_THROWS_AS(Inlet(p, s), ConfigError);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  check_inlet("box along z", [](auto &p) { p.box.high[2] = p.box.low[2] + 2e-3; });
  check_inlet("box along x", [](auto &p) { std::swap(p.box.low, p.box.high); });
  check_inlet("inlet's box", [&](auto &p) { p.box.low[1] = nan; });
  check_inlet("box above a wall", [](auto &p) { p.box = {Vec3(0., 0., -1.), Vec3(1., 1., 0.)}; });
  check_inlet("elongation", [](auto &p) { p.grading = UniformSizes{1e-3, 2e-3, {0.5, 0.2}}; });
  check_inlet("material", [](auto &p) { p.material = 2; });
  check_inlet("mass rate", [](auto &p) { p.mass_rate = 0.; });
  check_inlet("mass rate", [](auto &p) { p.number_rate = 1.; });
  check_inlet("mass rate", [](auto &p) { p.mass_rate = -1.; });
  check_inlet("number rate", [&](auto &p) { p.number_rate = nan; });
  check_inlet("velocity", [&](auto &p) { p.velocity[1] = nan; });
  check_inlet("spread", [](auto &p) { p.velocity_spread[1] = -1.; });
  check_inlet("steps between", [](auto &p) { p.step_interval = 0; });
  check_inlet("trials", [](auto &p) { p.n_trials = 0; });

  const auto check_outlet = [](const std::string &name, const OutletParameters &p)
  {
    CHECK_THROWS_WITH(Outlet(p), Catch::Contains(name));
    CHECK_THROWS_AS(Outlet(p), ConfigError);
  };
  check_outlet("box", {Box{Vec3::Ones(), Vec3::Zero()}, OutletRule::centre, 1});
  check_outlet("box", {Box{Vec3::Constant(nan), Vec3::Ones()}, OutletRule::centre, 1});
  check_outlet("normal", {HalfSpace{Vec3::Ones(), 0.}, OutletRule::centre, 1});
  check_outlet("offset", {HalfSpace{Vec3::UnitX(), nan}, OutletRule::centre, 1});
  check_outlet("steps between", {HalfSpace{Vec3::UnitX(), 0.}, OutletRule::centre, 0});

  // Nothing has changed where the middle of a step refuses what comes.
  InletParameters p = rain();
  p.mass_rate = 1e3;
  Inlet inlet(p, s);
  for (int n = 0; n < p.step_interval; ++n)
    s.step();
  s.compute_forces();
  CHECK_THROWS_WITH(inlet.act(s), Catch::Contains("between steps"));
  CHECK(inlet.passed().n_grains == 0);

  SimulationParameters still = soft_grains();
  still.gravity.setZero();
  Particles grains;
  grains.add({Vec3::Constant(1e-3), 1., 1.}, density, Vec3::Constant(5e-3), Quaternion::Identity());
  Simulation alone(still, grains, {});
  Outlet all({Box{Vec3::Zero(), Vec3::Ones()}, OutletRule::centre, 1});
  CHECK_THROWS_AS(all.act(alone), RunError);
  CHECK(all.passed().n_grains == 0);
  grains.cell = PeriodicCell(Vec3::Constant(1e-2));
  Simulation periodic(still, grains, {});
  CHECK_THROWS_WITH(Inlet(rain(), periodic), Catch::Contains("periodic"));
  CHECK_THROWS_WITH(all.act(periodic), Catch::Contains("periodic"));
}
