#include "dem/core/error.h"
#include "dem/io/snapshot.h"
#include "dem/loading/cell_loading.h"
#include "dem/packing/pack_grains.h"
#include "dem/simulation/simulation.h"

#include "tests/temporary_folder.h"
#include "tests/threads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

/// Cells that repeat themselves in some directions alone.
using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double g = 9.81, density = 2500.;

SimulationParameters soft()
{
  SimulationParameters p;
  p.grain() = {1e7, 0.25, density};
  p.wall() = p.grain();
  p.between_grains().friction = 0.3;
  p.with_walls().friction = 0.2;
  p.set_damping(0.5);
  p.time_step = 5e-6; // stable up to some 4e-5 s
  p.gravity = {0., 0., -g};
  return p;
}

double mass_of(const Particles &p)
{
  return std::accumulate(p.mass.begin(), p.mass.end(), 0.);
}

Vec3 momentum_of(const Particles &p)
{
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i)
    sum += p.mass[i] * p.velocity[i];
  return sum;
}

/// Some ninety superquadrics of 2 mm on a floor in a cell of 10 x 9 mm, settled for 0.15 s.
const Simulation &settled_layer()
{
  static const Simulation layer = []
  {
    PackingParameters packing;
    packing.solid_fraction = 0.45;
    packing.density = density;
    GrainDistribution sizes;
    sizes.mean_half_axes = {1.1e-3, 1e-3, 0.8e-3};
    sizes.smallest_half_axis = 0.6e-3;
    sizes.largest_half_axis = 1.3e-3;
    const Box box{Vec3::Zero(), Vec3(10e-3, 9e-3, 9e-3)};
    Particles grains = pack_grains(sizes, PackingSpace::periodic(box, {true, true, false}), packing, 3).particles;
    grains.cell = PeriodicCell(Vec3(box.high[0], box.high[1], infinite));
    Simulation s(soft(), grains, {PlaneWall{}});
    for (int k = 0; k < 30000; ++k)
      s.step();
    return s;
  }();
  return layer;
}

/// The same grains without motion or history, moved.
Particles at_rest(const Particles &grains, const Vec3 &shift)
{
  Particles p = grains;
  p.cell = PeriodicCell(p.cell.edges);
  for (auto *v : {&p.velocity, &p.drift_velocity, &p.angular_momentum, &p.angular_velocity})
    std::fill(v->begin(), v->end(), Vec3::Zero());
  for (Vec3 &x : p.position)
    x += shift;
  return p;
}

} // namespace

TEST_CASE("a grain that slides and rolls through the faces of a cell moves as on an infinite floor")
{
  const Superquadric shape =
      GENERATE(Superquadric{Vec3::Constant(1e-3), 1., 1.}, Superquadric{Vec3(1.2e-3, 1e-3, 0.9e-3), 0.8, 0.9});
  const bool is_sphere = shape.is_sphere();
  const double speed = 0.5, edge = 6e-3, friction = soft().with_walls().friction;
  Particles grain;
  grain.add(shape, density, Vec3(1e-3, 0., shape.half_axes[2]), Quaternion::Identity());
  grain.velocity[0] = Vec3(speed, 0.1 * speed, 0.);
  Simulation infinite_floor(soft(), grain, {PlaneWall{}});
  grain.cell = PeriodicCell(Vec3(edge, infinite, infinite));
  Simulation cell(soft(), grain, {PlaneWall{}});
  const double start = cell.energy().balance(), kinetic = 0.5 * grain.mass[0] * grain.velocity[0].squaredNorm();
  int n_crossings = 0;
  double last_x = cell.particles.position[0][0], friction_loss = 0.;
  for (int k = 0; k < 40000; ++k)
  {
    infinite_floor.step();
    cell.step();
    n_crossings += std::abs(cell.particles.position[0][0] - last_x) > 0.5 * edge;
    last_x = cell.particles.position[0][0];
    if (k == 10000)
      friction_loss = cell.energy().friction_loss;
  }
  const Particles &p = cell.particles, &q = infinite_floor.particles;
  CHECK(n_crossings >= 8);
  CHECK(friction_loss > 0.1 * kinetic);
  // Neither height nor velocities know the place along the floor; places are put back by whole edges.
  CHECK((p.velocity[0] - q.velocity[0]).norm() < 1e-12 * speed);
  CHECK((p.angular_velocity[0] - q.angular_velocity[0]).norm() < 1e-12 * q.angular_velocity[0].norm());
  CHECK((p.orientation[0].coeffs() - q.orientation[0].coeffs()).norm() < 1e-12);
  const Vec3 apart = q.position[0] - p.position[0] - n_crossings * Vec3(edge, 0., 0.);
  CHECK(apart.norm() < 1e-11 * q.position[0].norm());
  cell.compute_forces();
  CHECK(std::abs(cell.energy().balance() - start) < 1e-4 * kinetic);
  if (!is_sphere)
    return;
  // A sphere slides until it has lost two sevenths of its speed, and then rolls.
  const double slide_time = 2. * grain.velocity[0].norm() / (7. * friction * g);
  REQUIRE(slide_time < 40000 * soft().time_step);
  CHECK((p.velocity[0] - 5. / 7. * grain.velocity[0]).norm() < 1e-3 * speed);
  CHECK((p.angular_velocity[0] - Vec3::UnitZ().cross(p.velocity[0]) / 1e-3).norm() < 2e-3 * speed / 1e-3);
}

