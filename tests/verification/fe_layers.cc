// Bodies of several materials against closed forms: a settled column, a pulse at an interface; and a layered body of
// one material, which is the homogeneous one.

#include "dem/core/error.h"
#include "fe_dealii/equilibrium/static_equilibrium.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/mesh/material_box.h"
#include "fe_dealii/stable_step.h"
#include "tests/solid_shapes.h"
#include "tests/threads.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using namespace bergamo;
using namespace bergamo::fe;

namespace
{

constexpr double gravity = 9.81, everywhere = std::numeric_limits<double>::infinity();

const ElasticParameters soft{.young_modulus = 1e7, .poisson_ratio = 0.25, .density = 1500},
    hard{.young_modulus = 8e7, .poisson_ratio = 0.2, .density = 2400};

double modulus(const ElasticParameters &p)
{
  return p.bulk_modulus() + 4 * p.shear_modulus() / 3;
}

/// A box whose cells beyond a plane across an axis have the material id 7.
dealii::Triangulation<3> divided_box(const BoxMeshParameters &shape, const int axis, const double plane)
{
  dealii::Triangulation<3> mesh;
  make_box(shape, mesh);
  MaterialBox beyond{{-everywhere, -everywhere, -everywhere}, {everywhere, everywhere, everywhere}, 7};
  beyond.minimum[axis] = plane;
  set_material(beyond, mesh);
  return mesh;
}

} // namespace

TEST_CASE("a column of two layers settles as its weight and moduli say, whichever solver", "[fe]")
{
  // Hard below, soft above; u(z) = −∫ σ/M dz from the foot, nodal values exact in one dimension.
  ExplicitBodyParameters parameters;
  parameters.layers = {{0, LinearElastic(hard)}, {7, LinearElastic(soft)}};
  set_shape(parameters, GENERATE(Shape::plain, Shape::bending, Shape::quadratic));
  parameters.gravity = {0, 0, -gravity};
  EquilibriumParameters equilibrium;
  equilibrium.direct_limit = GENERATE(0, 100000);
  constexpr double interface = 3, height = 5;
  ExplicitBody body(divided_box({{0, 0, 0}, {1, 1, height}, {2, 2, 5}}, 2, interface), parameters);
  for (unsigned int id = 0; id < 5; ++id)
    body.prescribe_velocity(id, id / 2);
  find_equilibrium(body, equilibrium);
  const double above = soft.density * gravity * (height - interface);
  const auto exact = [&](const double z)
  {
    const double in_hard = std::min(z, interface), in_soft = z - in_hard;
    return -(above * in_hard + hard.density * gravity * in_hard * (interface - 0.5 * in_hard)) / modulus(hard) -
           soft.density * gravity * in_soft * (height - interface - 0.5 * in_soft) / modulus(soft);
  };
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    CHECK(body.displacement()[3 * node + 2] ==
          Approx(exact(body.node_position()[node][2])).margin(1e-8 * exact(height) * -1));
  double weight = 0, foot = 0;
  for (std::size_t dof = 2; dof < 3 * body.n_nodes(); dof += 3)
    weight += body.weight(dof);
  for (const unsigned int node : body.boundary_nodes(4))
    foot += body.reaction_force()[3 * std::size_t(node) + 2];
  CHECK(weight == Approx(-gravity * (3 * hard.density + 2 * soft.density)));
  CHECK(foot == Approx(-weight).epsilon(1e-8));
}

