#include "dem/core/error.h"
#include "dem/io/snapshot.h"
#include "dem/measure/cell_sums.h"
#include "dem/motion/cell_control.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/simulation/simulation.h"

#include "tests/temporary_folder.h"
#include "tests/threads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

SimulationParameters sand()
{
  SimulationParameters p;
  p.grain() = {50e9, 0.2, 2650.};
  p.wall() = p.grain();
  p.between_grains().friction = 0.24;
  p.set_damping(0.9);
  p.time_step = 1.2e-7; // stable up to 2.2e-7 s at that pressure
  return p;
}

/// Loose grains in a cube with periodic faces.
Particles loose_grains(const double edge, const double solid_fraction)
{
  std::mt19937_64 generator(7);
  const Box box{Vec3::Zero(), Vec3::Constant(edge)};
  const auto grains = draw_grains(GrainDistribution(), solid_fraction * box.volume(), generator);
  Particles particles = add_at_random(grains, box, 2650., 7);
  particles.cell = PeriodicCell(Vec3::Constant(edge));
  return particles;
}

/// A cell and who controls it.
struct Loaded
{
  std::unique_ptr<Simulation> simulation;
  CellControl control;

  void step(const std::array<AxisControl, 3> &controls, const std::int64_t n = 1)
  {
    for (std::int64_t k = 0; k < n; ++k)
    {
      simulation->compute_forces();
      act(controls);
      simulation->integrate();
    }
  }

  void act(const std::array<AxisControl, 3> &controls)
  {
    control.act(simulation->particles.cell, controls, simulation->cell_stress(), simulation->parameters().time_step);
  }
};

std::array<AxisControl, 3> isotropic(const double pressure)
{
  return {AxisControl::of_stress(-pressure), AxisControl::of_stress(-pressure), AxisControl::of_stress(-pressure)};
}

std::array<AxisControl, 3> shearing(const double pressure, const double rate)
{
  return {AxisControl::of_stress(-pressure), AxisControl::of_stress(-pressure), AxisControl::of_rate(rate)};
}

/// About 300 grains under a pressure that presses them well together, so that differences show.
Loaded pressed_cell(const double pressure, const std::int64_t n_steps)
{
  CellControlParameters control;
  control.largest_rate = 100.;
  Loaded loaded{std::make_unique<Simulation>(sand(), loose_grains(7.5e-3, 0.22), std::vector<PlaneWall>{}),
                CellControl(control)};
  loaded.step(isotropic(pressure), n_steps);
  return loaded;
}

constexpr double pressure = 2e5;
constexpr std::int64_t pressing = 45000; // steps

/// The cell pressed once, for tests that go on from there.
std::unique_ptr<Simulation> pressed_copy()
{
  static const Loaded loaded = pressed_cell(pressure, pressing);
  return std::make_unique<Simulation>(*loaded.simulation);
}

Vec3 peculiar_momentum(const Simulation &s)
{
  Vec3 sum = Vec3::Zero();
  const PeriodicCell &cell = s.particles.cell;
  for (std::size_t i = 0; i < s.particles.size(); ++i)
  {
    const Vec3 affine = cell.rate.cwiseQuotient(cell.edges).cwiseProduct(s.particles.position[i]);
    sum += s.particles.mass[i] * (s.particles.velocity[i] - affine);
  }
  return sum;
}

double solid_fraction(const Simulation &s)
{
  double mass = 0.;
  for (const double m : s.particles.mass)
    mass += m;
  return mass / 2650. / s.particles.cell.volume();
}

} // namespace

