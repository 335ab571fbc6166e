// Bars and blocks against walls. A bar that hits a rigid wall at the speed v presses with rho c v until the wave from
// its free end is back after 2 L/c; then all of it moves away with v (St. Venant; Timoshenko & Goodier, Theory of
// Elasticity, 1970, sec. 168-169).

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

ElasticParameters rubber(const double poisson_ratio)
{
  return {.young_modulus = 1e7, .poisson_ratio = poisson_ratio, .density = 1600};
}

ExplicitBody block(const BoxMeshParameters &shape, const double poisson_ratio, const double gravity = 0)
{
  ExplicitBodyParameters parameters;
  parameters.material = LinearElastic(rubber(poisson_ratio));
  parameters.gravity = {0, 0, -gravity};
  dealii::Triangulation<3> mesh;
  make_box(shape, mesh);
  return ExplicitBody(mesh, parameters);
}

void throw_down(ExplicitBody &body, const double velocity)
{
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    body.velocity()[3 * node + 2] = -velocity;
}

double mass_of(const ExplicitBody &body)
{
  double sum = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    sum += body.mass()[3 * node + 2];
  return sum;
}

double momentum_of(const ExplicitBody &body)
{
  double sum = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    sum += body.mass()[3 * node + 2] * body.velocity()[3 * node + 2];
  return sum;
}

/// Floor at z = 0 that only pushes: a spring at each node of the body's bottom, by its share of the mass of the bottom.
class Floor
{
public:
  Floor(const ExplicitBody &body, const double stiffness) : nodes(body.boundary_nodes(4))
  {
    double whole = 0;
    for (const unsigned int node : nodes)
      whole += body.mass()[3 * node + 2];
    for (const unsigned int node : nodes)
      spring.push_back(stiffness * body.mass()[3 * node + 2] / whole);
    eigenvalue = stiffness / whole;
  }
  /// @return its force [N]
  double push(ExplicitBody &body) const
  {
    body.clear_external_force();
    double whole = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k)
    {
      const double depth = -(body.node_position()[nodes[k]][2] + body.displacement()[3 * std::size_t(nodes[k]) + 2]);
      const double force = spring[k] * std::max(depth, 0.);
      body.external_force()[3 * std::size_t(nodes[k]) + 2] += force;
      whole += force;
    }
    return whole;
  }
  double stable_step(const ExplicitBody &body) const
  {
    return 2 / std::sqrt(bergamo::fe::stable_step(body).largest_eigenvalue + eigenvalue);
  }

private:
  std::vector<unsigned int> nodes;
  std::vector<double> spring;
  double eigenvalue; // of the springs alone [1/s²]
};

} // namespace

TEST_CASE("A bar that hits a wall: pressure, duration and rebound to rounding where a step is an element", "[fe]")
{
  const Threads one(1);
  // At c dt = h the leapfrog is exact in the nodes (fe_waves.cc). The wall's nodes stop at once and lose their energy.
  constexpr int n = 50;
  constexpr double length = 1, area = 100, v = 0.2;
  ExplicitBody body = block({{0, 0, 0}, {10, 10, length}, {1, 1, n}}, 0.3);
  const auto wall = body.prescribe_velocity(4u, 2);
  for (unsigned int id = 0; id < 4; ++id)
    body.prescribe_velocity(id, id / 2);
  const double c = p_wave_speed(body.material()), dt = length / n / c;
  const double force = density(body.material()) * c * v * area, mass = mass_of(body), of_wall = mass / n / 2;
  throw_down(body, v);
  double impulse = 0;
  for (int k = 0; k <= 2 * n; ++k)
  {
    body.compute_internal_force();
    body.kick(dt);
    // Half of the force as the wall's nodes stop, none as the bar would leave.
    const double expected = k == 0 ? 0.5 : k < 2 * n ? 1 : 0;
    REQUIRE(body.reaction(wall) == Approx(expected * force).margin(1e-9 * force));
    impulse += body.reaction(wall) * dt;
    const BodyEnergy e = body.energy();
    REQUIRE(e.kinetic + e.elastic == Approx(0.5 * (mass - of_wall) * v * v).epsilon(1e-9));
    if (k == n) // all of the bar is pressed and at rest
      CHECK(e.elastic == Approx(0.5 * mass * v * v).epsilon(1e-9));
    body.drift(dt);
  }
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    REQUIRE(body.velocity()[3 * node + 2] == Approx(body.node_position()[node][2] == 0 ? 0 : v).margin(1e-9 * v));
  CHECK(impulse == Approx((2 * mass - of_wall) * v).epsilon(1e-9));
}

TEST_CASE("A slender bar with free sides is turned back by a wall in 2 L/c with c = sqrt(E/rho)", "[fe]")
{
  const Threads one(1);
  constexpr double length = 1, side = 0.1, v = 0.2;
  ExplicitBody body = block({{0, 0, 0}, {side, side, length}, {2, 2, 40}}, 0.3);
  const auto wall = body.prescribe_velocity(4u, 2);
  const double c = std::sqrt(1e7 / 1600), dt = 0.5 * stable_step(body).time_step;
  const double mass = mass_of(body);
  throw_down(body, v);
  double at_rest = 0, impulse = 0, before = momentum_of(body), worst = 0;
  for (double t = 0; t < 1.5 * length / c; t += dt)
  {
    body.compute_internal_force();
    body.kick(dt);
    impulse += body.reaction(wall) * dt;
    worst = std::max(worst, std::abs(body.energy().residual()));
    body.drift(dt);
    const double now = momentum_of(body);
    if (now >= 0 && at_rest == 0) // velocities belong to half steps
      at_rest = t + dt / 2 - dt * now / (now - before);
    before = now;
  }
  CAPTURE(at_rest * c / length, worst);
  // While the wave of sqrt(M/ρ) runs over the side and the sides give way, the wall presses harder by 0.16: that is
  // made good in the path.
  const double stiffer = p_wave_speed(body.material()) / c - 1;
  CHECK(at_rest == Approx(length / c).epsilon(stiffer * side / length));
  CHECK(before == Approx(impulse - mass * v).epsilon(1e-10));
  CHECK(worst < 1e-12 * 0.5 * mass * v * v);
}