TEST_CASE("layered ground at rest under its K0 stress is in equilibrium as it is", "[fe]")
{
  ExplicitBodyParameters parameters;
  parameters.layers = {{0, LinearElastic(hard)}, {7, LinearElastic(soft)}};
  set_shape(parameters, GENERATE(Shape::plain, Shape::bending, Shape::quadratic));
  parameters.gravity = {0, 0, -gravity};
  const GeostaticStress ground{.surface_height = 5,
                               .unit_weight = soft.density * gravity,
                               .earth_pressure_at_rest = 0.6,
                               .deeper = {{3, hard.density * gravity}}};
  parameters.initial_stress = geostatic_stress(ground);
  ExplicitBody body(divided_box({{0, 0, 0}, {1, 1, 5}, {2, 2, 5}}, 2, 3), parameters);
  for (unsigned int id = 0; id < 5; ++id)
    body.prescribe_velocity(id, id / 2);
  const EquilibriumReport report = find_equilibrium(body);
  CHECK(report.residual.size() == 1); // nothing to do
  CHECK(report.residual[0] < 1e-13);
  GeostaticStress wrong = ground;
  wrong.deeper.push_back({3, 1e4});
  CHECK_THROWS_WITH(geostatic_stress(wrong), Catch::Contains("top of a layer") && Catch::Contains("= 3"));
}

TEST_CASE("a pulse passes an interface and comes back from it by the impedances", "[fe]")
{
  // Velocities: 2 Z1/(Z1 + Z2) on, (Z1 − Z2)/(Z1 + Z2) back; displacements of the same shares.
  const Threads one(1);
  constexpr double width = 0.1, middle = -0.6;
  ExplicitBodyParameters parameters;
  parameters.layers = {{0, LinearElastic(soft)}, {7, LinearElastic(hard)}};
  const double c1 = p_wave_speed(LinearElastic(soft)), c2 = p_wave_speed(LinearElastic(hard));
  const double z1 = soft.density * c1, z2 = hard.density * c2;
  double error[2];
  for (int k = 0; k < 2; ++k)
  {
    const unsigned int n = 60 << k;
    ExplicitBody body(divided_box({{-1.2, 0, 0}, {2.4, 0.1, 0.1}, {3 * n, 1, 1}}, 0, 0), parameters);
    for (unsigned int id = 2; id < 6; ++id)
      body.prescribe_velocity(id, id / 2);
    const auto pulse = [](const double distance) { return std::exp(-0.5 * std::pow(distance / width, 2)); };
    const auto shift = [](const double distance)
    { return width * std::sqrt(std::numbers::pi / 2) * std::erfc(distance / (std::numbers::sqrt2 * width)); };
    const int steps = std::ceil(2 * -middle / c1 / (0.5 * stable_step(body).time_step));
    const double dt = 2 * -middle / c1 / steps; // what came back is where the pulse began
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const double distance = body.node_position()[node][0] - middle;
      body.displacement()[3 * node] = shift(distance) / c1;
      body.velocity()[3 * node] = (shift(distance) - shift(distance + c1 * dt)) / (c1 * dt);
    }
    for (int step = 0; step < steps; ++step)
    {
      body.compute_internal_force();
      body.kick(dt);
      body.drift(dt);
    }
    double square = 0, whole = 0;
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const double x = body.node_position()[node][0];
      // Half a step before the end. What goes on is stretched by c2/c1.
      const double back = (z1 - z2) / (z1 + z2) * pulse(x - middle - 0.5 * c1 * dt),
                   on = 2 * z1 / (z1 + z2) * pulse((x + 0.5 * c2 * dt) * c1 / c2 + middle);
      square += std::pow(body.velocity()[3 * node] - (x < 0 ? back : on), 2);
      whole += std::pow(x < 0 ? back : on, 2);
    }
    error[k] = std::sqrt(square / whole);
  }
  CAPTURE(error[0], error[1]);
  CHECK(error[1] < 0.02);
  CHECK(std::log2(error[0] / error[1]) == Approx(2).margin(0.2));
}

