// Laws of small strain carried through large strain and rotation: LargeStrainHexahedra.

#include "dem/core/error.h"
#include "fe_dealii/equilibrium/static_equilibrium.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include "tests/deform.h"
#include "tests/same_bits.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace bergamo::fe;

namespace
{

constexpr ElasticParameters soil{.young_modulus = 20e6, .poisson_ratio = 0.3, .density = 1600};

const MohrCoulombParameters frictional{
    .young_modulus = 20e6, .poisson_ratio = 0.3, .friction_angle = 30, .dilation_angle = 8, .cohesion = 5e3};

ExplicitBody box(const Material &material, const Kinematics kinematics, const double distortion = 0.2,
                 const unsigned int n = 3)
{
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 1.3, 0.8}, {n, n, n}}, mesh);
  if (distortion > 0)
    dealii::GridTools::distort_random(distortion, mesh, /*keep_boundary=*/true, /*seed=*/7);
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.kind.kinematics = kinematics;
  return ExplicitBody(mesh, parameters);
}

Tensor3<double> turn_about_z(const double angle)
{
  return {{{std::cos(angle), -std::sin(angle), 0}, {std::sin(angle), std::cos(angle), 0}, {0, 0, 1}}};
}

Tensor3<double> times(const Tensor3<double> &a, const Tensor3<double> &b)
{
  Tensor3<double> result{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        result[i][j] += a[i][k] * b[k][j];
  return result;
}

/// 1 + share (F - 1).
Tensor3<double> part_of(const Tensor3<double> &f, const double share)
{
  Tensor3<double> result{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i][j] = (i == j) + share * (f[i][j] - (i == j));
  return result;
}

/// Leads a body through x = F(s) X, s from 0 to 1 in steps.
template <class Path>
void lead(ExplicitBody &body, const Path &path, const int steps)
{
  for (int step = 1; step <= steps; ++step)
  {
    deform(body, path(double(step) / steps));
    body.compute_internal_force();
  }
}

double largest_inner_force(const ExplicitBody &body)
{
  std::vector<bool> is_outside(body.n_nodes(), false);
  for (unsigned int id = 0; id < 6; ++id)
    for (const unsigned int node : body.boundary_nodes(id))
      is_outside[node] = true;
  double largest = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    for (int i = 0; i < 3; ++i)
      if (!is_outside[node])
        largest = std::max(largest, std::abs(body.internal_force()[3 * node + i]));
  return largest;
}

const LinearElastic elastic(soil);

} // namespace

