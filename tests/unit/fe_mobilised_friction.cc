#include "dem/core/error.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/material/mohr_coulomb.h"
#include "fe_dealii/material/plastic_flow.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::fe;

namespace
{

constexpr double degree = std::numbers::pi / 180;

const MohrCoulombParameters sand{.young_modulus = 2e8,
                                 .poisson_ratio = 0.1,
                                 .friction_angle = 32,
                                 .dilation_angle = 6,
                                 .cohesion = 0,
                                 .hardening_strain = 2e-3,
                                 .initial_friction_angle = 4};

struct Point
{
  Stress stress{-1e5, -1e5, -1e5, 0, 0, 0};
  double plastic_strain = 0, plastic_volume = 0;

  void strain_by(const MohrCoulomb &law, const Strain &increment)
  {
    const StressUpdate update = law.update(stress, increment, plastic_strain);
    stress = update.stress;
    plastic_strain += equivalent_strain(update.plastic_strain);
    plastic_volume += update.plastic_strain[0] + update.plastic_strain[1] + update.plastic_strain[2];
  }
};

/// Triaxial compression at a constant lateral pressure, by Newton's method with the tangent.
Point compress(const MohrCoulomb &law, const double axial, const int steps)
{
  Point point;
  for (int step = 0; step < steps; ++step)
  {
    Strain increment{0, 0, -axial / steps, 0, 0, 0};
    for (int iteration = 0; iteration < 30; ++iteration)
    {
      const Stress stress = law.update(point.stress, increment, point.plastic_strain).stress;
      const Moduli moduli = law.tangent(point.stress, increment, point.plastic_strain);
      const double lateral = -(stress[0] + 1e5) / (moduli[0][0] + moduli[0][1]);
      increment[0] += lateral;
      increment[1] += lateral;
    }
    point.strain_by(law, increment);
  }
  return point;
}

} // namespace

TEST_CASE("Mobilised friction: a hyperbola of the plastic strain, and Rowe's dilation", "[fe]")
{
  const MohrCoulomb law(sand);
  const double first = std::sin(4 * degree), full = std::sin(32 * degree);
  CHECK(law.sine_of_friction(0.) == Approx(first));
  CHECK(law.sine_of_friction(2e-3) == Approx(0.5 * (first + full)));
  CHECK(law.sine_of_friction(6e-3) == Approx(first + 0.75 * (full - first)));
  CHECK(law.sine_of_friction(1e6) == Approx(full));
  CHECK(law.sine_of_dilation(full) == Approx(std::sin(6 * degree)));
  // Rowe: (1 + sin φ_m)/(1 − sin φ_m) = (1 + sin φ_cv)/(1 − sin φ_cv) (1 + sin ψ_m)/(1 − sin ψ_m).
  const auto ratio = [](const double sine) { return (1 + sine) / (1 - sine); };
  for (const double strain : {0., 1e-4, 1e-3, 0.1})
  {
    const double friction = law.sine_of_friction(strain);
    CHECK(ratio(friction) == Approx(ratio(sand.sine_of_steady_friction()) * ratio(law.sine_of_dilation(friction))));
  }
  CHECK(law.sine_of_dilation(sand.sine_of_steady_friction()) == Approx(0).margin(1e-15));

  // Without hardening the plastic strain says nothing.
  MohrCoulombParameters constant = sand;
  constant.hardening_strain = 0;
  const MohrCoulomb at_once(constant);
  CHECK(at_once.sine_of_friction(0.) == Approx(full));
  CHECK(at_once.sine_of_dilation(at_once.sine_of_friction(1.)) == Approx(std::sin(6 * degree)));
}

TEST_CASE("Mobilised friction: triaxial compression follows the integrals of the law, to first order", "[fe]")
{
  // On the edge one unit of flow is −(1 − s) along the axis and (1 + s)/2 across, so κ grows by 1 − s/3 and the volume
  // by 2s; without cohesion the ratio of the stresses is (1 + f)/(1 − f).
  const MohrCoulomb law(sand);
  double error[2];
  for (int k = 0; k < 2; ++k)
  {
    const Point end = compress(law, 0.02, 2000 << k);
    const double friction = law.sine_of_friction(end.plastic_strain);
    CHECK(end.stress[2] / end.stress[0] == Approx((1 + friction) / (1 - friction)).epsilon(1e-3));
    double volume = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i)
    {
      const double s = law.sine_of_dilation(law.sine_of_friction(end.plastic_strain * (i + 0.5) / n));
      volume += 2 * s / (1 - s / 3) * end.plastic_strain / n;
    }
    error[k] = std::abs(end.plastic_volume - volume);
    CHECK(error[k] < 1e-3 * end.plastic_strain); // it contracts, then dilates: both integrals nearly cancel
    // All but the elastic strain has flowed: axial −(1 − s) of each unit.
    CHECK(end.plastic_strain > 0.015);
  }
  CHECK(error[0] / error[1] == Approx(2).epsilon(0.05));
}

