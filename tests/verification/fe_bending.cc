// Beams of one element over the thickness, whatever the element's length: enhanced strains hold the field of pure
// bending on bricks, so what beam theory says is met but for the moment that an element takes for even.

#include "fe_dealii/element/small_strain_enhanced.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"
#include "tests/verification/fe_static.h"

#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace bergamo::fe;

namespace
{

constexpr double length = 40, young = 1e7, heavy = 1000; // thickness and width 1
constexpr double inertia = 1. / 12;

// Of the forces, what is lost to the rounding of displacements of the length: ε E L/((1 − 2ν) h P), 5e-10 at ν = 0.499.
constexpr double rounding = 1e-8;

/// Along x, bent in z; at its root held in x, in the middle of it across, so that it may narrow as it likes.
ExplicitBody beam(const Material &material, const unsigned int n_elements)
{
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.strains = Strains::enhanced;
  return make_box_body({{0, -0.5, -0.5}, {length, 0.5, 0.5}, {n_elements, 1, 1}}, parameters);
}

LinearElastic rubber(const double poisson_ratio)
{
  return LinearElastic({.young_modulus = young, .poisson_ratio = poisson_ratio, .density = heavy});
}

std::vector<unsigned int> end_nodes(const ExplicitBody &body)
{
  return body.boundary_nodes(1);
}

/// No turn about x: both nodes of the lower edge at the root rest on the same height, as do those at its sides.
std::map<unsigned int, double> held_root(const ExplicitBody &body, const double poisson_ratio, const double curvature)
{
  std::map<unsigned int, double> held;
  for (const unsigned int node : body.boundary_nodes(0))
  {
    const auto &[x, y, z] = body.node_position()[node];
    held[3 * node] = 0;
    // Where the field of pure bending about the beam's axis has them.
    held[3 * node + 1] = poisson_ratio * curvature * y * z;
    held[3 * node + 2] = 0.5 * curvature * poisson_ratio * (z * z - y * y);
  }
  return held;
}

/// Mean of a displacement component over the end.
double end_displacement(const ExplicitBody &body, const int component)
{
  double sum = 0;
  for (const unsigned int node : end_nodes(body))
    sum += body.displacement()[3 * node + component] / 4;
  return sum;
}

} // namespace

TEST_CASE("enhanced strains: pure bending is exact, one element over the thickness, of any length, at any volume",
          "[fe]")
{
  for (const double poisson_ratio : {0., 0.3, 0.499})
    for (const double ratio : {10., 5., 2.5, 1., 0.5})
    {
      CAPTURE(poisson_ratio, ratio);
      const unsigned int n = std::lround(length / ratio);
      ExplicitBody body = beam(rubber(poisson_ratio), n);
      constexpr double moment = 1e3, curvature = moment / (young * inertia);
      std::vector<double> load(3 * body.n_nodes(), 0.);
      for (const unsigned int node : end_nodes(body)) // two couples of arm 1
        load[3 * node] = body.node_position()[node][2] > 0 ? -moment / 2 : moment / 2;
      bring_to_rest(body, load, held_root(body, poisson_ratio, curvature), rounding);
      // The corners' deflection: that of the axis, and what the section's own shape adds, which is nothing at y² = z².
      CHECK(end_displacement(body, 2) == Approx(0.5 * curvature * length * length).epsilon(1e-6));
    }
}

TEST_CASE("enhanced strains: a cantilever's deflection is beam theory's less 1/4 n^2", "[fe]")
{
  // An element takes the moment at its middle for that of all of it: of P L³/3EI it misses the share 1/(4 n²). The
  // shear adds P L/(G A) with an even shear strain, where beam theory has 6/5 of it.
  for (const double poisson_ratio : {0.3, 0.499})
    for (const double ratio : {10., 5., 2.5, 1., 0.5})
    {
      CAPTURE(poisson_ratio, ratio);
      const unsigned int n = std::lround(length / ratio);
      ExplicitBody body = beam(rubber(poisson_ratio), n);
      constexpr double force = 10;
      std::vector<double> load(3 * body.n_nodes(), 0.);
      for (const unsigned int node : end_nodes(body))
        load[3 * node + 2] = force / 4;
      bring_to_rest(body, load, held_root(body, poisson_ratio, force * length / (young * inertia)), rounding);
      const double shear = young / (2 * (1 + poisson_ratio));
      const double bent = force * std::pow(length, 3) / (3 * young * inertia), sheared = force * length / shear;
      const double deflection = end_displacement(body, 2);
      CAPTURE(deflection / (bent + 1.2 * sheared));
      CHECK(deflection == Approx(bent * (1 - 0.25 / (n * n)) + sheared).epsilon(2e-3)); // the root is no free section
      CHECK(deflection == Approx(bent + 1.2 * sheared).epsilon(0.05));
    }
}

