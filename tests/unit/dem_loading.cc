#include "dem/core/error.h"
#include "dem/geometry/rigid_clump.h"
#include "dem/loading/cell_room.h"
#include "dem/loading/loading_stage.h"
#include "dem/motion/cell_control.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace bergamo;
using namespace bergamo::dem;

TEST_CASE("images of a periodic cell are opposite to one another and bring grains near")
{
  const PeriodicCell cell(Vec3(3., 4., 5.));
  CHECK(shift_of(own_image).isZero());
  for (int image = 0; image < n_images; ++image)
  {
    const auto i = static_cast<Image>(image);
    CHECK((shift_of(i) + shift_of(opposite(i))).isZero());
    CHECK((cell.place[image] - shift_of(i).cwiseProduct(cell.edges)).isZero());
  }
  // From near one corner to near the opposite one: the nearest image lies just outside.
  const Vec3 line(2.8, -3.9, 4.7);
  CHECK((line + cell.place[cell.nearest_image(line)] - Vec3(-0.2, 0.1, -0.3)).norm() < 1e-14);
  CHECK(cell.nearest_image(Vec3(1.4, -1.9, 2.4)) == own_image);
}

TEST_CASE("a controlled axis follows its rate at once, and its stress as a damped wall")
{
  CellControlParameters p;
  p.wall_density = 2000.;
  p.wall_thickness = 1e-3;
  p.modulus = 1e6;
  p.damping_ratio = 0.25;
  p.largest_rate = 1e3;
  CellControl control(p);
  PeriodicCell cell(Vec3(0.1, 0.1, 0.1));
  const double dt = 1e-6;
  const std::array controls{AxisControl::of_rate(-0.5), AxisControl::of_stress(-100.), AxisControl::of_stress(-1e6)};
  const Vec3 stress(-50., -60., 0.);
  control.start_from(stress);
  cell.rate[1] = -1e-4;
  control.act(cell, controls, stress, dt);
  CHECK(cell.acceleration[0] * dt == Approx(-0.5 * 0.1));
  // The applied stress goes to -100 Pa at once: a step may change it by E rate dt = 1000 Pa. Then one step of
  // rho t_w L'' = miss - 2 zeta sqrt(E rho t_w / L) L', the damping as the mean of old and new rate.
  CHECK(control.applied[1] == -100.);
  const double inertia = 2., damping = 0.25 * std::sqrt(1e6 / (inertia * 0.1)) * dt;
  CHECK(cell.rate[1] + cell.acceleration[1] * dt ==
        Approx((-1e-4 * (1. - damping) - 40. / inertia * dt) / (1. + damping)).epsilon(1e-12));
  CHECK(control.applied[2] == Approx(-1000.)); // of -1e6 Pa
  // A miss that would tear the cell along, 500 m/s in a step, is held to the largest rate.
  control.applied[2] = -1e9;
  control.act(cell, {controls[0], controls[1], AxisControl::of_stress(-1e9)}, stress, dt);
  CHECK(cell.rate[2] + cell.acceleration[2] * dt == Approx(-1e3 * 0.1));
}

TEST_CASE("the stress on an axis is what is prescribed while its walls move steadily")
{
  // Grains that dilate: a spring whose rest length grows at a steady rate. Walls on their dampers alone would miss the
  // stress by 2 zeta sqrt(E rho t_w / L) L'.
  const double stiffness = GENERATE(1e6, 1e7, 4e8), rate = GENERATE(0.3, -0.3), target = -25e3, dt = 1e-7;
  CellControlParameters p;
  p.wall_thickness = 5e-5;
  CellControl control(p);
  PeriodicCell cell(Vec3::Constant(0.01));
  control.start_from(Vec3::Constant(target));
  const std::array controls{AxisControl::of_rate(0.), AxisControl::of_rate(0.), AxisControl::of_stress(target)};
  double rest = cell.edges[2] * (1. - target / stiffness), mean = target, worst = 0.;
  const double damper = 2. * p.damping_ratio * std::sqrt(p.modulus * p.wall_density * p.wall_thickness / 0.01);
  REQUIRE(damper * std::abs(rate) * 0.01 > 0.001 * std::abs(target));
  for (int k = 0; k < 120000; ++k) // 16 times the decay of the softest
  {
    rest *= 1. + rate * dt;
    mean = stiffness * (cell.edges[2] - rest) / rest;
    control.act(cell, controls, Vec3::Constant(mean), dt);
    cell.rate += cell.acceleration * dt;
    cell.edges += cell.rate * dt;
    worst = std::max(worst, std::abs(mean / target - 1.));
  }
  CAPTURE(stiffness, rate);
  CHECK(worst < 0.1);
  CHECK(mean == Approx(target).epsilon(1e-5));
  CHECK(cell.rate[2] == Approx(rate * cell.edges[2]).epsilon(1e-3));
}

