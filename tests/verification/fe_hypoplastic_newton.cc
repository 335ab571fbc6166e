#include "fe_dealii/boundary/surface.h"
#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/equilibrium/static_equilibrium.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/material/hypoplastic_integration.h"
#include "fe_dealii/stable_step.h"
#include "tests/solid_shapes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace bergamo::fe;

namespace
{

HypoplasticParameters sand_of(const double void_ratio)
{
  HypoplasticParameters hochstetten;
  hochstetten.initial_void_ratio = void_ratio;
  return hochstetten;
}

/// How fast a balance is found in the end: the exponent log(r3/r2)/log(r2/r1) of the last residuals that follow each
/// other above rounding.
double last_order(const std::vector<double> &residual)
{
  double order = 0;
  for (std::size_t k = 2; k < residual.size(); ++k)
    if (residual[k] > 1e-13)
      order = std::log(residual[k] / residual[k - 1]) / std::log(residual[k - 1] / residual[k - 2]);
  return order;
}

} // namespace

TEST_CASE("hypoplastic sand: one element in a drained triaxial test by Newton's method is the point", "[fe]")
{
  constexpr double pressure = 100e3, step = 1e-3;
  const Shape shape = GENERATE(Shape::plain, Shape::bending, Shape::quadratic);
  const double void_ratio = GENERATE(0.60, 0.85);
  CAPTURE(static_cast<int>(shape), void_ratio);
  const HypoplasticSand sand(sand_of(void_ratio));
  ExplicitBodyParameters parameters;
  parameters.material = sand;
  set_shape(parameters, shape);
  parameters.initial_stress = uniform_pressure(pressure);
  ExplicitBody body = make_box_body({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, parameters);
  body.prescribe_velocity(5, 2, -step);
  for (const unsigned int face : {0u, 2u, 4u})
    body.prescribe_velocity(face, face / 2);
  for (const unsigned int face : {1u, 3u})
  {
    std::array<double, 3> traction{};
    traction[face / 2] = -pressure;
    SurfaceLoad(boundary_surface(body.dof_handler(), face), body.node_position())
        .add_traction(traction, body.external_force());
  }

  SandState point{{-pressure, -pressure, -pressure, 0, 0, 0}, void_ratio};
  double share = 0, worst = 0;
  std::size_t most_iterations = 0;
  for (int k = 0; k < 100; ++k)
  {
    const EquilibriumReport report = find_equilibrium(body, {.duration = 1});
    most_iterations = std::max(most_iterations, report.residual.size() - 1);
    REQUIRE(report.n_increments == 1);
    SandUpdate next{};
    for (int search = 0; search < 20; ++search)
    {
      const Strain increment{share * step, share * step, -step, 0, 0, 0};
      const Moduli moduli = consistent_tangent(sand, point, increment);
      next = update(sand, point, increment);
      share -= (next.state.stress[0] + pressure) / (step * (moduli[0][0] + moduli[0][1]));
    }
    point = next.state;
    const ElementState element = body.state_of(0);
    worst =
        std::max({worst, std::abs(element.stress[0] / -pressure - 1), std::abs(element.stress[2] / point.stress[2] - 1),
                  std::abs(element.void_ratio / point.void_ratio - 1)});
  }
  CHECK(worst < 1e-8); // the balance is found to 1e-9
  CHECK(most_iterations <= 8);
}

namespace
{

/// Ground of sand at rest under its weight and 20 kPa, 2 m by 1 m; a rough strip of 0.5 m at its corner goes down.
struct Strip
{
  ExplicitBody body;
  MovingBody::Constraint settlement;

  explicit Strip(const Shape shape, const double damping = 0)
      : body(make_box_body({{0, 0, -1}, {2, 0.25, 0}, {8, 1, 4}}, parameters(shape, damping))), settlement(0)
  {
    for (const unsigned int node : body.boundary_nodes(5))
      if (body.node_position()[node][0] < 0.51)
        footing_.push_back(node);
    for (const unsigned int component : {0u, 1u})
      body.prescribe_velocity(footing_, component);
    settlement = body.prescribe_velocity(footing_, 2);
    for (unsigned int face = 0; face < 5; ++face)
      body.prescribe_velocity(face, face / 2);
    SurfaceLoad(boundary_surface(body.dof_handler(), 5), body.node_position())
        .add_traction({0, 0, -20e3}, body.external_force());
    REQUIRE(find_equilibrium(body).residual.size() == 1); // rests as it lies
  }

  double force() const { return -body.reaction(settlement); } ///< of the strip on the ground, beyond the surcharge [N]

private:
  static ExplicitBodyParameters parameters(const Shape shape, const double damping)
  {
    const HypoplasticSand sand(sand_of(0.65));
    ExplicitBodyParameters p;
    p.material = sand;
    set_shape(p, shape);
    p.damping = damping;
    p.gravity = {0, 0, -9.81};
    p.initial_stress =
        geostatic_stress({.unit_weight = 9.81 * sand.density(), .earth_pressure_at_rest = 0.5, .surcharge = 20e3});
    return p;
  }

  std::vector<unsigned int> footing_;
};

} // namespace

TEST_CASE("hypoplastic sand: under a strip Newton's method is of second order", "[fe]")
{
  Strip strip(GENERATE(Shape::plain, Shape::bending, Shape::quadratic));
  strip.body.set_velocity(strip.settlement, -5e-4);
  for (int k = 0; k < 4; ++k)
  {
    const EquilibriumReport report = find_equilibrium(strip.body, {.duration = 1});
    CAPTURE(k, report.residual);
    CHECK(report.n_increments == 1);
    CHECK(report.residual.size() <= 12);
    CHECK(last_order(report.residual) > 1.8);
  }
}

TEST_CASE("hypoplastic sand: a slow explicit run under a strip comes to the static path", "[fe]")
{
  constexpr double settlement = 2e-3;
  const Shape shape = GENERATE(Shape::plain, Shape::bending);
  Strip at_rest(shape), moving(shape, 100);
  at_rest.body.set_velocity(at_rest.settlement, -settlement / 10);
  for (int k = 0; k < 10; ++k)
    find_equilibrium(at_rest.body, {.duration = 1});

  constexpr double time = 0.5, ramp = 0.1; // [s]
  const double speed = settlement / (time - 0.5 * ramp);
  double done = 0, greatest = 0;
  while (done < settlement)
  {
    moving.body.compute_internal_force();
    const double dt = 0.5 * stable_step(moving.body).time_step;
    const double velocity = speed * std::min(1., (moving.body.time() + 0.5 * dt) / ramp);
    moving.body.set_velocity(moving.settlement, -velocity);
    moving.body.kick(dt);
    greatest = moving.force();
    moving.body.drift(dt);
    done += velocity * dt;
  }
  CAPTURE(greatest, at_rest.force());
  CHECK(greatest == Approx(at_rest.force()).epsilon(0.03)); // rate, vibration, and increments of 0.2 mm
}