TEST_CASE("a periodic cell is pressed to the pressure that is asked for")
{
  // Free grains hit the packing for long, so the stress of one step is a matter of chance; the control promises its
  // mean. It moves the stress on the walls by the miss over a time constant, 0.03 of the rate at which the damper slows
  // the walls, and that stress follows the grains'. Over n time constants the mean therefore misses the pressure by at
  // most an n-th of what the stress moves by.
  constexpr double n_time_constants = 10.;
  const CellControlParameters walls;
  Loaded loaded{pressed_copy(), CellControl(walls)};
  Simulation &s = *loaded.simulation;
  loaded.control.start_from(s.cell_stress());
  const double inertia = walls.wall_density * walls.wall_thickness * s.particles.cell.edges.minCoeff();
  const double rate = 0.03 * 2. * walls.damping_ratio * std::sqrt(walls.modulus / inertia);
  const auto n_steps = static_cast<int>(std::ceil(n_time_constants / rate / s.parameters().time_step));
  Vec3 sum = Vec3::Zero(), lowest = Vec3::Constant(INFINITY), highest = -lowest;
  double most_kinetic = 0., least_elastic = INFINITY;
  for (int k = 0; k < n_steps; ++k)
  {
    s.compute_forces();
    loaded.act(isotropic(pressure));
    const Vec3 stress = s.cell_stress();
    sum += stress;
    lowest = lowest.cwiseMin(stress);
    highest = highest.cwiseMax(stress);
    const GrainEnergy e = s.energy();
    most_kinetic = std::max(most_kinetic, e.kinetic);
    least_elastic = std::min(least_elastic, e.normal + e.tangential);
    s.integrate();
  }
  // An oscillation of the kinetic energy K on springs that hold the elastic energy U moves their force by sqrt(K/U) of
  // it; the control corrects where that is below a tenth.
  const double agitation = std::sqrt(most_kinetic / least_elastic);
  CHECK(agitation < 0.1);
  for (int d = 0; d < 3; ++d)
  {
    CAPTURE(d, lowest[d], highest[d], sum[d] / n_steps, agitation);
    CHECK(std::abs(sum[d] / n_steps + pressure) < (highest[d] - lowest[d]) / n_time_constants);
    CHECK(std::max(highest[d] + pressure, -pressure - lowest[d]) < agitation * pressure);
  }
  // Random close packings of such grains with friction lie between 0.6 and 0.72 (Wellmann, fig. 5.4).
  CAPTURE(solid_fraction(s));
  CHECK(solid_fraction(s) > 0.6);
  CHECK(solid_fraction(s) < 0.74);
}

TEST_CASE("the mean stress over branches equals that over the faces up to the grains' inertia")
{
  // sum over contacts of branch x force = sum over images of shift x force - sum over grains of place x resultant
  // (Wellmann 5.3-5.5, with the resultants that are not zero while grains move): to rounding.
  const auto simulation = pressed_copy();
  Simulation &s = *simulation;
  for (const int n : {0, 50})
  {
    for (int k = 0; k < n; ++k)
      s.step();
    s.compute_forces();
    Mat3 branches = Mat3::Zero(), faces = Mat3::Zero();
    for (const TouchingContact &c : s.contacts.touching(s.particles))
    {
      const Vec3 force = c.state.weight * c.state.force();
      branches += c.branch * force.transpose();
      faces += s.particles.cell.place[c.image] * force.transpose();
    }
    Vec3 places = Vec3::Zero();
    for (std::size_t i = 0; i < s.particles.size(); ++i)
      places += s.particles.position[i].cwiseProduct(s.particles.force[i]);
    const double scale = branches.norm();
    CHECK((branches.diagonal() - s.contacts.virial().branch).norm() < 1e-13 * scale);
    CHECK((faces.diagonal() - s.contacts.virial().image).norm() < 1e-13 * scale);
    CHECK((branches.diagonal() - faces.diagonal() + places).norm() < 1e-12 * scale);
    // At rest both agree, and the stress is symmetric.
    CHECK((branches.diagonal() - faces.diagonal()).norm() < 0.01 * scale);
    CHECK((branches - branches.transpose()).norm() < 0.01 * scale);
    s.integrate();
  }
}

TEST_CASE("a periodic cell keeps momentum and the balance of energy while it is sheared")
{
  // At rest on the whole, and drifting, so that a fourth of the grains goes through the faces.
  const Vec3 drift = GENERATE(Vec3(Vec3::Zero()), Vec3(0.5, -0.5, 0.7));
  Loaded loaded{pressed_copy(), CellControl(CellControlParameters{})};
  Simulation &s = *loaded.simulation;
  for (Vec3 &v : s.particles.velocity)
    v += drift;
  loaded.control.start_from(s.cell_stress());
  s.reset_accounts();
  const auto controls = shearing(pressure, -30.);
  const auto step_and_read = [&]
  {
    s.compute_forces();
    loaded.act(controls);
    const GrainEnergy e = s.energy();
    s.integrate();
    return e;
  };
  const double first = step_and_read().balance();
  std::vector<Vec3> before = s.particles.position;
  std::vector<std::int64_t> ids = s.particles.id;
  std::set<std::int64_t> crossed;
  for (int k = 0; k < 12000; ++k)
  {
    const std::int64_t n_rebuilds = s.n_rebuilds();
    loaded.step(controls);
    if (s.n_rebuilds() == n_rebuilds)
      continue;
    for (std::size_t i = 0; i < ids.size(); ++i)
      if ((s.particles.position[s.index_of(ids[i])] - before[i]).norm() > 3e-3)
        crossed.insert(ids[i]);
    before = s.particles.position;
    ids = s.particles.id;
  }
  const GrainEnergy last = step_and_read();
  CAPTURE(last.cell_work, last.kinetic, last.friction_loss, last.viscous_loss, last.curvature_work, crossed.size());
  CHECK(last.cell_work > 10. * last.kinetic);
  // Contacts followed between searches keep energy to the tolerance of the overlap, crossings to a step's change of
  // the rate: both far below a per mille of the work.
  CHECK(std::abs(last.balance() - first) < 1e-3 * last.cell_work);
  if (!drift.isZero())
  {
    CHECK(crossed.size() > s.particles.size() / 8);
    return;
  }
  double scale = 0.;
  for (std::size_t i = 0; i < s.particles.size(); ++i)
    scale += s.particles.mass[i] * s.particles.velocity[i].norm();
  CHECK(peculiar_momentum(s).norm() < 1e-9 * scale);
}