TEST_CASE("a layer in a cell without a top bears on its floor what it weighs, and its energies add up")
{
  Simulation s = settled_layer();
  const double weight = mass_of(s.particles) * g;
  CHECK(s.particles.size() > 80);
  Vec3 force = Vec3::Zero();
  constexpr int n = 2000; // a swing of what still moves
  for (int k = 0; k < n; ++k)
  {
    s.compute_forces();
    force += s.walls[0].force / n;
    s.integrate();
  }
  CHECK(std::abs(force[2] + weight) < 1e-3 * weight);
  CHECK(force.head<2>().norm() < 1e-3 * weight);
  const GrainEnergy e = s.energy();
  CAPTURE(e.gravity_work, e.kinetic, e.friction_loss, e.viscous_loss);
  CHECK(e.gravity_work > 1e3 * e.kinetic);
  CHECK(std::abs(e.balance()) < 1e-3 * e.gravity_work);
}

TEST_CASE("momentum changes by gravity and the floor alone while grains go through the faces of an open cell")
{
  Simulation s = settled_layer();
  s.rest();
  for (Vec3 &v : s.particles.velocity)
    v = Vec3(0.4, -0.3, 0.05);
  s.reset_accounts();
  const double mass = mass_of(s.particles), scale = mass * 0.5;
  s.compute_forces();
  const GrainEnergy start = s.energy();
  double worst = 0.;
  for (int k = 0; k < 4000; ++k)
  {
    s.compute_forces();
    const Vec3 before = momentum_of(s.particles),
               impulse = s.parameters().time_step * (mass * s.parameters().gravity - s.walls[0].force);
    s.integrate();
    worst = std::max(worst, (momentum_of(s.particles) - before - impulse).norm());
  }
  CHECK(worst < 1e-12 * scale);
  s.compute_forces();
  const GrainEnergy end = s.energy();
  CHECK(end.friction_loss > 0.05 * start.kinetic);
  CHECK(std::abs(end.balance() - start.balance()) < 1e-3 * start.kinetic);
  std::int64_t n_outside = 0;
  for (const Vec3 &x : s.particles.position)
    n_outside += x[0] < -1e-3 || x[0] > 11e-3 || x[1] < -1e-3 || x[1] > 10e-3;
  CHECK(n_outside == 0); // they have gone some 6 mm, and have been put back
}

TEST_CASE("a layer cut elsewhere by the faces of its cell is the same layer")
{
  const Particles &grains = settled_layer().particles;
  std::vector<std::unique_ptr<Simulation>> layers;
  for (const double share : {0., 1.})
  {
    layers.push_back(std::make_unique<Simulation>(soft(), at_rest(grains, share * Vec3(3.7e-3, -1.9e-3, 0.)),
                                                  std::vector<PlaneWall>{PlaneWall{}}));
    for (int k = 0; k < 300; ++k)
      layers.back()->step();
    layers.back()->compute_forces();
  }
  const Simulation &one = *layers[0], &other = *layers[1];
  const double weight = mass_of(grains) * g;
  CHECK((one.walls[0].force - other.walls[0].force).norm() < 1e-8 * weight);
  double apart = 0., motion = 0.;
  const Vec3 edges(10e-3, 9e-3, 1.);
  for (std::size_t i = 0; i < grains.size(); ++i)
  {
    const auto k = one.index_of(grains.id[i]), l = other.index_of(grains.id[i]);
    Vec3 line = other.particles.position[l] - one.particles.position[k] - Vec3(3.7e-3, -1.9e-3, 0.);
    line -= edges.cwiseProduct(line.cwiseQuotient(edges).array().round().matrix());
    apart = std::max(apart, line.norm());
    motion = std::max(motion, (one.particles.position[k] - grains.position[i]).norm());
  }
  CHECK(motion > 0.);
  CHECK(apart < 1e-5 * motion + 1e-15);
}