TEST_CASE("a layered body of equal materials is the homogeneous one, bit for bit", "[fe]")
{
  const MohrCoulomb sand({.young_modulus = 1e6,
                          .friction_angle = 25,
                          .dilation_angle = 5,
                          .cohesion = 500,
                          .density = 1700,
                          .reference_pressure = 1e4,
                          .stiffness_exponent = 0.5});
  const NeoHooke rubber({.young_modulus = 1e5, .poisson_ratio = 0.4, .density = 1100});
  HypoplasticParameters hochstetten;
  hochstetten.initial_void_ratio = 0.7;
  const Material material = GENERATE_COPY(Material(sand), Material(rubber), Material(HypoplasticSand(hochstetten)));
  ExplicitBodyParameters parameters;
  const Shape shape = GENERATE(Shape::plain, Shape::bending, Shape::quadratic);
  set_shape(parameters, shape);
  const int n_steps = shape == Shape::quadratic ? 30 : 100; // 27 points cost some ten times as much
  parameters.gravity = {0, 0, -gravity};
  parameters.damping = 3;
  if (!std::holds_alternative<NeoHooke>(material))
    parameters.initial_stress = uniform_pressure(2e3);
  dealii::Triangulation<3> mesh = divided_box({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, 1, 0.3); // no full packs
  if (GENERATE(false, true)) // deal.II computes the geometry of equal cells once
    dealii::GridTools::distort_random(0.2, mesh, true, 3);
  ExplicitBodyParameters layered = parameters;
  parameters.material = material;
  layered.layers = {{0, material}, {7, material}};
  ExplicitBody one(mesh, parameters), two(mesh, layered);
  const double dt = 0.4 * stable_step(one).time_step;
  CHECK(stable_step(two).time_step == stable_step(one).time_step);
  for (ExplicitBody *body : {&one, &two})
  {
    body->prescribe_velocity(4u, 2);
    body->prescribe_velocity(5u, 2, -0.3);
    for (int k = 0; k < n_steps; ++k)
    {
      body->compute_internal_force();
      body->kick(dt);
      body->drift(dt);
    }
    body->compute_internal_force();
  }
  const auto same = [](const auto &a, const auto &b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); };
  CHECK(same(one.displacement(), two.displacement()));
  CHECK(same(one.velocity(), two.velocity()));
  CHECK(same(one.internal_force(), two.internal_force()));
  for (std::size_t e = 0; e < one.n_elements(); ++e)
    CHECK(one.state_of(e).stress == two.state_of(e).stress);
  const BodyEnergy a = one.energy(), b = two.energy();
  CHECK((a.plastic_dissipation > 0) != std::holds_alternative<NeoHooke>(material)); // else nothing has flowed
  CHECK(a.kinetic == b.kinetic);
  CHECK(a.elastic == Approx(b.elastic).epsilon(1e-12));
  CHECK(a.plastic_dissipation == Approx(b.plastic_dissipation).epsilon(1e-12));
  CHECK(a.stiffness_loss == Approx(b.stiffness_loss).epsilon(1e-10));
}

TEST_CASE("layers of more elements than are computed at a time are the homogeneous body, where packs end in between",
          "[fe]")
{
  ExplicitBodyParameters parameters;
  parameters.kind.hourglass = Hourglass::bending;
  parameters.material = LinearElastic(soft);
  parameters.gravity = {0, 0, -gravity};
  const dealii::Triangulation<3> mesh = divided_box({{0, 0, 0}, {1, 1, 1}, {5, 5, 6}}, 0, 0.3); // 60 and 90 elements
  ExplicitBodyParameters layered = parameters;
  layered.layers = {{0, parameters.material}, {7, parameters.material}};
  ExplicitBody one(mesh, parameters), two(mesh, layered);
  for (ExplicitBody *body : {&one, &two})
  {
    for (std::size_t dof = 0; dof < 3 * body->n_nodes(); ++dof)
      body->displacement()[dof] = 1e-3 * std::sin(5. * dof);
    body->compute_internal_force();
  }
  for (std::size_t dof = 0; dof < 3 * one.n_nodes(); ++dof)
    CHECK(two.internal_force()[dof] == one.internal_force()[dof]);
}