TEST_CASE("a cell copied 2 x 2 x 2 has the same stress")
{
  const auto simulation = pressed_copy();
  Simulation &single = *simulation;
  Particles many;
  const Vec3 edges = single.particles.cell.edges;
  for (int image = 0; image < 8; ++image)
  {
    const Vec3 shift = Vec3(image & 1, image >> 1 & 1, image >> 2 & 1).cwiseProduct(edges);
    for (std::size_t i = 0; i < single.particles.size(); ++i)
      many.add(single.particles.parts.shape[i], 2650., single.particles.position[i] + shift,
               single.particles.orientation[i]);
  }
  many.cell = PeriodicCell(2. * edges);
  Simulation copied(sand(), many, {});
  Particles again = single.particles; // without history, as the copies
  for (auto *v : {&again.velocity, &again.drift_velocity, &again.angular_momentum, &again.angular_velocity})
    std::fill(v->begin(), v->end(), Vec3::Zero());
  again.cell = PeriodicCell(edges);
  Simulation fresh(sand(), again, {});
  for (int k = 0; k < 20; ++k)
  {
    fresh.step();
    copied.step();
  }
  fresh.compute_forces();
  copied.compute_forces();
  CHECK(copied.contacts.n_touching() == 8 * fresh.contacts.n_touching());
  CHECK((copied.cell_stress() - fresh.cell_stress()).norm() < 1e-9 * fresh.cell_stress().norm());
}

TEST_CASE("no place of a periodic cell is special")
{
  // All grains shifted by the same vector, and so cut by the faces elsewhere: the same stresses and edges under the
  // same loading, to the rounding that the places' last bits bring in.
  const auto simulation = pressed_copy();
  const Vec3 shift(1.7e-3, -0.9e-3, 2.3e-3);
  std::vector<Loaded> cells;
  for (const double share : {0., 1.})
  {
    Particles p = simulation->particles;
    p.cell = PeriodicCell(p.cell.edges);
    for (auto *v : {&p.velocity, &p.drift_velocity, &p.angular_momentum, &p.angular_velocity})
      std::fill(v->begin(), v->end(), Vec3::Zero());
    for (Vec3 &x : p.position)
      x += share * shift;
    cells.push_back(
        {std::make_unique<Simulation>(sand(), p, std::vector<PlaneWall>{}), CellControl(CellControlParameters{})});
    cells.back().step(shearing(pressure, -5.), 300);
  }
  const PeriodicCell &one = cells[0].simulation->particles.cell, &other = cells[1].simulation->particles.cell;
  const Vec3 change = one.edges - simulation->particles.cell.edges;
  CHECK(change[2] == Approx(-5. * 300 * 1.2e-7 * one.edges[2]).epsilon(0.01));
  CHECK((one.edges - other.edges).norm() < 1e-5 * change.norm());
  CHECK((cells[0].simulation->cell_stress() - cells[1].simulation->cell_stress()).norm() <
        1e-5 * cells[0].simulation->cell_stress().norm());
}

TEST_CASE("grains that are tied to places of a continuum leave a periodic cell, and meet the images that they would")
{
  // All of half a weight: the same motion as with the whole, at half of the forces, and none is put back.
  constexpr double speed = 20., rate = -5.; // through the faces [m/s], of strain [1/s]
  constexpr int n_steps = 500;
  std::vector<std::unique_ptr<Simulation>> cells;
  for (const double weight : {1., 0.5})
  {
    Simulation &s = *cells.emplace_back(std::make_unique<Simulation>(*pressed_copy()));
    std::vector<std::int32_t> all(s.particles.size());
    std::iota(all.begin(), all.end(), 0);
    s.change_weights(all, std::vector<double>(all.size(), weight));
    for (Vec3 &v : s.particles.velocity)
      v[0] += speed;
    CellControl control{CellControlParameters{}};
    for (int k = 0; k < n_steps; ++k)
    {
      s.compute_forces();
      control.act(s.particles.cell, {AxisControl::of_rate(rate), AxisControl::of_rate(0.), AxisControl::of_rate(0.)},
                  s.cell_stress(), s.parameters().time_step);
      s.integrate();
    }
    s.compute_forces();
  }
  const Vec3 &edges = cells[0]->particles.cell.edges;
  const double way = n_steps * sand().time_step * speed;
  double farthest = 0., greatest = 0.;
  for (std::size_t i = 0; i < cells[0]->particles.size(); ++i)
  {
    const std::int64_t id = cells[0]->particles.id[i];
    const Vec3 &tied = cells[1]->particles.position[cells[1]->index_of(id)];
    farthest = std::max(farthest, tied[0] - edges[0]);
    Vec3 apart = tied - cells[0]->particles.position[i];
    apart -= edges.cwiseProduct(apart.cwiseQuotient(edges).array().round().matrix());
    greatest = std::max(greatest, apart.norm());
  }
  REQUIRE(farthest > 0.5 * way);
  // Contacts of other weights were searched anew: what they had been off by, within the tolerance of overlaps.
  CHECK(greatest < 1e-5 * way);
  CHECK((2. * cells[1]->cell_stress() - cells[0]->cell_stress()).norm() < 1e-3 * cells[0]->cell_stress().norm());
}

