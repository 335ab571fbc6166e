// One step of a body: forces · kick · [read] · drift. What is read changes nothing, and the time step may change.

#include "dem/core/error.h"
#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/conditions/boundary_conditions.h"
#include "fe_dealii/conditions/rigid_boundary.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/membrane_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>

using namespace bergamo;
using namespace bergamo::fe;
using Catch::Matchers::Contains;

namespace
{

constexpr double g = 9.81;

/// A cube of 1 m with 2³ elements; boundary 4 is its floor, 5 its top.
ExplicitBody cube(const ExplicitBodyParameters &parameters)
{
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, mesh);
  return ExplicitBody(mesh, parameters);
}

/// Sand that flows under its weight and a push from above, with a stiffness that depends on the pressure.
ExplicitBodyParameters sand(const unsigned int degree)
{
  ExplicitBodyParameters p;
  p.material = MohrCoulomb({.young_modulus = 1e6,
                            .friction_angle = 25,
                            .dilation_angle = 5,
                            .cohesion = 500,
                            .reference_pressure = 1e4,
                            .stiffness_exponent = 0.5});
  p.degree = degree;
  p.gravity = {0, 0, -g};
  p.damping = 3;
  p.initial_stress = uniform_pressure(2e3);
  return p;
}

/// A square sheet of rubber of 1 m in the plane z = 0.
MembraneBody sheet()
{
  dealii::Triangulation<2> flat;
  dealii::GridGenerator::subdivided_hyper_rectangle(flat, {3, 3}, dealii::Point<2>(), dealii::Point<2>(1, 1), true);
  dealii::Triangulation<2, 3> mesh;
  dealii::GridGenerator::flatten_triangulation(flat, mesh);
  return MembraneBody(mesh, {.material = Ogden({}), .thickness = 1e-3, .gravity = {0, 0, -g}, .damping = 2});
}

/// All that a step depends on.
std::vector<double> state_of(MovingBody &body)
{
  std::vector<double> all;
  for (const auto &[name, values] : body.state())
    all.insert(all.end(), values.begin(), values.end());
  return all;
}

} // namespace

TEST_CASE("free fall is exact whatever the time steps", "[fe]")
{
  ExplicitBodyParameters parameters;
  parameters.gravity = {0, 0, -g};
  ExplicitBody body = cube(parameters);
  const auto steps = GENERATE(std::pair(1e-3, 1e-4), std::pair(1e-4, 1e-3));
  const double change = 0.1, end = 0.2;                     // [s]
  for (std::size_t node = 0; node < body.n_nodes(); ++node) // at rest at time 0, half a step after this velocity
    body.velocity()[3 * node + 2] = 0.5 * steps.first * g;
  double time = 0;
  const auto fall = [&](const double dt, const double until)
  {
    for (; time < until - 0.5 * dt; time += dt)
    {
      body.compute_internal_force();
      body.kick(dt);
      body.drift(dt);
    }
  };
  fall(steps.first, change);
  fall(steps.second, end);
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    CHECK(body.displacement()[3 * node + 2] == Approx(-0.5 * g * end * end).epsilon(1e-11));
}

TEST_CASE("a rigid body falls freely whatever the time steps", "[fe]")
{
  ExplicitBodyParameters parameters;
  parameters.gravity = {0, 0, -g};
  ExplicitBody body = cube(parameters);
  RigidBoundary plate(body, body.boundary_nodes(5), {.mass = 100, .centre = {0.5, 0.5, 1}, .inertia = {9, 9, 9}});
  const double start = plate.centre()[2];
  double time = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node) // at rest at time 0, half a step after this velocity
    body.velocity()[3 * node + 2] = 0.5 * 1e-3 * g;
  for (int k = 0; k < 1100; ++k)
  {
    const double dt = k < 100 ? 1e-3 : 1e-4;
    if (k == 0)
      plate.prescribe({0, 0, -0.5 * g * dt}, {}, dt);
    else
      plate.move({}, {}, dt);
    body.kick(dt);
    body.drift(dt);
    time += dt;
  }
  CHECK(plate.centre()[2] - start == Approx(-0.5 * g * time * time).epsilon(1e-10));
  CHECK(body.displacement()[2] == Approx(-0.5 * g * time * time).epsilon(1e-10)); // and the cube with it
}

