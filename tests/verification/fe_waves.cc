// Pulses in bars against d'Alembert's solution: speed, shape, reflections. What the discrete bar makes of them is known
// in closed form, so the errors are foretold, not bounded: Belytschko, Liu, Moran, Nonlinear Finite Elements (2000),
// sec. 6.2 (dispersion of the lumped bar); Love, Mathematical Theory of Elasticity (1927), sec. 278 (inertia of the
// sides).

#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"
#include "tests/threads.h"

#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace bergamo::fe;

namespace
{

constexpr ElasticParameters steel{.young_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800};
constexpr double peak = 0.1;   // of the velocity [m/s]
constexpr double width = 0.1;  // standard deviation [m]
constexpr double start = -0.6; // where its middle is at t = 0: outside [m]
constexpr double path = 1.5;   // where it is at the end [m]

/// Velocity of the pulse at a distance from its middle; it pushes: v > 0 running to the right is compression.
double velocity(const double distance)
{
  return peak * std::exp(-0.5 * distance * distance / (width * width));
}

/// Displacement that it leaves behind, zero ahead of it.
double displacement(const double distance, const double c)
{
  return peak / c * width * std::sqrt(std::numbers::pi / 2) * std::erfc(distance / (std::numbers::sqrt2 * width));
}

ExplicitBody bar(const BoxMeshParameters &shape, const unsigned int degree)
{
  ExplicitBodyParameters parameters;
  parameters.material = LinearElastic(steel);
  parameters.degree = degree;
  dealii::Triangulation<3> mesh;
  make_box(shape, mesh);
  return ExplicitBody(mesh, parameters);
}

void hold_sides(ExplicitBody &body)
{
  for (unsigned int id = 2; id < 6; ++id)
    body.prescribe_velocity(id, id / 2);
}

void step(ExplicitBody &body, const double dt)
{
  body.compute_internal_force();
  body.kick(dt);
  body.drift(dt);
}

/// Sends a pulse into a bar at rest through the face x = 0 until its middle has run the path. Starting from a pulse
/// inside would shake the modes within each element: those of the exact solution and of the mesh differ a little.
/// @param advance wanted of the pulse in a step [m]; @return the time step [s]
double send_pulse(ExplicitBody &body, const ExplicitBody::Constraint pushed, const double c, const double advance)
{
  const int steps = std::lround((path - start) / advance);
  const double dt = (path - start) / c / steps;
  REQUIRE(dt < stable_step(body).time_step);
  for (int k = 0; k < steps; ++k)
  {
    body.set_velocity(pushed, velocity(-start - c * (k + 0.5) * dt));
    step(body, dt);
  }
  return dt;
}

/// Of the axial velocities at the end, over the whole. @param advance of the pulse in a step [m]
double relative_error(const ExplicitBody &body, const double advance)
{
  double error = 0, whole = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const double v = velocity(body.node_position()[node][0] - path + 0.5 * advance), mass = body.mass()[3 * node];
    error += mass * std::pow(body.velocity()[3 * node] - v, 2);
    whole += mass * v * v;
  }
  return std::sqrt(error / whole);
}

/// Relative error of the pulse at the end, each wave exp(ikx) having run ahead by the share second k² + fourth k⁴ of
/// the path. The pulse's spectrum is normal with the variance 1/(2 width²); the moments of k follow.
double foretold(const double second, const double fourth)
{
  const double k2 = 0.5 / (width * width);
  return path * std::sqrt(second * second * 15 * std::pow(k2, 3) + 2 * second * fourth * 105 * std::pow(k2, 4) +
                          fourth * fourth * 945 * std::pow(k2, 5));
}

} // namespace

TEST_CASE("A pulse between held sides runs with sqrt(M/rho): its error is that foretold, of order 2 and 4 in the mesh",
          "[fe]")
{
  const Threads one(1);
  // A wave runs ahead by (k c dt)²/24 because of the time step. It lags by (k h)²/24 in a lumped bar of 8 nodes, and by
  // (k h)⁴/2880 in one of 27 with Simpson's masses: there Bloch's waves have, with L = (ω h/c)² and d = 1 − cos kh,
  // L² − (24 − 2 d) L + 48 d = 0, so L = (kh)² (1 − (kh)⁴/1440 + ...).
  constexpr double length = 2.5;
  for (const unsigned int degree : {1u, 2u})
  {
    std::vector<double> error, expected;
    for (const unsigned int n : degree == 1 ? std::array{50u, 100u, 200u} : std::array{25u, 50u, 100u})
    {
      const double h = length / n;
      ExplicitBody body = bar({{0, 0, 0}, {length, 0.1, 0.1}, {n, 1, 1}}, degree);
      const double c = p_wave_speed(body.material());
      const auto pushed = body.prescribe_velocity(0u, 0);
      hold_sides(body);
      // 27 nodes: with dt ~ h², the time step's part is of fourth order too.
      const double dt = send_pulse(body, pushed, c, degree == 1 ? 0.5 * h : 1.5 * h * h);
      error.push_back(relative_error(body, c * dt));
      const double ahead = c * c * dt * dt / 24;
      expected.push_back(degree == 1 ? foretold(ahead - h * h / 24, 0) : foretold(ahead, -std::pow(h, 4) / 2880));
      if (n % 100 == 0)
        CHECK(body.max_velocity() == Approx(peak).epsilon(expected.back()));
    }
    CAPTURE(degree, error, expected);
    // What the prediction leaves out is of the share (kh)²: for the waves that matter k² = 11/(2 width²), with a
    // coefficient below a third.
    const double h = length / (degree == 1 ? 100 : 50);
    CHECK(error[1] == Approx(expected[1]).epsilon(2 * std::pow(h / width, 2)));
    CHECK(error[2] == Approx(expected[2]).epsilon(0.5 * std::pow(h / width, 2)));
    CHECK(std::log2(error[1] / error[2]) == Approx(2 * degree).margin(0.1 * degree));
  }
}