TEST_CASE("slabs of a periodic cell bear together what it bears, wherever grains and cuts are")
{
  const auto simulation = pressed_copy();
  simulation->compute_forces();
  const Particles &p = simulation->particles;
  const std::vector<TouchingContact> contacts = simulation->contacts.touching(p);
  const Vec3 stress = simulation->cell_stress();
  for (const auto &cells : {std::array{1, 1, 4}, std::array{3, 2, 1}, std::array{2, 3, 2}})
  {
    CellSums sums({{Vec3::Zero(), p.cell.edges}, cells});
    add_contacts(sums, contacts, p);
    Vec3 sum = Vec3::Zero();
    for (const Mat3 &of_cell : sums.sums())
      sum += of_cell.diagonal();
    CHECK((sum / p.cell.volume() - stress).norm() < 1e-11 * stress.norm());
  }
  CellSums slabs({{Vec3::Zero(), p.cell.edges}, {1, 1, 3}});
  add_contacts(slabs, contacts, p);
  for (const Mat3 &slab : slabs.means()) // but for what accelerates grains
    CHECK(slab(2, 2) == Approx(stress[2]).epsilon(0.02));
}

TEST_CASE("a periodic cell under control has the same bits on any number of threads and after a restart")
{
  const TemporaryFolder folder;
  const auto state = [](const Simulation &s)
  {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < s.particles.size(); ++i)
      for (int d = 0; d < 3; ++d)
      {
        numbers.push_back(s.particles.position[i][d]);
        numbers.push_back(s.particles.angular_momentum[i][d]);
      }
    for (int d = 0; d < 3; ++d)
      numbers.push_back(s.particles.cell.edges[d]);
    numbers.push_back(s.energy().balance());
    return numbers;
  };
  const auto start = pressed_copy();
  std::vector<std::vector<double>> ends;
  for (const int n : {1, 2, 3, 8})
  {
    const Threads threads(n);
    Loaded loaded{std::make_unique<Simulation>(*start), CellControl(CellControlParameters{})};
    loaded.control.start_from(loaded.simulation->cell_stress());
    loaded.step(shearing(pressure, -30.), 1500);
    if (n == 2)
    {
      ArchiveWriter writer(folder.path() / "cell.h5", "grain snapshot");
      write_simulation(writer, *loaded.simulation);
      writer.commit();
      const Vec3 applied = loaded.control.applied;
      loaded.simulation = read_simulation(ArchiveReader(folder.path() / "cell.h5", "grain snapshot"), sand());
      loaded.control.applied = applied;
    }
    loaded.step(shearing(pressure, -30.), 1500);
    loaded.simulation->compute_forces();
    ends.push_back(state(*loaded.simulation));
  }
  for (const auto &end : ends)
    CHECK(std::memcmp(end.data(), ends[0].data(), end.size() * sizeof(double)) == 0);
}

TEST_CASE("periodic cells that cannot be are refused")
{
  Particles narrow;
  narrow.add({{1e-3, 1e-3, 1e-3}, 1., 1.}, 2650., Vec3::Constant(1e-3), Quaternion::Identity());
  narrow.cell = PeriodicCell(Vec3(3.9e-3, 1e-2, 1e-2));
  CHECK_THROWS_WITH(Simulation(sand(), narrow, {}), Catch::Contains("0.0039") && Catch::Contains("larger"));
  narrow.cell = PeriodicCell(Vec3::Constant(1e-2));
  CHECK_NOTHROW(Simulation(sand(), narrow, {}));
  CHECK_THROWS_WITH(Simulation(sand(), narrow, {PlaneWall{}}), Catch::Contains("wall 0"));
  SimulationParameters falling = sand();
  falling.gravity = Vec3(0., 0., -9.81);
  CHECK_THROWS_WITH(Simulation(falling, narrow, {}), Catch::Contains("gravity"));
}