TEST_CASE("legs of a cyclic stage lead to both sides and back to zero")
{
  LoadingStage stage;
  stage.path = LoadingPath::triaxial;
  stage.axial_strain = -0.01;
  CHECK(n_legs(stage) == 1);
  CHECK(end_of_leg(stage, 0) == -0.01);
  CHECK(strain_path(stage) == Approx(0.01));
  stage.n_cycles = 2;
  REQUIRE(n_legs(stage) == 5);
  const double ends[] = {-0.01, 0.01, -0.01, 0.01, 0.};
  for (int leg = 0; leg < 5; ++leg)
    CHECK(end_of_leg(stage, leg) == ends[leg]);
  CHECK(strain_path(stage) == Approx(0.08)); // 1 + 2 + 2 + 2 + 1 hundredths
}

TEST_CASE("every loading path holds what it is named for")
{
  LoadingStage stage;
  stage.pressure = 1e4;
  stage.stresses = Vec3(1e4, 2e4, 3e4);
  const Vec3 stress(-9e3, -1e4, -2.5e4);
  const auto controls = [&](const LoadingPath path)
  {
    stage.path = path;
    return controls_of(stage, stress, -0.3);
  };
  using Kind = AxisControl::Kind;
  for (const AxisControl &axis : controls(LoadingPath::isotropic))
    CHECK((axis.kind == Kind::stress && axis.value == -1e4));
  for (int d = 0; d < 3; ++d)
    CHECK(controls(LoadingPath::true_triaxial)[d].value == -stage.stresses[d]);
  for (const LoadingPath path : {LoadingPath::triaxial, LoadingPath::constant_volume, LoadingPath::constant_pressure})
    CHECK((controls(path)[2].kind == Kind::rate && controls(path)[2].value == -0.3));
  CHECK((controls(LoadingPath::triaxial)[1].kind == Kind::stress && controls(LoadingPath::triaxial)[1].value == -1e4));
  double sum = 0.;
  for (const AxisControl &axis : controls(LoadingPath::constant_volume))
    sum += axis.value;
  CHECK(sum == 0.); // of logarithmic rates
  const auto held = controls(LoadingPath::constant_pressure);
  CHECK((held[0].value + held[1].value + stress[2]) / 3. == Approx(-1e4));
}

TEST_CASE("stages out of range are refused")
{
  LoadingStage stage;
  CHECK_NOTHROW(stage.validate());
  const auto refused = [&](auto &&change)
  {
    LoadingStage wrong;
    wrong.path = LoadingPath::triaxial;
    change(wrong);
    CHECK_THROWS_AS(wrong.validate(), ConfigError);
  };
  refused([](LoadingStage &s) { s.axial_strain = 0.; });
  refused([](LoadingStage &s) { s.axial_strain = -0.8; });
  refused([](LoadingStage &s) { s.pressure = -1.; });
  refused([](LoadingStage &s) { s.inertial_number = 0.2; });
  refused([](LoadingStage &s) { s.n_cycles = -1; });
  refused([](LoadingStage &s) { s.overlap_tolerance = 0.5; });
  refused(
      [](LoadingStage &s)
      {
        s.path = LoadingPath::true_triaxial;
        s.stresses = Vec3(1e3, 0., 1e3);
      });
}

TEST_CASE("a cell has room for its grains before and after its compression")
{
  // Spheres of radius 1 with a Verlet distance of 0.1: 2 (2 + 0.1) when dense.
  Particles spheres;
  for (int i = 0; i < 3; ++i)
    spheres.add(Superquadric{Vec3::Ones(), 1., 1.}, 1., Vec3::Zero(), Quaternion::Identity());
  CHECK(least_uncompressed_edge(spheres, 0.74, 0.1) == Approx(4.2));
  CHECK(least_uncompressed_edge(spheres, 0.9, 0.1) == Approx(4.2));
  CHECK(least_uncompressed_edge(spheres, 0.37, 0.1) == Approx(4.2 * std::cbrt(2.)));
  // Two spheres of radius 0.1 at 1 from their middle: their contacts range over 2 (0.21 + 1) alone.
  ClumpShape shape;
  shape.parts = {{{Vec3::Constant(0.1), 1., 1.}, Vec3(-1., 0., 0.)}, {{Vec3::Constant(0.1), 1., 1.}, Vec3(1., 0., 0.)}};
  Particles dumbbell;
  dumbbell.add(Clump(shape, 1e-3), 1., Vec3::Zero(), Quaternion::Identity());
  CHECK(least_uncompressed_edge(dumbbell, 0.74, 0.1) == Approx(4.4));
}