TEST_CASE("enhanced strains: a cantilever swings at the frequency of beam theory, its energy kept", "[fe]")
{
  // Ten elements of twice their thickness, length 20: Euler and Bernoulli's 1.8751² sqrt(EI/ρA L⁴), less what shear and
  // rotation of the sections take (about 3 (h/L)² = 0.7 %), within 2 %.
  ExplicitBodyParameters parameters;
  parameters.material = rubber(0.3);
  parameters.strains = Strains::enhanced;
  constexpr double span = 20;
  ExplicitBody body = make_box_body({{0, -0.5, -0.5}, {span, 0.5, 0.5}, {10, 1, 1}}, parameters);
  for (int i = 0; i < 3; ++i)
    body.prescribe_velocity(0u, i);
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const double x = body.node_position()[node][0] / span, b = 1.8751, s = 0.7341;
    body.velocity()[3 * node + 2] = std::cosh(b * x) - std::cos(b * x) - s * (std::sinh(b * x) - std::sin(b * x));
  }
  const double frequency = 1.8751 * 1.8751 * std::sqrt(young * inertia / heavy) / (span * span); // rad/s
  const double dt = 0.5 * stable_step(body).time_step, period = 2 * std::numbers::pi / frequency;
  std::vector<double> crossings;
  double before = 0, worst = 0, scale = 0;
  for (int k = 0; body.time() < 2.2 * period; ++k)
  {
    body.compute_internal_force();
    body.kick(dt);
    if (k > 0)
    {
      worst = std::max(worst, std::abs(body.energy().residual()));
      scale = std::max(scale, body.energy().elastic);
    }
    const double time = body.time();
    body.drift(dt);
    const double now = end_displacement(body, 2);
    if (k > 0 && before * now < 0)
      crossings.push_back(time + dt * before / (before - now));
    before = now;
  }
  REQUIRE(crossings.size() >= 4);
  CHECK(crossings[3] / 2 == Approx(period).epsilon(0.02));
  CHECK(worst < 1e-11 * scale);
}

TEST_CASE(
    "enhanced strains: one element over the thickness bends plastically at the moment of its two layers of points",
    "[fe]")
{
  // Without friction and under one stress alone the beam flows at 2c. Both layers of points, at ±1/√12 of the thickness
  // 1, flow at the same moment, b h 2c/√12 = 2c/3.46 (exactly, over the thickness: 2c/4). All of the material is bent
  // evenly, so nothing hardens.
  constexpr double cohesion = 1e3;
  const MohrCoulomb clay({.young_modulus = young,
                          .poisson_ratio = 0.3,
                          .friction_angle = 0,
                          .dilation_angle = 0,
                          .cohesion = cohesion,
                          .density = heavy});
  const double moment = 2 * cohesion / std::sqrt(12.), at_yield = moment / (young * inertia);
  for (const unsigned int n : {4u, 40u})
  {
    ExplicitBody body = beam(clay, n);
    auto &elements = dynamic_cast<SmallStrainEnhanced<MohrCoulomb> &>(body.elements());
    // The ends are turned against each other; both are free to move across, but for the rigid motions.
    for (const unsigned int node : body.boundary_nodes(0))
    {
      const unsigned int one[] = {node};
      const auto &[x, y, z] = body.node_position()[node];
      body.prescribe_velocity(one, 0, 0);
      if (y < 0 && z < 0)
      {
        body.prescribe_velocity(one, 1, 0);
        body.prescribe_velocity(one, 2, 0);
      }
      if (y > 0 && z < 0)
        body.prescribe_velocity(one, 2, 0);
    }
    std::vector<MovingBody::Constraint> upper, lower;
    for (const unsigned int node : end_nodes(body))
    {
      const unsigned int one[] = {node};
      const double z = body.node_position()[node][2];
      (z > 0 ? upper : lower).push_back(body.prescribe_velocity(one, 0, -z));
    }
    const auto moment_at = [&](const double curvature_now, const double curvature_before)
    {
      const double change = (curvature_now - curvature_before) * length;
      for (const auto c : upper)
        body.set_velocity(c, -change / 2);
      for (const auto c : lower)
        body.set_velocity(c, change / 2);
      find_equilibrium(body, {.tolerance = 1e-9, .duration = 1});
      double sum = 0;
      for (const auto c : upper)
        sum -= body.reaction(c);
      return sum;
    };
    CAPTURE(n);
    CHECK(moment_at(0.9 * at_yield, 0) == Approx(0.9 * moment).epsilon(1e-6));
    double curvature = 0.9;
    for (const double next : {1.2, 1.6, 2.5})
    {
      CAPTURE(next);
      CHECK(moment_at(next * at_yield, curvature * at_yield) == Approx(moment).epsilon(1e-6));
      curvature = next;
    }
    CHECK(elements.n_unbalanced() == 0);
    // Back: elastic.
    CHECK(moment_at(2 * at_yield, 2.5 * at_yield) == Approx(0.5 * moment).epsilon(1e-6));
  }
}