TEST_CASE("an open cell has the same bits on any number of threads and after a restart")
{
  const TemporaryFolder folder;
  std::vector<std::uint64_t> ends;
  for (const int n : {1, 2, 3})
  {
    const Threads threads(n);
    auto s = std::make_unique<Simulation>(settled_layer());
    for (Vec3 &v : s->particles.velocity)
      v += Vec3(0.4, -0.3, 0.);
    for (int half = 0; half < 2; ++half)
    {
      for (int k = 0; k < 1500; ++k)
        s->step();
      if (n != 2 || half == 1)
        continue;
      ArchiveWriter writer(folder.path() / "cell.h5", "grain snapshot");
      write_simulation(writer, *s);
      writer.commit();
      s = read_simulation(ArchiveReader(folder.path() / "cell.h5", "grain snapshot"), soft());
    }
    ends.push_back(state_hash(*s));
  }
  CHECK(ends[1] == ends[0]);
  CHECK(ends[2] == ends[0]);
}

TEST_CASE("what cannot be in an open cell is refused with its name")
{
  Particles grain;
  grain.add({Vec3::Constant(1e-3), 1., 1.}, density, Vec3::Constant(2e-3), Quaternion::Identity());
  grain.cell = PeriodicCell(Vec3(8e-3, infinite, 9e-3));
  CHECK(grain.cell.directions() == "x and z");
  SimulationParameters weightless = soft();
  weightless.gravity.setZero();
  PlaneWall wall;
  wall.normal = Vec3(0.6, 0.8, 0.);
  CHECK_THROWS_WITH(Simulation(weightless, grain, {wall}), Catch::Contains("wall 0") && Catch::Contains("0.6") &&
                                                               Catch::Contains("along x") &&
                                                               Catch::Contains("exactly zero"));
  CHECK_THROWS_WITH(Simulation(soft(), grain, {}),
                    Catch::Contains("gravity") && Catch::Contains("-9.81") && Catch::Contains("along z"));
  wall.normal = Vec3::UnitY();
  Simulation s(weightless, grain, {wall});
  CHECK_THROWS_WITH(s.change(soft()), Catch::Contains("gravity"));
  wall.normal = -Vec3::UnitZ();
  CHECK_THROWS_WITH(s.add_wall(wall), Catch::Contains("wall 1") && Catch::Contains("along z"));
  CHECK(s.walls.size() == 1);
  const Surface surface({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 2}});
  CHECK_THROWS_WITH(s.add_surface(surface),
                    Catch::Contains("surface") && Catch::Contains("x and z") && Catch::Contains("planes"));
  CHECK_THROWS_WITH(s.cell_stress(), Catch::Contains("three finite edges") && Catch::Contains("x and z"));
  CellLoading loading(LoadingStage{}, mean_grain(s.particles), density);
  CHECK_THROWS_WITH(loading.begin(s), Catch::Contains("loading") && Catch::Contains("three finite edges"));
  CellControl control(CellControlParameters{});
  CHECK_THROWS_WITH(control.act(s.particles.cell, {}, Vec3::Zero(), 1e-6), Catch::Contains("three finite edges"));

  s.particles.cell.rate[0] = 0.1; // between walls
  CHECK_THROWS_WITH(s.step(), Catch::Contains("keeps its edges") && Catch::Contains("0.1"));
  grain.cell.rate = Vec3(0., 0.1, 0.);
  CHECK_THROWS_WITH(Simulation(weightless, grain, {}), Catch::Contains("rate") && Catch::Contains("along y"));
  grain.cell = PeriodicCell(Vec3(4e-3, infinite, infinite));
  CHECK_THROWS_WITH(Simulation(weightless, grain, {}), Catch::Contains("0.004") && Catch::Contains("larger"));
}
