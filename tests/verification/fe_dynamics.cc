#include "fe_dealii/element/small_strain_elements.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include "tests/same_bits.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace bergamo::fe;

namespace
{

constexpr double bar_length = 1;
constexpr unsigned int bar_elements = 20;

// ν = 0: waves along x do not spread sideways. Clamped at x = 0, free at the other end.
ExplicitBody bar()
{
  ExplicitBodyParameters parameters;
  parameters.material = MohrCoulomb({.poisson_ratio = 0, .cohesion = 1e12});
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {bar_length, 0.05, 0.05}, {bar_elements, 1, 1}}, mesh);
  ExplicitBody body(mesh, parameters);
  body.prescribe_velocity(0u, 0);
  return body;
}

// First mode of the lumped bar, sin(πx/2L): ω_h = (2c/h) sin(πh/4L); exactly, ω = πc/2L.
double mode_frequency(const ExplicitBody &body)
{
  const double h = bar_length / bar_elements;
  return 2 * p_wave_speed(body.material()) / h * std::sin(std::numbers::pi * h / (4 * bar_length));
}

double mode(const double x)
{
  return std::sin(std::numbers::pi * x / (2 * bar_length));
}

// Everything at once: plasticity, gravity, damping, a moving lid, a share that varies, coupling-like forces, prestress.
struct Everything
{
  static ExplicitBody make(const bool shared = true, const Hourglass hourglass = Hourglass::at_points)
  {
    ExplicitBodyParameters parameters;
    parameters.kind.hourglass = hourglass;
    parameters.gravity = {0.3, 0, -9.81};
    parameters.damping = 20;
    parameters.initial_stress = uniform_pressure(2000);
    dealii::Triangulation<3> mesh;
    make_box({{0, 0, 0}, {1, 1, 1}, {9, 8, 7}}, mesh);
    dealii::GridTools::distort_random(0.15, mesh, true, 5);
    ExplicitBody body(mesh, parameters);
    if (shared)
    {
      std::vector<double> weight(body.n_nodes());
      for (std::size_t node = 0; node < weight.size(); ++node)
        weight[node] = 0.9 * body.node_position()[node][0];
      body.set_share(weight);
    }
    body.prescribe_velocity(5u, 2);
    body.prescribe_velocity(4u, 2);
    for (unsigned int id = 0; id < 4; ++id)
      body.prescribe_velocity(id, id / 2);
    return body;
  }
  static void step(ExplicitBody &body, const int number, const double dt)
  {
    body.set_velocity(MovingBody::Constraint(0), -0.5 * std::sin(0.01 * number));
    body.clear_external_force();
    for (std::size_t dof = 0; dof < 3 * body.n_nodes(); dof += 7)
      body.external_force()[dof] += 2 * std::sin(0.02 * number + dof);
    body.compute_internal_force();
    body.kick(dt);
    body.drift(dt);
  }
};

} // namespace

TEST_CASE("A bar's first mode: second order in the time step, and the frequency of the closed form", "[fe]")
{
  // Leapfrog oscillates with sin(ω_d dt/2) = ω_h dt/2, so its phase error falls with dt².
  std::vector<double> error;
  for (const int steps : {200, 400, 800})
  {
    ExplicitBody body = bar();
    const double omega = mode_frequency(body), end = 1.3 * 2 * std::numbers::pi / omega, dt = end / steps;
    REQUIRE(dt < stable_step(body).time_step);
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const double shape = 1e-4 * mode(body.node_position()[node][0]);
      body.displacement()[3 * node] = shape;
      body.velocity()[3 * node] = shape * omega * std::sin(omega * dt / 2); // of cos(ωt) at −dt/2
    }
    for (int step = 0; step < steps; ++step)
    {
      body.compute_internal_force();
      body.kick(dt);
      body.drift(dt);
    }
    double worst = 0;
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      worst = std::max(worst, std::abs(body.displacement()[3 * node] -
                                       1e-4 * mode(body.node_position()[node][0]) * std::cos(omega * end)));
    error.push_back(worst / 1e-4);
  }
  INFO("relative errors at 200, 400, 800 steps: " << error[0] << " " << error[1] << " " << error[2]);
  CHECK(std::log2(error[0] / error[1]) == Approx(2).margin(0.1));
  CHECK(std::log2(error[1] / error[2]) == Approx(2).margin(0.1));

  ExplicitBody body = bar(); // and in space: (1 − ω_h/ω) = (πh/4L)²/6
  const double exact = std::numbers::pi * p_wave_speed(body.material()) / (2 * bar_length);
  CHECK(mode_frequency(body) == Approx(exact).epsilon(1e-3));
}