TEST_CASE("energies close to rounding at changing time steps", "[fe]")
{
  ExplicitBody body = cube(sand(1));
  const auto floor = body.prescribe_velocity(4u, 2, 0.);
  const auto push = body.prescribe_velocity(5u, 2, 0.);
  const SurfaceLoad side(boundary_surface(body.dof_handler(), 0), body.node_position());
  const double stable = stable_step(body).time_step;
  double turnover = 0, largest = 0, time = 0;
  for (int k = 0; k < 2000; ++k)
  {
    const double dt = stable * (0.3 + 0.15 * std::sin(1.7 * k) + (k % 7 == 0 ? 0.2 : 0.));
    body.clear_external_force();
    side.add_traction({-500 * std::sin(40 * time), 0, 0},
                      {body.external_force().begin(), body.external_force().size()});
    body.compute_internal_force();
    body.set_velocity(push, k < 1000 ? -0.05 : 0.01 * std::sin(30 * time));
    body.kick(dt);
    const BodyEnergy e = body.energy();
    turnover = std::max({turnover, std::abs(e.kinetic), std::abs(e.boundary_work), e.plastic_dissipation});
    largest = std::max(largest, std::abs(e.residual()));
    body.drift(dt);
    time += dt;
  }
  const BodyEnergy e = body.energy();
  CHECK(e.plastic_dissipation > 0.01 * turnover);
  CHECK(std::abs(e.step_change) > 1e3 * largest); // it takes this part to close
  CHECK(largest < 1e-11 * turnover);
  CHECK(std::isfinite(body.reaction(floor)));
}

TEST_CASE("forces may be asked for, and all be read, as often as one likes", "[fe]")
{
  const std::function<std::unique_ptr<MovingBody>()> make = GENERATE(
      as<std::function<std::unique_ptr<MovingBody>()>>(), [] { return std::make_unique<ExplicitBody>(cube(sand(1))); },
      [] { return std::make_unique<ExplicitBody>(cube(sand(2))); },
      [] { return std::make_unique<MembraneBody>(sheet()); });
  std::vector<double> ends[2];
  double plastic = 0;
  for (const bool often : {false, true})
  {
    const auto body = make();
    const unsigned int held = body->boundary_nodes(0).front();
    const unsigned int corner[] = {held};
    for (unsigned int i = 0; i < 3; ++i)
      body->prescribe_velocity(corner, i);
    const double dt = 0.2 * stable_step(*body).time_step;
    for (int k = 0; k < 150; ++k)
    {
      const auto force = [&]
      {
        body->clear_external_force();
        for (std::size_t node = 0; node < body->n_nodes(); ++node)
          body->external_force()[3 * node] = 3e3 * body->mass()[3 * node] * std::sin(0.1 * k) / 1e3;
        body->compute_internal_force();
      };
      const auto read = [&]
      {
        body->energy();
        body->average_stress();
        body->state_of(0);
        stable_step(*body);
      };
      force();
      if (often)
      {
        read();
        force();
        force();
      }
      body->kick(dt);
      if (often)
      {
        read();
        body->compute_internal_force();
      }
      body->drift(dt);
      if (often)
        read();
    }
    ends[often] = state_of(*body);
    plastic += body->energy().plastic_dissipation;
  }
  CHECK(ends[0] == ends[1]);
  CHECK(ends[0].size() > 100);
  if (dynamic_cast<ExplicitBody *>(make().get()))
    CHECK(plastic > 0);
}

TEST_CASE("a rigid body asked to move twice in a step moves once", "[fe]")
{
  std::vector<double> ends[2];
  for (const bool often : {false, true})
  {
    ExplicitBody body = cube(sand(1));
    RigidBoundary plate(body, body.boundary_nodes(5),
                        {.mass = 500, .centre = {0.5, 0.4, 1.1}, .inertia = {90, 80, 70}});
    const double dt = 0.3 * stable_step(body).time_step;
    for (int k = 0; k < 200; ++k)
    {
      body.compute_internal_force();
      const RigidBoundary::Vector before = plate.centre();
      if (often)
        plate.move({1, 2, 3}, {4, 5, 6}, 0.7 * dt); // thought better of
      plate.move({0, 100, -2000}, {10, 0, 0}, dt);
      CHECK(plate.centre() == before); // it goes with the drift
      body.kick(dt);
      body.drift(dt);
      CHECK(plate.centre() != before);
    }
    ends[often] = state_of(body);
    for (const auto &[name, values] : plate.state())
      ends[often].insert(ends[often].end(), values.begin(), values.end());
  }
  CHECK(ends[0] == ends[1]);
}