TEST_CASE("A bar thrown against a floor that only pushes leaves it after 2 L/c with all of its energy", "[fe]")
{
  const Threads one(1);
  // Without lateral strain the bar has no vibration left. The discrete wave's front is h n^(1/3) wide after n elements
  // (Airy's function), which blurs duration and speed by n^(-2/3).
  constexpr int n = 200;
  constexpr double length = 1, v = 0.2;
  ExplicitBody body = block({{0, 0, 0}, {0.05, 0.05, length}, {1, 1, n}}, 0);
  const double c = std::sqrt(1e7 / 1600), area = 0.05 * 0.05;
  const Floor floor(body, 4 * 1e7 * area * n / length); // four times as stiff as an element
  const double dt = 0.5 * floor.stable_step(body), blur = std::pow(n, -2. / 3), mass = mass_of(body);
  throw_down(body, v);
  double impulse = 0, last_contact = 0;
  const int steps = std::ceil(3 * length / c / dt);
  for (int k = 0; k < steps; ++k)
  {
    body.compute_internal_force();
    const double force = floor.push(body);
    impulse += force * dt;
    if (force > 0)
      last_contact = k * dt;
    body.kick(dt);
    body.drift(dt);
  }
  const double rebound = momentum_of(body) / mass;
  CAPTURE(last_contact * c / length, rebound / v, impulse);
  CHECK(last_contact == Approx(2 * length / c).epsilon(blur));
  CHECK(rebound == Approx(v).epsilon(blur));
  CHECK(impulse == Approx(2 * mass * v).epsilon(blur));
  CHECK(momentum_of(body) == Approx(impulse - mass * v).epsilon(1e-10));
  CHECK(std::abs(body.energy().residual()) < 1e-12 * 0.5 * mass * v * v);
}

TEST_CASE("A block dropped on a soft floor rises to where it came from, but for what it keeps as vibration", "[fe]")
{
  const Threads one(1);
  // The floor's force is half a sine of Ω = sqrt(k/m). It leaves in mode j of a free bar, ω_j = jπc/L, at most the
  // share 8 (Ω/ω_j)⁴ of the energy (Timoshenko, Vibration Problems in Engineering, response to half a sine); Σ 1/j⁴ =
  // π⁴/90. In a step at either end of the contact, the leapfrog may miss the floor's share (Ω dt)²/2 of the energy.
  constexpr double height = 0.5, gravity = 9.81, length = 0.2, side = 0.1, softness = 0.1;
  ExplicitBody body = block({{0, 0, 0}, {side, side, length}, {2, 2, 4}}, 0.3, gravity);
  const double c = std::sqrt(1e7 / 1600), mass = mass_of(body), omega = softness * std::numbers::pi * c / length;
  const Floor floor(body, mass * omega * omega);
  const double dt = 0.1 * floor.stable_step(body);
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    body.displacement()[3 * node + 2] = height;
  throw_down(body, -0.5 * gravity * dt); // half a step before it is let go
  const auto middle = [&]
  {
    double sum = 0;
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      sum += body.mass()[3 * node + 2] * body.displacement()[3 * node + 2];
    return sum / mass;
  };
  double top = 0, contact = 0, sideways = 0;
  bool rising = false;
  for (double t = 0; t < 1 && (!rising || momentum_of(body) > 0); t += dt)
  {
    body.compute_internal_force();
    if (floor.push(body) > 0)
      contact += dt;
    body.kick(dt);
    body.drift(dt);
    rising = contact > 0 && (rising || momentum_of(body) > 0);
    if (rising)
      top = std::max(top, middle());
  }
  REQUIRE(momentum_of(body) <= 0);
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    for (int i = 0; i < 2; ++i)
      sideways += body.mass()[3 * node + i] * body.velocity()[3 * node + i];
  const BodyEnergy e = body.energy();
  const double whole = mass * gravity * height, lost = 1 - top / height;
  const double kept = 8 * std::pow(softness, 4) * std::pow(std::numbers::pi, 4) / 90, missed = std::pow(omega * dt, 2);
  CAPTURE(lost, kept, missed, e.external_work / whole, (e.kinetic + e.elastic) / whole, contact * omega);
  CHECK(lost < kept + missed);
  CHECK(lost > -missed);
  CHECK(std::abs(e.external_work) < missed * whole); // the floor gives back all it took
  CHECK(e.kinetic + e.elastic < (kept + missed) * whole);
  CHECK(std::abs(e.residual()) < 1e-12 * whole);
  CHECK(contact * omega == Approx(std::numbers::pi).epsilon(0.1));
  CHECK(std::abs(sideways) < 1e-12 * mass * std::sqrt(2 * gravity * height));
}