TEST_CASE("A step wave runs with c = sqrt(E/rho) and carries sigma = -rho c v", "[fe]")
{
  ExplicitBody body = bar();
  body.set_velocity(MovingBody::Constraint(0), 0.1);
  const double c =
      std::sqrt(std::get<MohrCoulomb>(body.material()).parameters().young_modulus / density(body.material()));
  CHECK(c == Approx(p_wave_speed(body.material())));
  const double dt = 0.5 * bar_length / bar_elements / c;
  const int steps = 20; // the front is at x = 0.5
  double reaction = 0;
  for (int step = 0; step < steps; ++step)
  {
    body.compute_internal_force();
    body.kick(dt);
    body.drift(dt);
    reaction += body.reaction(MovingBody::Constraint(0)) / steps;
  }
  const double impedance = density(body.material()) * c * 0.1;
  CHECK(reaction / (0.05 * 0.05) == Approx(impedance).epsilon(0.03));
  double momentum = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    momentum += body.mass()[3 * node] * body.velocity()[3 * node];
  CHECK(momentum == Approx(reaction * steps * dt).epsilon(1e-10));
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    if (body.node_position()[node][0] > 0.7)
      CHECK(std::abs(body.velocity()[3 * node]) < 1e-3);
}

TEST_CASE("The energy balance closes to rounding, with plastic flow, damping, gravity, a lid, forces and a share",
          "[fe]")
{
  const Hourglass hourglass = GENERATE(Hourglass::at_points, Hourglass::bending);
  ExplicitBody body = Everything::make(true, hourglass);
  const double dt = 0.8 * stable_step(body).time_step;
  double worst = 0, scale = 0;
  int plastic_steps = 0;
  for (int step = 0; step < 3000; ++step)
  {
    Everything::step(body, step, dt);
    if (step % 50 != 0)
      continue;
    const BodyEnergy e = body.energy();
    scale = std::max({scale, std::abs(e.boundary_work), e.kinetic, e.elastic});
    worst = std::max(worst, std::abs(e.residual()));
    for (std::size_t k = 0; k < body.n_elements(); ++k)
      if (dynamic_cast<const SmallStrainElements<MohrCoulomb> &>(body.elements()).sector(k, 0) != Sector::elastic)
      {
        ++plastic_steps;
        break;
      }
  }
  const BodyEnergy e = body.energy();
  INFO("energies [J]: kinetic " << e.kinetic << " elastic " << e.elastic << " plastic " << e.plastic_dissipation
                                << " viscous " << e.viscous_dissipation << " boundary " << e.boundary_work
                                << " gravity " << e.gravity_work << " external " << e.external_work
                                << "; worst residual " << worst << " = " << worst / scale << " of the greatest");
  CHECK(plastic_steps > 20);
  CHECK(e.plastic_dissipation > 0.01 * scale);
  CHECK(e.viscous_dissipation > 0);
  CHECK(worst < 1e-10 * scale);
  CHECK(body.is_finite());
}

TEST_CASE("The same bits on 1, 2 and 3 threads", "[fe]")
{
  const Hourglass hourglass = GENERATE(Hourglass::at_points, Hourglass::bending);
  std::vector<ExplicitBody> bodies;
  for (int n = 1; n <= 3; ++n)
  {
    const Threads team(n);
    bodies.push_back(Everything::make(true, hourglass));
    const double dt = 0.8 * stable_step(bodies.back()).time_step;
    for (int step = 0; step < 300; ++step)
      Everything::step(bodies.back(), step, dt);
  }
  CHECK(same_bits(bodies[0], bodies[1]));
  CHECK(same_bits(bodies[0], bodies[2]));
}