TEST_CASE("layers of one material come to rest as the homogeneous body, bit for bit, where flow is not associated",
          "[fe]")
{
  const MohrCoulomb sand(
      {.young_modulus = 2e7, .poisson_ratio = 0.3, .friction_angle = 30, .dilation_angle = 5, .cohesion = 1e3});
  ExplicitBodyParameters parameters;
  set_shape(parameters, GENERATE(Shape::plain, Shape::bending));
  parameters.initial_stress = [](const std::array<double, 3> &) { return Stress{-5e4, -6e4, -1e5, 0, 0, 0}; };
  ExplicitBodyParameters layered = parameters;
  parameters.material = sand;
  layered.layers = {{0, sand}, {7, sand}};
  const dealii::Triangulation<3> mesh = divided_box({{0, 0, 0}, {2, 1, 1}, {3, 2, 2}}, 2, 0.5);
  ExplicitBody one(mesh, parameters), two(mesh, layered);
  EquilibriumParameters equilibrium;
  equilibrium.duration = 1;
  equilibrium.direct_limit = 0; // the solver goes by the symmetry of the tangent; its preconditioner is of one level
  for (ExplicitBody *body : {&one, &two})
  {
    for (unsigned int i = 0; i < 3; ++i)
      body->prescribe_velocity(4u, i);
    body->prescribe_velocity(5u, 0, 0.02);
    for (unsigned int i = 1; i < 3; ++i)
      body->prescribe_velocity(5u, i);
    for (unsigned int side = 0; side < 4; ++side)
      body->prescribe_velocity(side, side / 2);
    find_equilibrium(*body, equilibrium);
  }
  double flow = 0;
  for (std::size_t e = 0; e < one.n_elements(); ++e)
    flow = std::max(flow, one.state_of(e).plastic_strain);
  CHECK(flow > 1e-3);
  CHECK(std::equal(one.displacement().begin(), one.displacement().end(), two.displacement().begin()));
  layered.layers.at(0) = LinearElastic(hard);
  CHECK(!ExplicitBody(mesh, layered).elements().has_symmetric_tangent()); // one layer's is not
}

TEST_CASE("a body of layers goes on from its state, laws of large and small strain side by side", "[fe]")
{
  const Shape shape = GENERATE(Shape::plain, Shape::bending, Shape::quadratic);
  const auto make = [&]
  {
    ExplicitBodyParameters parameters;
    set_shape(parameters, shape);
    parameters.layers = {{0, MohrCoulomb({.young_modulus = 1e6, .friction_angle = 30, .cohesion = 100})},
                         {7, NeoHooke({.young_modulus = 1e5, .poisson_ratio = 0.4, .density = 1100})}};
    parameters.gravity = {0, 0, -gravity};
    ExplicitBody body(divided_box({{0, 0, 0}, {1, 1, 2}, {2, 2, 4}}, 2, 1), parameters);
    body.prescribe_velocity(4u, 2);
    return body;
  };
  const auto run = [](ExplicitBody &body, const int n)
  {
    for (int k = 0; k < n; ++k)
    {
      body.compute_internal_force();
      body.kick(1e-3);
      body.drift(1e-3);
    }
  };
  ExplicitBody whole = make(), first = make(), second = make();
  REQUIRE(1e-3 < stable_step(whole).time_step);
  run(whole, 200);
  run(first, 100);
  const auto from = first.state(), to = second.state();
  for (std::size_t k = 0; k < from.size(); ++k)
    std::copy(from[k].second.begin(), from[k].second.end(), to[k].second.begin());
  run(second, 100);
  const auto ends = whole.state(), found = second.state();
  for (std::size_t k = 0; k < ends.size(); ++k)
    CHECK(std::equal(ends[k].second.begin(), ends[k].second.end(), found[k].second.begin()));
  CHECK(whole.energy().plastic_dissipation > 0);
}