TEST_CASE("A pulse that fills one element a step is d'Alembert's to rounding, reflections with their signs included",
          "[fe]")
{
  const Threads one(1);
  // At c dt = h the leapfrog on a lumped bar is u(x, t + dt) = u(x − h, t) + u(x + h, t) − u(x, t − dt), which every
  // f(x − ct) + g(x + ct) fulfils; a free end is a mirror, a fixed one a mirror with the sign changed.
  constexpr double length = 2, begin = 0.75;
  constexpr unsigned int n = 80;
  const double c = p_wave_speed(LinearElastic(steel)), h = length / n, dt = h / c;
  for (const bool fixed : {false, true})
  {
    // A wide section: modes of shear across it would not be stable at this step, but need longer to grow.
    ExplicitBody body = bar({{0, 0, 0}, {length, 10, 10}, {n, 1, 1}}, 1);
    if (fixed)
      body.prescribe_velocity(1u, 0);
    hold_sides(body);
    const double sign = fixed ? -1 : 1;
    const auto exact = [&](const double x, const double t)
    { return displacement(x - begin - c * t, c) + sign * displacement(2 * length - x - begin - c * t, c); };
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const double x = body.node_position()[node][0];
      body.displacement()[3 * node] = exact(x, 0);
      body.velocity()[3 * node] = (exact(x, 0) - exact(x, -dt)) / dt;
    }
    const int steps = 2 * std::lround((length - begin) / h); // the pulse is back where it was
    double greatest_velocity = 0, greatest_force = 0, worst = 0;
    const auto end = body.boundary_nodes(1);
    for (int k = 1; k <= steps; ++k)
    {
      step(body, dt);
      greatest_velocity = std::max(greatest_velocity, body.velocity()[3 * end[0]]);
      if (fixed)
        greatest_force = std::max(greatest_force, -body.reaction(MovingBody::Constraint(0)));
      for (std::size_t node = 0; node < body.n_nodes(); ++node)
        worst = std::max(worst, std::abs(body.displacement()[3 * node] - exact(body.node_position()[node][0], k * dt)));
    }
    CAPTURE(fixed, worst);
    CHECK(worst < 1e-9 * displacement(-1, c));
    // The element where the middle of the pulse is: compression at first, then tension from the free end.
    body.compute_internal_force();
    const double impedance = density(body.material()) * c;
    double stress = 0;
    for (std::size_t e = 0; e < body.n_elements(); ++e)
      if (const double s = body.state_of(e).stress[0]; std::abs(s) > std::abs(stress))
        stress = s;
    const double within_element = 0.5 * std::pow(h / width, 2); // the pulse's curvature
    CHECK(stress == Approx(sign * impedance * peak).epsilon(within_element));
    // At the end both pulses add up: twice the velocity where it is free, twice the stress where it is fixed.
    if (fixed)
      CHECK(greatest_force / 100 == Approx(2 * impedance * peak).epsilon(within_element));
    else
      CHECK(greatest_velocity == Approx(2 * peak).epsilon(within_element));
  }
}

TEST_CASE("A pulse in a slender free bar runs with sqrt(E/rho) and spreads by the inertia of its sides", "[fe]")
{
  const Threads one(1);
  // Love: the bar's speed is sqrt(E/ρ) (1 − ν² K² k²/2), K² = b²/6 the polar radius of gyration of the square section.
  // One layer of 27 nodes has that inertia exactly.
  constexpr double side = 0.03;
  const double c = std::sqrt(steel.young_modulus / steel.density), nu = steel.poisson_ratio;
  ExplicitBody body = bar({{0, -side / 2, -side / 2}, {2.5, side / 2, side / 2}, {100, 1, 1}}, 2);
  const auto pushed = body.prescribe_velocity(0u, 0);
  const double dt = send_pulse(body, pushed, c, 0.006);
  const double ahead = c * c * dt * dt / 24, lag = nu * nu * side * side / 12;
  const double error = relative_error(body, c * dt), expected = foretold(ahead - lag, 0);
  // The middle of the momentum moves with the speed of the long waves.
  double moment = 0, momentum = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const double part = body.mass()[3 * node] * body.velocity()[3 * node];
    momentum += part;
    moment += part * body.node_position()[node][0];
  }
  const double speed = (moment / momentum - start) / (path - start - 0.5 * c * dt);
  CAPTURE(speed, p_wave_speed(body.material()) / c, ahead, lag, error, expected);
  CHECK(speed == Approx(1).epsilon(1e-3));
  CHECK(error == Approx(expected).epsilon(0.1));
}
