// Rigid bodies: their integrator, guides, bodies without a mesh, and nodes that are rigid where they lie.

#include "dem/core/error.h"
#include "fe_dealii/conditions/rigid_body.h"
#include "fe_dealii/conditions/rigid_boundary.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/rotation.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>
#include <vector>

using namespace bergamo;
using namespace bergamo::fe;
using Catch::Matchers::Contains;

namespace
{

using Vector = RigidBody::Vector;

/// 1 × 1 × 2 m.
ExplicitBody block(const Material &material, const unsigned int degree, const InitialStress &initial_stress = {})
{
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.degree = degree;
  parameters.initial_stress = initial_stress;
  return make_box_body({{0, 0, 0}, {1, 1, 2}, {2, 2, 4}}, parameters);
}

std::vector<unsigned int> all_nodes(const MovingBody &body)
{
  std::vector<unsigned int> nodes(body.n_nodes());
  std::iota(nodes.begin(), nodes.end(), 0u);
  return nodes;
}

/// A brick of 2 kg turned out of the axes, so that its inertia has products.
RigidBodyShape brick()
{
  RigidBodyShape shape;
  shape.inertia.mass = 2;
  shape.inertia.centre = {1, 2, 3};
  for (const double sign : {-1., 1.})
    for (const Vector arm : {Vector{0.3, 0.1, 0.05}, Vector{-0.1, 0.2, 0.1}, Vector{0.02, -0.1, 0.25}})
    {
      const Vector scaled{sign * arm[0], sign * arm[1], sign * arm[2]};
      shape.inertia.add_point(1. / 3, scaled);
      shape.vertices.push_back({1 + scaled[0], 2 + scaled[1], 3 + scaled[2]});
    }
  shape.triangles = {{0, 1, 2}, {3, 5, 4}};
  return shape;
}

double distance(const Vector &a, const Vector &b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

} // namespace

TEST_CASE("nodes become rigid where they lie, a settled top does not jump back", "[fe]")
{
  ExplicitBody body = block(LinearElastic({}), GENERATE(1u, 2u));
  for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
    body.displacement()[dof] = (dof % 3 == 2 ? -0.00391 : 0.001) * body.node_position()[dof / 3][2];
  const std::vector<double> before(body.displacement().begin(), body.displacement().end());
  RigidBoundary top(body, body.boundary_nodes(5), {.mass = 100, .centre = {0.5, 0.5, 2}, .inertia = {9, 9, 9}});
  CHECK(top.centre()[2] < 2);
  for (int k = 0; k < 3; ++k)
  {
    top.prescribe({}, {}, 1e-4);
    body.kick(1e-4);
    body.drift(1e-4);
  }
  for (const unsigned int node : body.boundary_nodes(5))
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(body.displacement()[3 * node + i] == Approx(before[3 * node + i]).margin(1e-15));
}

TEST_CASE("elements that are wholly rigid do not resist a rotation", "[fe]")
{
  const Material materials[] = {LinearElastic({.young_modulus = 1e7}), MohrCoulomb({}),
                                NeoHooke({.young_modulus = 1e7})};
  ExplicitBody body = block(materials[GENERATE(0, 1, 2)], GENERATE(1u, 2u));
  RigidBoundary rigid(body, all_nodes(body), {});
  CHECK(std::isinf(stable_step(body).time_step)); // nor do they set a step
  const double dt = 1e-3;
  rigid.prescribe({}, {0, 0, 1}, dt);
  for (int k = 0; k < 2000; ++k)
  {
    if (k > 0)
      rigid.move({}, {}, dt);
    body.kick(dt);
    body.drift(dt);
    body.compute_internal_force();
  }
  CHECK(rigid.angular_velocity()[2] == Approx(1).epsilon(1e-11));
  CHECK(rigid.angle() == Approx(2).epsilon(1e-11));
  CHECK(body.elements().elastic_energy() == 0);
}

TEST_CASE("what an initial stress exerts on a rigid body is the same with and without its own elements", "[fe]")
{
  const unsigned int degree = GENERATE(1u, 2u);
  const auto ground = [](const std::array<double, 3> &x)
  { return Stress{-2e3 * (2 - x[2]), -500, -1e4, 100, -50, 80}; };
  ExplicitBody body = block(LinearElastic({}), degree, ground);
  std::vector<unsigned int> upper;
  for (unsigned int node = 0; node < body.n_nodes(); ++node)
    if (body.node_position()[node][2] > 0.99)
      upper.push_back(node);
  body.compute_internal_force();
  double before[3] = {}, after[3] = {};
  for (const unsigned int node : upper)
    for (std::size_t i = 0; i < 3; ++i)
      before[i] += body.internal_force()[3 * node + i];
  const RigidBoundary rigid(body, upper, {});
  body.compute_internal_force();
  for (const unsigned int node : upper)
    for (std::size_t i = 0; i < 3; ++i)
      after[i] += body.internal_force()[3 * node + i];
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(after[i] == Approx(before[i]).margin(1e-9));
  CHECK(std::abs(before[2]) > 1e3);
}

TEST_CASE("a guided footing goes down under an eccentric load without turning", "[fe]")
{
  ExplicitBody body = block(LinearElastic({.young_modulus = 1e7}), 1);
  for (unsigned int i = 0; i < 3; ++i)
    body.prescribe_velocity(4u, i);
  RigidGuide guide;
  guide.velocity[0] = guide.velocity[1] = 0;
  guide.angular_velocity = {0., 0., 0.};
  RigidBoundary footing(body, body.boundary_nodes(5), {.mass = 1000, .centre = {0.5, 0.5, 2}, .guide = guide});
  const double dt = 0.3 * stable_step(body).time_step;
  for (int k = 0; k < 200; ++k)
  {
    body.compute_internal_force();
    footing.move({300, 0, -5e3}, {700, -900, 40}, dt);
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(footing.guide_moment()[i] == Approx(-footing.moment()[i] - Vector{700, -900, 40}[i]).margin(1e-6));
    CHECK(footing.guide_force()[0] == Approx(-300 - footing.force()[0]).margin(1e-6));
    body.kick(dt);
    body.drift(dt);
  }
  CHECK(footing.angle() < 1e-7);
  CHECK(footing.centre()[0] == Approx(0.5).epsilon(1e-13));
  CHECK(footing.centre()[2] < 2 - 1e-5);
}

TEST_CASE("a body without a mesh flies as a point and spins by Euler's equations, of second order", "[fe]")
{
  double drift[2];
  for (int k = 0; k < 2; ++k)
  {
    RigidBodyShape shape = brick();
    shape.gravity = {0, 0, -9.81};
    RigidBody body(shape);
    const double dt = 2e-3 / (k + 1);
    body.velocity() = {1, 0, 0.5 * dt * 9.81}; // at rest along z at time 0
    body.set_angular_velocity({3, -1, 2});
    const Vector momentum = body.angular_momentum();
    const double spinning = body.kinetic_energy() - body.velocity()[0] - std::pow(body.velocity()[2], 2);
    const double edge = distance(body.vertex(0), body.vertex(4));
    const int n = 500 * (k + 1);
    for (int step = 0; step < n; ++step)
    {
      body.clear_force();
      body.kick(dt);
      body.drift(dt);
    }
    CHECK(body.centre()[0] == Approx(1 + n * dt).epsilon(1e-12));
    CHECK(body.centre()[2] == Approx(3 - 0.5 * 9.81 * std::pow(n * dt, 2)).epsilon(1e-11));
    for (int i = 0; i < 3; ++i)
      CHECK(body.angular_momentum()[i] == Approx(momentum[i]).epsilon(1e-12));
    CHECK(distance(body.vertex(0), body.vertex(4)) == Approx(edge).epsilon(1e-12));
    const double now = body.kinetic_energy() - body.velocity()[0] - std::pow(body.velocity()[2], 2);
    drift[k] = std::abs(now - spinning) / spinning;
  }
  CHECK(drift[0] < 1e-2);
  CHECK(drift[1] < 0.6 * drift[0]); // the velocities given are those of a half step: of first order in the start
}

TEST_CASE("an axle: a moment turns a body about a guided axis by M t/I, its guides bear the rest", "[fe]")
{
  RigidBodyShape shape = brick();
  shape.guide.angular_velocity[0] = shape.guide.angular_velocity[1] = 0;
  RigidBody body(shape);
  const double dt = 1e-3;
  double largest = 0;
  for (int k = 1; k <= 1000; ++k)
  {
    body.clear_force();
    // 0.5 N at 0.2 m.
    body.add_force({0, 0.5, 0}, {body.centre()[0] + 0.2, body.centre()[1], body.centre()[2]});
    body.add_force({0, -0.5, 0}, body.centre());
    body.kick(dt);
    CHECK(body.angular_velocity()[2] == Approx(0.1 * k * dt / shape.inertia.inertia[2][2]).epsilon(1e-9));
    CHECK(body.angular_velocity()[0] == 0);
    largest = std::max(largest, std::abs(body.guide_moment()[0]));
    body.drift(dt);
  }
  CHECK(largest > 0.005); // its products of inertia pull at the axle
  CHECK(distance(body.centre(), {1, 2, 3}) < 1e-12);
}

TEST_CASE("guides that drive do the work, and gravity does its own", "[fe]")
{
  RigidBodyShape shape = brick();
  shape.gravity = {0, 0, -10};
  shape.guide.velocity[2] = 0.5; // a hoist
  RigidBody body(shape);
  body.velocity()[2] = 0.5;
  const double dt = 1e-2;
  for (int k = 0; k < 101; ++k)
  {
    body.clear_force();
    body.add_force({0, 0, -6}, body.centre()); // a load that it lifts
    body.kick(dt);
    if (k < 100)
      body.drift(dt);
  }
  CHECK(body.guide_force()[2] == Approx(26));
  CHECK(body.work() == Approx(0.5 * 1 * 6)); // what the guide does less what gravity takes
}

TEST_CASE("a body without a mesh goes on with the same bits, and refuses what it is not", "[fe]")
{
  RigidBody first(brick()), second(brick());
  first.set_angular_velocity({1, 2, 3});
  const auto step = [](RigidBody &body)
  {
    body.clear_force();
    body.add_force({1, 2, 3}, {0, 0, 0});
    body.kick(1e-3);
    body.drift(1e-3);
  };
  for (int k = 0; k < 20; ++k)
    step(first);
  const auto from = first.state(), to = second.state();
  for (std::size_t k = 0; k < from.size(); ++k)
    std::copy(from[k].second.begin(), from[k].second.end(), to[k].second.begin());
  for (int k = 0; k < 20; ++k)
  {
    step(first);
    step(second);
  }
  CHECK(first.vertex(2) == second.vertex(2));
  CHECK(first.angular_velocity() == second.angular_velocity());

  first.kick(1e-3);
  CHECK_THROWS_WITH(first.kick(1e-3), Contains("kicked twice"));
  CHECK_THROWS_WITH(first.drift(2e-3), Contains("kick with the same time step"));
  first.drift(1e-3);
  first.add_moment({std::nan(""), 0, 0});
  CHECK_THROWS_WITH(first.kick(1e-3), Contains("no finite numbers"));
  RigidBodyShape wrong = brick();
  wrong.triangles.push_back({0, 1, 6});
  CHECK_THROWS_WITH(RigidBody(wrong), Contains("vertex 6") && Contains("only 6"));
  wrong = brick();
  wrong.inertia.inertia[0][1] += 0.1;
  CHECK_THROWS_WITH(RigidBody(wrong), Contains("symmetric"));
  wrong = brick();
  wrong.inertia.inertia[0][0] = 1;
  CHECK_THROWS_WITH(RigidBody(wrong), Contains("at most the sum"));
  RigidBody massless{RigidBodyShape{}};
  CHECK_THROWS_WITH(massless.kick(1e-3), Contains("no mass"));
}

TEST_CASE("the element that has turned most is found with its angle", "[fe]")
{
  ExplicitBody body = block(LinearElastic({}), GENERATE(1u, 2u));
  const double angle = GENERATE(1e-5, 3., 40., 170.), radian = angle * std::acos(-1.) / 180;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const auto &[x, y, z] = body.node_position()[node];
    const double stretched = 1.3 * x;
    body.displacement()[3 * node] = std::cos(radian) * stretched - std::sin(radian) * y - x + 5;
    body.displacement()[3 * node + 1] = std::sin(radian) * stretched + std::cos(radian) * y - y;
  }
  const std::size_t lifted = body.element_nodes(3)[0];
  CHECK(greatest_rotation(body).angle == Approx(angle).epsilon(1e-6));
  body.displacement()[3 * lifted + 2] += 0.05;
  CHECK(greatest_rotation(body).angle > angle);
}
