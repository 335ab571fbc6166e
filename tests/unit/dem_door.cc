#include "dem/core/error.h"
#include "dem/simulation/simulation.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();

/// What a simulation is made of, good as it is.
struct Input
{
  SimulationParameters parameters;
  Particles grains;
  std::vector<PlaneWall> walls{PlaneWall()};

  Input()
  {
    for (int i = 0; i < 2; ++i)
      grains.add({Vec3(1e-3, 1.1e-3, 0.9e-3), 0.9, 1.1}, 2650., Vec3(3e-3 * i, 0., 2e-3), Quaternion::Identity());
  }
};

/// The message with which a simulation is refused; empty if it runs.
std::string refusal(const std::function<void(Input &)> &spoil)
{
  Input input;
  try
  {
    spoil(input);
    Simulation(input.parameters, input.grains, input.walls);
  }
  catch (const ConfigError &error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("what cannot run is refused before it does, with its name, its value and the remedy")
{
  const Threads one_thread(1);
  using Catch::Contains;
  const auto refused = [](const std::function<void(Input &)> &spoil, const std::string &name, const std::string &value)
  {
    const std::string message = refusal(spoil);
    CAPTURE(name, value, message);
    CHECK_THAT(message, Contains(name) && Contains(value) && Contains(":"));
  };
  CHECK(refusal([](Input &) {}) == "");

  refused([](Input &in) { in.walls[0].normal *= 2.; }, "length of a wall's normal", "2");
  refused([](Input &in) { in.walls[0].normal *= 0.5; }, "length of a wall's normal", "0.5");
  refused([](Input &in) { in.walls[0].normal[1] = no_number; }, "length of a wall's normal", "nan");
  refused([](Input &in) { in.walls[0].velocity[0] = no_number; }, "velocity of a wall", "nan");
  refused([](Input &in) { in.walls[0].point[0] = infinity; }, "point of a wall", "inf");
  refused([](Input &in) { in.walls[0].material = 7; }, "material of a wall", "7");

  for (const double density : {-1., 0., no_number, infinity})
    CHECK(refusal([&](Input &in) { in.parameters.grain().density = density; }) != "");
  refused([](Input &in) { in.parameters.grain().young_modulus = -1.; }, "Young's modulus", "-1");
  refused([](Input &in) { in.parameters.with_walls().friction = no_number; }, "friction coefficient", "nan");
  refused([](Input &in) { in.parameters.between_grains().damping_ratio = -0.1; }, "damping ratio", "-0.1");
  refused([](Input &in) { in.parameters.time_step = 0.; }, "time step", "0");
  refused([](Input &in) { in.parameters.gravity[2] = no_number; }, "gravity", "nan");

  refused([](Input &in) { in.grains.parts.shape[1].half_axes[0] = -1e-3; }, "half-axis", "-0.001");
  refused([](Input &in) { in.grains.parts.shape[1].eps1 = 2.5; }, "exponent", "2.5");
  refused([](Input &in) { in.grains.parts.material[1] = 4; }, "grain 1", "4");
  for (const double mass : {0., -1., no_number})
    CHECK_THAT(refusal([&](Input &in) { in.grains.mass[1] = mass; }), Contains("grain 1 has the mass"));
  refused([](Input &in) { in.grains.bounding_radius[0] = 0.; }, "grain 0", "bounding radius 0");
  refused([](Input &in) { in.grains.weight[0] = 0.; }, "grain 0", "weight 0");
  refused([](Input &in) { in.grains.weight[0] = 1.5; }, "grain 0", "weight 1.5");
  refused([](Input &in) { in.grains.orientation[1].coeffs().setZero(); }, "grain 1", "norm 0");
  refused([](Input &in) { in.grains.position[1][2] = infinity; }, "grain 1", "place");
  refused([](Input &in) { in.grains.velocity[1][2] = no_number; }, "grain 1", "velocity");
  refused([](Input &in) { in.grains.velocity.pop_back(); }, "velocity", "1 entries for 2");
  refused([](Input &in) { in.grains.external_force.assign(3, Vec3::Zero()); }, "external_force", "3 entries for 2");
  refused([](Input &in) { in.grains.id[1] = 0; }, "two particles have the id", "0");
  refused([](Input &in) { in.grains = Particles(); }, "number of grains", "0");

  refused(
      [](Input &in)
      {
        in.walls.clear();
        in.grains.cell = PeriodicCell(Vec3(1., infinity, 1.));
        in.grains.cell.rate[1] = 0.5;
      },
      "rate of a periodic cell along y", "0.5");
  refused(
      [](Input &in)
      {
        in.walls.clear();
        in.grains.cell = PeriodicCell(Vec3(1., -1., 1.));
      },
      "edge of a periodic cell", "-1");

  // Adding a grain is a door too.
  Particles grains;
  const auto add = [&](const Superquadric &shape, const double density, const Quaternion &turn)
  { grains.add(shape, density, Vec3::Zero(), turn); };
  CHECK_THROWS_AS(add({Vec3::Ones(), 1., 1.}, 0., Quaternion::Identity()), ConfigError);
  CHECK_THROWS_AS(add({Vec3::Ones(), 1., 1.}, no_number, Quaternion::Identity()), ConfigError);
  CHECK_THROWS_AS(add({Vec3(1., 0., 1.), 1., 1.}, 1., Quaternion::Identity()), ConfigError);
  CHECK_THROWS_AS(add({Vec3::Ones(), 1., 2.5}, 1., Quaternion::Identity()), ConfigError);
  CHECK_THROWS_AS(add({Vec3::Ones(), 1., 1.}, 1., Quaternion(0., 0., 0., 0.)), ConfigError);
  CHECK(grains.size() == 0);
}

TEST_CASE("change() obeys what it is given, or refuses it")
{
  const Threads one_thread(1);
  Input input;
  Simulation s(input.parameters, input.grains, input.walls);
  SimulationParameters p = input.parameters;
  p.gravity = Vec3(0., 0., -9.81);
  p.sort_interval = 7;
  p.verlet_distance = 0.3;
  p.time_step = 1e-6;
  const auto n_rebuilds = s.n_rebuilds();
  s.change(p);
  CHECK(s.parameters().sort_interval == 7);
  CHECK(s.n_rebuilds() == n_rebuilds + 1); // the lists of the old range would not do
  for (int n = 0; n < 100; ++n)
    s.step();
  s.compute_forces();
  CHECK(s.particles.velocity[0][2] < -9.81 * 90e-6);
  CHECK(s.energy().gravity_work > 0.);
  CHECK(std::abs(s.energy().balance()) < 1e-3 * s.energy().kinetic); // the potential was that of the new gravity

  p.grain().young_modulus *= 2.;
  CHECK_THROWS_WITH(s.change(p), Catch::Contains("Young's modulus") && Catch::Contains("begin a new simulation"));
  p = input.parameters;
  p.materials.add(Material());
  CHECK_THROWS_WITH(s.change(p), Catch::Contains("number of materials"));
}

TEST_CASE("what becomes wrong during a run stops it at once")
{
  const Threads one_thread(1);
  Input input;
  Simulation s(input.parameters, input.grains, input.walls);
  s.particles.external_force.assign(1, Vec3::Zero());
  CHECK_THROWS_WITH(s.step(), Catch::Contains("1 external forces for 2 grains"));
  s.particles.external_force.clear();
  s.walls[0].velocity[1] = no_number;
  CHECK_THROWS_WITH(s.step(), Catch::Contains("wall 0") && Catch::Contains("nan"));
}