TEST_CASE("Mobilised friction: at constant volume the pressure is least where the friction is that of steady flow",
          "[fe]")
{
  MohrCoulombParameters soft = sand; // what the first contraction takes leaves some pressure
  soft.young_modulus = 5e7;
  const MohrCoulomb law(soft);
  Point point;
  double least = 1e5, friction_there = 0;
  const double step = 1e-6;
  for (int k = 0; k < 40000; ++k)
  {
    point.strain_by(law, {0.5 * step, 0.5 * step, -step, 0, 0, 0});
    const double pressure = -mean_stress(point.stress);
    if (pressure < least)
    {
      least = pressure;
      friction_there = law.sine_of_friction(point.plastic_strain);
    }
  }
  CHECK(least < 0.7e5); // it contracts at first
  CHECK(friction_there == Approx(sand.sine_of_steady_friction()).epsilon(1e-3));
  CHECK(-mean_stress(point.stress) > 1.2 * least); // and then dilates
}

TEST_CASE("Mobilised friction: a pack of points of different plastic strains returns as each alone", "[fe]")
{
  std::mt19937_64 random(12);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  MohrCoulombParameters parameters = sand;
  parameters.cohesion = 300;
  const MohrCoulomb law(parameters);
  int flowing = 0;
  for (int round = 0; round < 2000; ++round)
  {
    Pack old[6], trial[6], strain;
    std::vector<Stress> stress(pack_width);
    for (int lane = 0; lane < pack_width; ++lane)
    {
      strain[lane] = std::pow(10., -5 + 4 * unit(random));
      for (int i = 0; i < 6; ++i)
      {
        stress[lane][i] = 1e4 * (normal(random) * (round % 3 ? 0.4 : 1.5) - (i < 3));
        old[i][lane] = trial[i][lane] = stress[lane][i];
      }
    }
    const PlasticFlow<Pack> flow = plastic_flow(law, old, trial, Pack(1.), strain);
    for (int lane = 0; lane < pack_width; ++lane)
    {
      const double size = std::sqrt(2 * second_invariant(stress[lane])) + std::abs(mean_stress(stress[lane]));
      const StressUpdate alone =
          law.return_to_surface(stress[lane], stress[lane], principal_frame(stress[lane]), 1, strain[lane]);
      REQUIRE(Sector(int(flow.sector[lane])) == alone.sector);
      flowing += alone.sector != Sector::elastic;
      for (int i = 0; i < 6; ++i)
        REQUIRE(flow.stress[i][lane] == Approx(alone.stress[i]).margin(1e-13 * size));
      CHECK(law.yield_function(alone.stress, strain[lane]) <= 1e-12 * size);
      if (law.is_surely_elastic(mean_stress(stress[lane]), second_invariant(stress[lane]), double(strain[lane])))
        REQUIRE(alone.sector == Sector::elastic);
    }
  }
  CHECK(flowing > 1000);
}

TEST_CASE("Mobilised friction: the tangent is the derivative of the stress", "[fe]")
{
  const MohrCoulomb law(sand);
  const double strain = 1e-3;
  const Stress old{-1e5, -1.1e5, -1.6e5, 1e4, -5e3, 2e3};
  const Strain increment{2e-4, 1e-4, -6e-4, 1e-4, -2e-4, 3e-4};
  REQUIRE(law.update(old, increment, strain).sector != Sector::elastic);
  const Moduli moduli = law.tangent(old, increment, strain);
  for (int j = 0; j < 6; ++j)
  {
    Strain above = increment, below = increment;
    above[j] += 1e-9;
    below[j] -= 1e-9;
    const Stress up = law.update(old, above, strain).stress, down = law.update(old, below, strain).stress;
    for (int i = 0; i < 6; ++i)
      CHECK((up[i] - down[i]) / 2e-9 == Approx(moduli[i][j]).margin(1e-5 * sand.young_modulus));
  }
}