TEST_CASE("soil at large strain, patch test: a uniform deformation strains uniformly, of second order in the steps",
          "[fe]")
{
  // At a stretch along an axis the rate form is exact: J sigma_xx = (K + 4G/3) ln(stretch).
  const double end = std::log(0.7), constrained = elastic.bulk_modulus() + 4 * elastic.shear_modulus() / 3;
  std::vector<double> error;
  for (const int steps : {10, 20, 40})
  {
    ExplicitBody body = box(elastic, Kinematics::large_strain);
    lead(
        body,
        [&](const double s) {
          return Tensor3<double>{{{std::exp(s * end), 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        },
        steps);
    const Stress stress = body.average_stress();
    error.push_back(std::abs(stress[0] * 0.7 / (constrained * end) - 1));
    CHECK(largest_inner_force(body) < 1e-13 * constrained);
    // Force over the present area, which is that at the start.
    double force = 0;
    for (const unsigned int node : body.boundary_nodes(1))
      force += body.internal_force()[3 * node];
    CHECK(force / (1.3 * 0.8) == Approx(stress[0]).epsilon(1e-12));
  }
  CAPTURE(error[0], error[1], error[2]);
  CHECK(error[2] < 1e-4);
  CHECK(std::log2(error[0] / error[1]) == Approx(2).margin(0.1));
  CHECK(std::log2(error[1] / error[2]) == Approx(2).margin(0.1));
}

TEST_CASE("soil at large strain: shear of Jaumann's rate has the sine of its closed form", "[fe]")
{
  // sigma_xy = G sin(shear), sigma_xx - sigma_yy = 2 G (1 - cos(shear)) (Dienes, Acta Mech. 32 (1979) 217-232).
  const double shear = 1.2, g = elastic.shear_modulus();
  std::vector<double> error;
  for (const int steps : {20, 40})
  {
    ExplicitBody body = box(elastic, Kinematics::large_strain);
    lead(
        body,
        [&](const double s) {
          return Tensor3<double>{{{1, s * shear, 0}, {0, 1, 0}, {0, 0, 1}}};
        },
        steps);
    const Stress stress = body.average_stress();
    error.push_back(std::abs(stress[3] / g - std::sin(shear)) +
                    std::abs(stress[0] - stress[1] - 2 * g * (1 - std::cos(shear))) / g);
    CHECK(std::abs(stress[0] + stress[1] + stress[2]) < 1e-12 * g);
  }
  CAPTURE(error[0], error[1]);
  CHECK(error[1] < 1e-3);
  CHECK(std::log2(error[0] / error[1]) == Approx(2).margin(0.15));
}

TEST_CASE("soil at large strain: a rotation turns the stress and asks for no force, in steps of any size", "[fe]")
{
  for (const Material &material : {Material(elastic), Material(MohrCoulomb(frictional))})
  {
    ExplicitBody body = box(material, Kinematics::large_strain);
    const Tensor3<double> squeezed{{{0.96, 0.02, 0}, {0, 0.98, 0}, {0, 0, 0.99}}};
    lead(
        body, [&](const double s) { return part_of(squeezed, s); }, 8);
    const Stress before = body.average_stress();
    const double energy = body.energy().elastic, flow = body.energy().plastic_dissipation;
    std::vector<double> force(body.internal_force().begin(), body.internal_force().end());
    const double quarter = 0.5 * std::numbers::pi;
    for (const double angle : {0.3 * quarter, quarter})
    {
      deform(body, times(turn_about_z(angle), squeezed));
      body.compute_internal_force();
    }
    const Stress after = body.average_stress();
    const double scale = std::abs(before[0]);
    CHECK(after[0] == Approx(before[1]).margin(1e-11 * scale)); // x lies where y was
    CHECK(after[1] == Approx(before[0]).margin(1e-11 * scale));
    CHECK(after[2] == Approx(before[2]).margin(1e-11 * scale));
    CHECK(after[3] == Approx(-before[3]).margin(1e-11 * scale));
    CHECK(body.energy().elastic == Approx(energy).epsilon(1e-11));
    CHECK(body.energy().plastic_dissipation == Approx(flow).epsilon(1e-11).margin(1e-11 * energy));
    double worst = 0, greatest = 0;
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const double *const old = &force[3 * node], *const now = &body.internal_force()[3 * node];
      greatest = std::max({greatest, std::abs(old[0]), std::abs(old[1])});
      worst = std::max({worst, std::abs(now[0] + old[1]), std::abs(now[1] - old[0]), std::abs(now[2] - old[2])});
    }
    CHECK(worst < 1e-11 * greatest);
  }
}

TEST_CASE("soil at large strain: the pressure of an element goes with the logarithm of its volume, however it warps",
          "[fe]")
{
  ExplicitBody body = box(elastic, Kinematics::large_strain, 0.2, 2);
  std::vector<double> way(3 * body.n_nodes());
  for (std::size_t dof = 0; dof < way.size(); ++dof)
    way[dof] = 0.12 * std::sin(1.7 * double(dof) + 0.3);
  constexpr int steps = 200;
  for (int step = 1; step <= steps; ++step)
  {
    for (std::size_t dof = 0; dof < way.size(); ++dof)
      body.displacement()[dof] = way[dof] * step / steps;
    body.compute_internal_force();
  }
  double largest = 0;
  for (std::size_t element = 0; element < body.n_elements(); ++element)
  {
    const ElementState state = body.state_of(element);
    const double ratio = state.volume / body.elements().volume(element);
    const double mean = (state.stress[0] + state.stress[1] + state.stress[2]) / 3 * ratio / elastic.bulk_modulus();
    CHECK(mean == Approx(std::log(ratio)).margin(1e-5));
    largest = std::max(largest, std::abs(std::log(ratio)));
  }
  CHECK(largest > 0.02);
}

TEST_CASE("soil at small strain is the same in elements of small and of large strain", "[fe]")
{
  const Tensor3<double> stretched{{{0, 0.4, 0.2}, {0.1, 1.5, -0.3}, {0.2, 0.1, 1.3}}}; // at a size of 1
  std::vector<double> difference;
  for (const double size : {1e-4, 1e-5})
  {
    std::vector<Stress> stress;
    for (const Kinematics kinematics : {Kinematics::small_strain, Kinematics::large_strain})
    {
      ExplicitBody body = box(elastic, kinematics);
      lead(
          body, [&](const double s) { return part_of(stretched, s * size); }, 4);
      stress.push_back(body.average_stress());
    }
    double sum = 0;
    for (int c = 0; c < 6; ++c)
      sum += std::abs(stress[0][c] - stress[1][c]) / std::abs(stress[0][0]);
    difference.push_back(sum);
  }
  CHECK(difference[0] < 1e-3);
  CHECK(difference[0] / difference[1] == Approx(10).margin(1)); // of first order in the strain
}

namespace
{

/// A block that spins, is squeezed and flows, with the share of a two-scale body.
struct Spinning
{
  static ExplicitBody make()
  {
    ExplicitBody body = box(MohrCoulomb(frictional), Kinematics::large_strain, 0.15, 4);
    std::vector<double> weight(body.n_nodes());
    for (std::size_t node = 0; node < weight.size(); ++node)
    {
      const auto &x = body.node_position()[node];
      weight[node] = 0.8 * x[2];
      const double spin = 20, squeeze = 4; // 1/s
      body.velocity()[3 * node] = -spin * (x[1] - 0.65) - squeeze * (x[0] - 0.5);
      body.velocity()[3 * node + 1] = spin * (x[0] - 0.5) + squeeze * (x[1] - 0.65);
    }
    body.set_share(weight);
    return body;
  }
  static void step(ExplicitBody &body, const double dt)
  {
    body.compute_internal_force();
    body.kick(dt);
    body.drift(dt);
  }
};

} // namespace

TEST_CASE("soil at large strain: momentum is kept, and the account closes with the square of the step", "[fe]")
{
  std::vector<double> residual;
  const double dt = 0.5 * stable_step(Spinning::make()).time_step;
  for (const int part : {1, 2})
  {
    ExplicitBody body = Spinning::make();
    double worst = 0;
    for (int step = 0; step < 200 * part; ++step)
    {
      Spinning::step(body, dt / part);
      worst = std::max(worst, std::abs(body.energy().residual()));
    }
    const BodyEnergy energy = body.energy();
    std::array<double, 3> force{};
    double greatest = 0;
    for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
    {
      force[dof % 3] += body.internal_force()[dof];
      greatest = std::max(greatest, std::abs(body.internal_force()[dof]));
    }
    for (const double sum : force)
      CHECK(std::abs(sum) < 1e-11 * greatest);
    CHECK(energy.plastic_dissipation > 0.01 * energy.initial);
    residual.push_back(worst / energy.initial);
  }
  CAPTURE(residual[0], residual[1]);
  CHECK(residual[0] < 1e-4);
  CHECK(residual[0] / residual[1] > 3);
}

TEST_CASE("soil at large strain has the same bits on any number of threads and after a restart", "[fe]")
{
  const double dt = 0.5 * stable_step(Spinning::make()).time_step;
  std::vector<ExplicitBody> bodies;
  for (int n = 1; n <= 3; ++n)
  {
    const Threads team(n);
    bodies.push_back(Spinning::make());
    for (int step = 0; step < 60; ++step)
      Spinning::step(bodies.back(), dt);
  }
  CHECK(same_bits(bodies[0], bodies[1]));
  CHECK(same_bits(bodies[0], bodies[2]));
  ExplicitBody restored = Spinning::make();
  const auto from = bodies[0].state(), to = restored.state();
  for (std::size_t k = 0; k < from.size(); ++k)
    std::copy(from[k].second.begin(), from[k].second.end(), to[k].second.begin());
  for (int step = 0; step < 60; ++step)
  {
    Spinning::step(bodies[0], dt);
    Spinning::step(restored, dt);
  }
  CHECK(same_bits(bodies[0], restored));
}

TEST_CASE("soil at large strain: an element that turns inside out is named, and its stable step goes with its shape",
          "[fe]")
{
  ExplicitBody body = box(elastic, Kinematics::large_strain, 0, 1);
  const double whole = stable_step(body).time_step;
  deform(body, {{{0.5, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  CHECK(stable_step(body).time_step < 0.8 * whole);
  body.compute_internal_force();
  deform(body, {{{-0.1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  CHECK_THROWS_WITH(body.compute_internal_force(), Catch::Matchers::Contains("turned inside out"));
}

TEST_CASE("soil at large strain: elements that do not know it are refused", "[fe]")
{
  dealii::Triangulation<3> mesh;
  make_box({}, mesh);
  ExplicitBodyParameters parameters;
  parameters.kind.kinematics = Kinematics::large_strain;
  SECTION("27 nodes")
  {
    parameters.degree = 2;
  }
  SECTION("bending")
  {
    parameters.kind.hourglass = Hourglass::bending;
  }
  CHECK_THROWS_WITH(ExplicitBody(mesh, parameters), Catch::Matchers::Contains("8 nodes alone"));
}

TEST_CASE("soil at large strain: Newton's method finds a bar pressed to three quarters of its length", "[fe]")
{
  // Free at its sides: J sigma along it is E ln(stretch) in the rate form.
  std::vector<double> error;
  for (const int steps : {4, 8})
  {
    ExplicitBody pressed = box(elastic, Kinematics::large_strain, 0, 2);
    pressed.prescribe_velocity(0u, 0);
    pressed.prescribe_velocity(2u, 1);
    pressed.prescribe_velocity(4u, 2);
    pressed.set_velocity(pressed.prescribe_velocity(1u, 0), -0.25 / steps);
    for (int step = 0; step < steps; ++step)
      find_equilibrium(pressed, {.duration = 1});
    const Stress stress = pressed.average_stress();
    const double ratio = pressed.state_of(0).volume * 8 / (1.3 * 0.8);
    error.push_back(std::abs(stress[0] * ratio / (soil.young_modulus * std::log(0.75)) - 1));
    CHECK(std::abs(stress[1]) < 1e-6 * std::abs(stress[0]));
  }
  CAPTURE(error[0], error[1]);
  CHECK(error[1] < 2e-3);
  CHECK(std::log2(error[0] / error[1]) == Approx(2).margin(0.2));
}