TEST_CASE("an element of a layer that turns inside out is named by its number in the body", "[fe]")
{
  ExplicitBodyParameters parameters;
  set_shape(parameters, GENERATE(Shape::plain, Shape::bending));
  const NeoHooke rubber({.young_modulus = 1e5, .poisson_ratio = 0.4, .density = 1100});
  parameters.layers = {{0, LinearElastic(soft)}, {7, rubber}};
  ExplicitBody body(divided_box({{0, 0, 0}, {1, 1, 5}, {1, 1, 5}}, 2, 2), parameters);
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    if (body.node_position()[node][2] > 3.5)
      body.displacement()[3 * node + 2] = -1.5; // the element from 3 to 4 m
  CHECK_THROWS_WITH(body.compute_internal_force(),
                    Catch::Contains("element 3 at (0.5, 0.5,") && Catch::Contains("turned inside out"));
}

TEST_CASE("a rigid part of a layered body does not resist its rotation", "[fe]")
{
  ExplicitBodyParameters parameters;
  set_shape(parameters, GENERATE(Shape::plain, Shape::bending));
  parameters.layers = {{0, LinearElastic(soft)}, {7, LinearElastic(hard)}};
  ExplicitBody body(divided_box({{0, 0, 0}, {1, 1, 4}, {1, 1, 4}}, 2, 2), parameters);
  std::vector<unsigned int> upper;
  for (unsigned int node = 0; node < body.n_nodes(); ++node)
    if (body.node_position()[node][2] > 1.5)
      upper.push_back(node);
  body.make_rigid(upper);
  for (std::size_t node = 0; node < body.n_nodes(); ++node) // half a turn about x, without strain at small rotations
  {
    body.displacement()[3 * node + 1] = -2 * body.node_position()[node][1];
    body.displacement()[3 * node + 2] = -2 * body.node_position()[node][2];
  }
  body.compute_internal_force();
  for (std::size_t e = 0; e < 4; ++e)
  {
    CHECK(body.elements().is_rigid(e) == (e >= 2));
    CHECK((body.state_of(e).stress == Stress{}) == (e >= 2));
  }
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    if (body.node_position()[node][2] > 2.5)
      for (std::size_t i = 0; i < 3; ++i)
        CHECK(body.internal_force()[3 * node + i] == 0);
}

TEST_CASE("layers that do not fit the mesh are refused by their ids", "[fe]")
{
  using Catch::Contains;
  const LinearElastic rock(hard);
  const dealii::Triangulation<3> mesh = divided_box({{0, 0, 0}, {1, 1, 1}, {1, 1, 4}}, 2, 0.5);
  const auto refusal = [&](const std::map<unsigned int, Material> &layers) -> std::string
  {
    ExplicitBodyParameters parameters;
    parameters.layers = layers;
    try
    {
      ExplicitBody(mesh, parameters);
    }
    catch (const ConfigError &error)
    {
      return error.what();
    }
    return "";
  };
  CHECK(refusal({{0, rock}, {7, rock}}).empty());
  CHECK_THAT(refusal({{0, rock}}),
             Contains("cell 2 at (0.5 0.5 0.625) m has the material id 7, which has no material") &&
                 Contains("beside those of 0"));
  CHECK_THAT(refusal({{0, rock}, {7, rock}, {3, rock}}), Contains("for the id 3") && Contains("no cell"));
  dealii::Triangulation<3> box;
  make_box({}, box);
  CHECK_THROWS_WITH(set_material({{2, 0, 0}, {3, 1, 1}, 5}, box),
                    Contains("material id 5") && Contains("(2, 0, 0) to (3, 1, 1)") && Contains("no cell's centre"));
  CHECK_THROWS_WITH(set_material({{0, -2, 0}, {1, -1, 1}, 5}, box), Contains("no cell's centre"));
  CHECK_THROWS_WITH(set_material({{0, 1, 0}, {1, 1, 1}, 5}, box), Contains("along y") && Contains("from 1 to 1"));
}