TEST_CASE("Mobilised friction: a stress at rest has mobilised what it needs", "[fe]")
{
  const MohrCoulomb law(sand);
  CHECK(law.mobilising_strain({-1e5, -1e5, -1e5, 0, 0, 0}) == 0);
  const Stress at_rest{-5e4, -5e4, -1e5, 0, 0, 0};
  const double strain = law.mobilising_strain(at_rest);
  CHECK(law.sine_of_friction(strain) == Approx(1. / 3)); // (σ1 − σ3)/(σ1 + σ3)
  CHECK(law.yield_function(at_rest, strain) <= 0);
  CHECK(law.yield_function(at_rest, 0.999 * strain) > 0);
  // At the full strength, which no strain mobilises wholly.
  const double ratio = (1 - std::sin(32 * degree)) / (1 + std::sin(32 * degree));
  const double most = law.mobilising_strain({-1e5 * ratio, -1e5 * ratio, -1e5, 0, 0, 0});
  CHECK(law.sine_of_friction(most) == Approx(std::sin(32 * degree)).epsilon(3e-6));
}

TEST_CASE("Mobilised friction: every kind of element hardens from its stress at rest as a point does", "[fe]")
{
  const Stress at_rest{-5e4, -5e4, -1e5, 0, 0, 0};
  ExplicitBodyParameters parameters;
  parameters.material = MohrCoulomb(sand);
  parameters.initial_stress = [&](const std::array<double, 3> &) { return at_rest; };
  SECTION("mean dilatation") {}
  SECTION("bending")
  {
    parameters.kind.hourglass = Hourglass::bending;
  }
  SECTION("quadratic")
  {
    parameters.degree = 2;
  }
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, mesh);
  ExplicitBody body(mesh, parameters);

  const MohrCoulomb law(sand);
  Point point{at_rest, law.mobilising_strain(at_rest)};
  const double at_start = point.plastic_strain;
  for (int step = 0; step < 400; ++step)
  {
    const double rate[3] = {4e-6, 5e-6, -1e-5};
    point.strain_by(law, {rate[0], rate[1], rate[2], 2e-6, 0, 0});
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      for (int i = 0; i < 3; ++i)
        body.displacement()[3 * node + i] += rate[i] * body.node_position()[node][i];
      body.displacement()[3 * node] += 2e-6 * body.node_position()[node][1];
    }
    body.compute_internal_force();
  }
  REQUIRE(point.plastic_strain > at_start + 2e-3);
  const ElementState state = body.elements().state_of(0, body.displacement().data());
  CHECK(state.plastic_strain == Approx(point.plastic_strain).epsilon(1e-9));
  for (int i = 0; i < 6; ++i)
    CHECK(state.stress[i] == Approx(point.stress[i]).margin(1e-4)); // of 1e5 Pa
  // On the surface that is mobilised, well within the full one.
  CHECK(std::abs(state.yield_function) < 1e-3 * 1e5);
  CHECK(law.yield_function(state.stress) < -1e4);
}

TEST_CASE("Mobilised friction: bad parameters are named", "[fe]")
{
  using Catch::Matchers::Contains;
  const auto rejected = [](auto change, const char *name)
  {
    MohrCoulombParameters p = sand;
    change(p);
    CHECK_THROWS_WITH(MohrCoulomb(p), Contains(name));
  };
  rejected([](auto &p) { p.hardening_strain = -1e-3; }, "hardening_strain = -0.001");
  rejected([](auto &p) { p.hardening_strain = NAN; }, "hardening_strain");
  rejected([](auto &p) { p.initial_friction_angle = 0; }, "initial_friction_angle [degrees] = 0");
  rejected([](auto &p) { p.initial_friction_angle = 33; }, "initial_friction_angle [degrees] = 33");
  // Nearly incompressible and steady at 60 degrees: halfway, contraction outruns the return.
  rejected([](auto &p) { p.poisson_ratio = 0.49, p.friction_angle = 60, p.dilation_angle = 0; },
           "on the way to the full friction");
  MohrCoulombParameters unused = sand;
  unused.hardening_strain = 0;
  unused.initial_friction_angle = 80;
  CHECK_NOTHROW(MohrCoulomb(unused));
}