TEST_CASE("A restored state goes on with the same bits", "[fe]")
{
  const Hourglass hourglass = GENERATE(Hourglass::at_points, Hourglass::bending);
  const auto make = [&] { return Everything::make(true, hourglass); };
  ExplicitBody through = make(), restored = make();
  const double dt = 0.8 * stable_step(through).time_step;
  for (int step = 0; step < 200; ++step)
    Everything::step(through, step, dt);
  const auto from = through.state();
  const auto to = restored.state();
  for (std::size_t k = 0; k < from.size(); ++k)
  {
    REQUIRE(from[k].first == to[k].first);
    std::copy(from[k].second.begin(), from[k].second.end(), to[k].second.begin());
  }
  for (int step = 200; step < 400; ++step)
  {
    Everything::step(through, step, dt);
    Everything::step(restored, step, dt);
  }
  CHECK(same_bits(through, restored));
  CHECK(through.energy().residual() == restored.energy().residual());
}

TEST_CASE("A share of one half everywhere halves mass and force and leaves the motion as it was", "[fe]")
{
  ExplicitBody whole = Everything::make(false), half = Everything::make(false);
  half.set_share(std::vector<double>(half.n_nodes(), 0.5));
  const double dt = 0.8 * stable_step(whole).time_step;
  CHECK(stable_step(half).time_step == Approx(stable_step(whole).time_step).epsilon(1e-12));
  for (int step = 0; step < 300; ++step)
    for (ExplicitBody *body : {&whole, &half})
    {
      body->set_velocity(MovingBody::Constraint(0), -0.5 * std::sin(0.01 * step));
      body->compute_internal_force();
      body->kick(dt);
      body->drift(dt);
    }
  double scale = 0;
  for (const double f : whole.internal_force())
    scale = std::max(scale, std::abs(f));
  for (std::size_t dof = 0; dof < 3 * whole.n_nodes(); ++dof)
  {
    REQUIRE(half.mass()[dof] == Approx(0.5 * whole.mass()[dof]).epsilon(1e-14));
    REQUIRE(half.displacement()[dof] == Approx(whole.displacement()[dof]).margin(1e-12));
    REQUIRE(half.internal_force()[dof] == Approx(0.5 * whole.internal_force()[dof]).margin(1e-10 * scale));
  }
  CHECK(half.reaction(MovingBody::Constraint(0)) == Approx(0.5 * whole.reaction(MovingBody::Constraint(0))));
  CHECK(half.energy().elastic == Approx(0.5 * whole.energy().elastic));
}

TEST_CASE("A body under its own weight settles to the earth pressure at rest", "[fe]")
{
  // Oedometric: σ_zz = −ρ g (H − z), σ_xx = ν/(1 − ν) σ_zz, the floor carries the weight.
  ExplicitBodyParameters parameters;
  parameters.gravity = {0, 0, -9.81};
  parameters.damping = 300;
  // Stays elastic at K0 = ν/(1 − ν) = 0.17.
  parameters.material = MohrCoulomb({.friction_angle = 60, .cohesion = 1e4});
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 1, 2}, {2, 2, 8}}, mesh);
  ExplicitBody body(mesh, parameters);
  const auto floor = body.prescribe_velocity(4u, 2);
  for (unsigned int id = 0; id < 4; ++id)
    body.prescribe_velocity(id, id / 2);
  const double dt = 0.9 * stable_step(body).time_step;
  for (int step = 0; step < 6000; ++step)
  {
    body.compute_internal_force();
    body.kick(dt);
    body.drift(dt);
  }
  const double weight = 1600 * 9.81 * 2;
  CHECK(body.max_velocity() < 1e-9);
  CHECK(body.reaction(floor) == Approx(weight).epsilon(1e-6));
  const Stress average = body.average_stress();
  CHECK(average[2] == Approx(-weight / 2).epsilon(1e-6));
  CHECK(average[0] == Approx(-weight / 2 * 0.145 / 0.855).epsilon(1e-6));
}