TEST_CASE("a velocity set between two steps acts on the coming drift alone", "[fe]")
{
  ExplicitBody body = cube({});
  const auto constraint = body.prescribe_velocity(5u, 2, 0.01);
  const std::size_t dof = 3 * std::size_t(body.boundary_nodes(5).front()) + 2;
  const double dt = 0.3 * stable_step(body).time_step;
  double place = 0;
  for (const double velocity : {0.01, -0.02, 0., 0.05})
  {
    body.set_velocity(constraint, velocity);
    CHECK(body.displacement()[dof] == place); // not on the drift already made
    body.compute_internal_force();
    body.kick(dt);
    CHECK(std::abs(body.energy().residual()) < 1e-12 * std::abs(body.energy().boundary_work) + 1e-15);
    body.drift(dt);
    CHECK(body.displacement()[dof] == place + dt * velocity);
    place = body.displacement()[dof];
  }
}

TEST_CASE("a step that breaks the order or has no length is refused, and changes nothing", "[fe]")
{
  ExplicitBody body = cube(sand(1));
  const double dt = 0.3 * stable_step(body).time_step;
  CHECK_THROWS_WITH(body.drift(dt), Contains("without a kick"));
  body.compute_internal_force();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const std::vector<double> start = state_of(body);
  for (const double wrong : {nan, 0., -dt, infinite})
    CHECK_THROWS_AS(body.kick(wrong), ConfigError);
  CHECK_THROWS_WITH(body.kick(nan), Contains("continuum: the time step is nan"));
  CHECK(state_of(body) == start);
  body.kick(dt);
  const std::vector<double> kicked = state_of(body);
  CHECK_THROWS_WITH(body.kick(dt), Contains("kicked twice"));
  CHECK_THROWS_WITH(body.drift(0.5 * dt), Contains("kick with the same time step"));
  CHECK(state_of(body) == kicked);
  body.drift(dt);
  CHECK_THROWS_AS(body.drift(dt), RunError);

  std::vector<BoundaryCondition> list;
  list.push_back(parse_condition("4 displacement z 0"));
  BoundaryConditions conditions(body, std::move(list));
  CHECK_THROWS_WITH(conditions.apply(0, nan), Contains("time step is nan"));
  RigidBoundary plate(body, body.boundary_nodes(5), {.mass = 1, .inertia = {1, 1, 1}});
  CHECK_THROWS_WITH(plate.move({}, {}, nan), Contains("time step is nan"));
  CHECK_THROWS_WITH(plate.prescribe({}, {}, 0), Contains("time step is 0"));
}

TEST_CASE("a run goes on with the same bits from any point of a step", "[fe]")
{
  const int stop = GENERATE(0, 1, 2); // before the forces, the kick, the drift
  ExplicitBody straight = cube(sand(1)), first = cube(sand(1)), second = cube(sand(1));
  const double dt = 0.3 * stable_step(straight).time_step;
  const auto step = [dt](ExplicitBody &body, const int from, const int to)
  {
    if (from <= 0 && to > 0)
      body.compute_internal_force();
    if (from <= 1 && to > 1)
      body.kick(dt);
    if (from <= 2 && to > 2)
      body.drift(dt);
  };
  for (ExplicitBody *body : {&straight, &first})
    for (int k = 0; k < 50; ++k)
      step(*body, 0, 3);
  step(first, 0, stop);
  const auto from = first.state(), to = second.state();
  for (std::size_t k = 0; k < from.size(); ++k)
    std::copy(from[k].second.begin(), from[k].second.end(), to[k].second.begin());
  second.compute_internal_force(); // asked for again
  step(second, stop, 3);
  step(straight, 0, 3);
  for (ExplicitBody *body : {&straight, &second})
    step(*body, 0, 3);
  CHECK(state_of(straight) == state_of(second));
}
