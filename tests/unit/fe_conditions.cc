#include "dem/core/error.h"
#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/conditions/boundary_conditions.h"
#include "fe_dealii/conditions/quiet_boundary.h"
#include "fe_dealii/conditions/rigid_boundary.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <vector>

using namespace bergamo::fe;
using Catch::Contains;

namespace
{

ExplicitBody block(const std::array<unsigned int, 3> &n = {2, 2, 2}, const double damping = 0)
{
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 2, 3}, n}, mesh);
  ExplicitBodyParameters parameters;
  parameters.material = LinearElastic({.young_modulus = 1e6, .poisson_ratio = 0.3, .density = 1000});
  parameters.damping = damping;
  return ExplicitBody(mesh, parameters);
}

using Vector = RigidBoundary::Vector;

double distance(const ExplicitBody &body, const unsigned int a, const unsigned int b)
{
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double gap = body.node_position()[a][i] + body.displacement()[3 * a + i] - body.node_position()[b][i] -
                       body.displacement()[3 * b + i];
    square += gap * gap;
  }
  return std::sqrt(square);
}

} // namespace

TEST_CASE("functions of the time are read from their text", "[fe]")
{
  CHECK(TimeFunction("-0.01*min(t, 1)")(0.5) == Approx(-0.005));
  CHECK(TimeFunction("sin(pi*t)")(0.5) == Approx(1));
  CHECK(TimeFunction(0.1)(7) == 0.1);
  CHECK_THROWS_WITH(TimeFunction("2*u"), Contains("2*u") && Contains("of t in seconds"));
  CHECK_THROWS_WITH(TimeFunction("1/(t-1)")(1.), Contains("t = 1 s") && Contains("stays finite"));
}

TEST_CASE("functions of the time that would be read in another way than they are meant are refused", "[fe]")
{
  for (const char *text : {"0,5*t", "(0,5)*t", "t*(1,5)", "1, t", "min(0,5*t, 1)"})
    CHECK_THROWS_WITH(TimeFunction(text), Contains(std::string("'") + text + "'") && Contains("with a point"));
  for (const char *text : {"rand()", "0.1*rand()*t", "rand_seed(7)", "rand ()"})
    CHECK_THROWS_WITH(TimeFunction(text), Contains("differs from call to call"));
  CHECK_THROWS_WITH(TimeFunction("t=5"), Contains("assigns"));
  CHECK(TimeFunction("if(t<=1, 2, 3)")(1) == 2);
  CHECK(TimeFunction("if((t==1) || (t!=1), min(t, 0.5), 3)")(1) == 0.5);
  CHECK(TimeFunction("max(min(2*(t+1), 7), sin(t),1)")(1) == 4);
}

TEST_CASE("boundary conditions are read from their text", "[fe]")
{
  const BoundaryCondition lid = parse_condition("5 displacement z -0.01*min(t, 1)");
  CHECK(lid.boundary_id == 5);
  CHECK(lid.kind == ConditionKind::displacement);
  CHECK(lid.component == 2);
  CHECK(lid.value(2) == Approx(-0.01));
  const BoundaryCondition gas = parse_condition("1 pressure 1e5 + t");
  CHECK(gas.kind == ConditionKind::pressure);
  CHECK(gas.value(1) == 100001);
  CHECK_THROWS_WITH(parse_condition("top velocity x 0"), Contains("number of a boundary"));
  CHECK_THROWS_WITH(parse_condition("4294967301 velocity x 0"), Contains("4294967301 is no number of a boundary"));
  CHECK_THROWS_WITH(parse_condition("4294967295 velocity x 0"), Contains("no number of a boundary"));
  CHECK(parse_condition("4294967294 velocity x 0").boundary_id == 4294967294);
  CHECK_THROWS_WITH(parse_condition("1 speed x 0"), Contains("'speed'") && Contains("velocity"));
  CHECK_THROWS_WITH(parse_condition("1 traction w 0"), Contains("'w'"));
  CHECK_THROWS_WITH(parse_condition("1 traction x"), Contains("missing"));
  CHECK(parse_condition("2 quiet").kind == ConditionKind::quiet);
  CHECK(parse_condition("2 quiet").boundary_id == 2);
  CHECK_THROWS_WITH(parse_condition("2 quiet x 0"), Contains("nothing follows the word quiet") && Contains("'x 0'"));
}

TEST_CASE("boundaries move and are loaded as their functions say", "[fe]")
{
  ExplicitBody body = block();
  std::vector<BoundaryCondition> list;
  for (const char *text :
       {"4 displacement z 0.002*sin(3*t)", "5 velocity x 0.1*t", "1 traction y 200*t", "0 pressure 500*t"})
    list.push_back(parse_condition(text));
  BoundaryConditions conditions(body, std::move(list));
  const double dt = 0.5 * stable_step(body).time_step;
  double time = 0;
  for (int k = 0; k < 100; ++k, time += dt)
  {
    body.clear_external_force();
    conditions.apply(time, dt);
    double pull = 0;
    for (const unsigned int node : body.boundary_nodes(1))
      pull += body.external_force()[3 * node + 1];
    CHECK(pull == Approx(200 * time * 6).margin(1e-9)); // area 2 m × 3 m
    body.compute_internal_force();
    body.kick(dt);
    body.drift(dt);
  }
  for (const unsigned int node : body.boundary_nodes(4))
    CHECK(body.displacement()[3 * node + 2] == Approx(0.002 * std::sin(3 * time)).epsilon(1e-12));
  // The midpoint rule is exact for a velocity that grows linearly.
  for (const unsigned int node : body.boundary_nodes(5))
    CHECK(body.displacement()[3 * node] == Approx(0.05 * time * time).epsilon(1e-10));
  CHECK(std::isfinite(conditions.reaction(0)));
  // The pressure on the face x = 0 pushes along +x, on an area that hardly changes at small displacements.
  body.clear_external_force();
  conditions.apply(time, dt);
  double push = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    push += body.external_force()[3 * node];
  CHECK(push == Approx(500 * time * 6).epsilon(0.01));
  std::vector<BoundaryCondition> wrong;
  wrong.push_back(parse_condition("9 pressure 1"));
  CHECK_THROWS_WITH(BoundaryConditions(body, std::move(wrong)), Contains("no boundary 9"));
}

TEST_CASE("motions that would have no effect, or another one, are refused by name", "[fe]")
{
  const auto refusal = [](const std::vector<const char *> &texts) -> std::string
  {
    ExplicitBody body = block({1, 1, 1});
    std::vector<BoundaryCondition> list;
    for (const char *text : texts)
      list.push_back(parse_condition(text));
    try
    {
      BoundaryConditions(body, std::move(list));
    }
    catch (const bergamo::ConfigError &error)
    {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(refusal({"5 displacement z -0.01"}),
             Contains("'5 displacement z -0.01'") && Contains("begins with -0.01"));
  CHECK_THAT(refusal({"5 displacement z cos(t)"}), Contains("begins with 1 m"));
  CHECK(refusal({"5 displacement z 1-cos(t)"}).empty());
  CHECK_THAT(refusal({"5 velocity z 1", "4 velocity z 0", "5 displacement z t"}),
             Contains("'5 displacement z t'") && Contains("has '5 velocity z 1' along the same axis"));
  // One element: its sides hold all nodes of the bottom along x.
  CHECK_THAT(refusal({"0 velocity x 0", "1 velocity x 0", "4 velocity x 1"}),
             Contains("'4 velocity x 1'") && Contains("hold all nodes"));
  CHECK(refusal({"0 velocity x 0", "4 velocity x 1", "4 velocity y 1", "5 traction z 1", "5 traction z 2"}).empty());
  CHECK_THAT(refusal({"5 quiet", "5 quiet"}), Contains("'5 quiet'") && Contains("twice"));
  CHECK_THAT(refusal({"5 quiet", "5 velocity x 0", "5 velocity y 0", "5 velocity z 0"}),
             Contains("'5 quiet'") && Contains("along all axes"));
  CHECK_THAT(refusal({"9 quiet"}), Contains("no boundary 9"));
  CHECK(refusal({"5 quiet", "5 velocity x 0", "0 quiet", "1 quiet", "2 quiet", "3 quiet", "4 quiet"}).empty());
}

TEST_CASE("a quiet boundary takes rho c_p along its normal and rho c_s across it, on any face", "[fe]")
{
  const unsigned int degree = GENERATE(1u, 2u);
  const LinearElastic law({.young_modulus = 1e6, .poisson_ratio = 0.3, .density = 1000});
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 2, 3}, {2, 3, 2}, {1.5, 1, 2}}, mesh);
  dealii::GridTools::rotate(dealii::Tensor<1, 3>({0, 0, 1}), 0.4, mesh);
  dealii::GridTools::rotate(dealii::Tensor<1, 3>({1, 0, 0}), -0.7, mesh);
  ExplicitBodyParameters parameters;
  parameters.material = law;
  parameters.degree = degree;
  ExplicitBody body(mesh, parameters);
  const SurfaceLoad top(boundary_surface(body.dof_handler(), 5), body.node_position());
  std::vector<double> pull(3 * body.n_nodes(), 0.), none(pull.size(), 0.);
  top.add_pressure(-1, none, pull); // along the normal
  Vector normal{};
  for (std::size_t dof = 0; dof < pull.size(); ++dof)
    normal[dof % 3] += pull[dof] / 2; // 1 m x 2 m
  const Vector across{normal[1], -normal[0], 0};
  const std::vector<Dashpot> dashpots = quiet_boundary(body, 5);
  body.add_dashpots(dashpots);
  const double c_p = p_wave_speed(law), c_s = s_wave_speed(law);
  for (const auto &[along, speed] : {std::pair(normal, c_p), std::pair(across, c_s)})
  {
    for (std::size_t dof = 0; dof < pull.size(); ++dof)
      body.velocity()[dof] = along[dof % 3];
    for (const unsigned int node : body.boundary_nodes(5))
    {
      const Vector drag = body.drag(node);
      const double part = std::hypot(pull[3 * node], pull[3 * node + 1], pull[3 * node + 2]); // of the area
      for (int i = 0; i < 3; ++i)
        CHECK(drag[i] == Approx(1000 * speed * part * along[i]).margin(1e-9 * 1000 * c_p));
    }
  }
}

TEST_CASE("a rigid boundary follows its prescribed motion and keeps its distances at any rotation", "[fe]")
{
  ExplicitBody body = block();
  const std::vector<unsigned int> nodes = body.boundary_nodes(5);
  RigidBoundary plate(body, nodes, {});
  const Vector start = plate.centre();
  CHECK(start[2] == Approx(3));
  const double dt = 0.5 * stable_step(body).time_step;
  // A quarter turn about x, far beyond what the block would bear, with forces left out.
  const int n = 200;
  const double before = distance(body, nodes.front(), nodes.back());
  for (int k = 0; k < n; ++k)
  {
    plate.prescribe({0, 0, 0.1}, {0.5 * std::numbers::pi / (n * dt), 0, 0}, dt);
    body.kick(dt);
    body.drift(dt);
  }
  CHECK(distance(body, nodes.front(), nodes.back()) == Approx(before).epsilon(1e-13));
  for (const unsigned int node : nodes)
  {
    const double y = body.node_position()[node][1] - start[1], z = body.node_position()[node][2] - start[2];
    CHECK(body.node_position()[node][1] + body.displacement()[3 * node + 1] == Approx(start[1] - z).margin(1e-11));
    CHECK(body.node_position()[node][2] + body.displacement()[3 * node + 2] ==
          Approx(start[2] + 0.1 * n * dt + y).epsilon(1e-11));
  }
}

TEST_CASE("a free rigid body alone spins by Euler's equations and flies by Newton's", "[fe]")
{
  // So heavy that its nodes do not count, and internal forces left out. Torque-free motion keeps the kinetic energy.
  const auto nodes = block().boundary_nodes(5);
  RigidBodyParameters parameters{.mass = 1e13, .centre = {0.5, 1, 3}, .inertia = {2e12, 3e12, 4e12}};
  double drift[2];
  for (int k = 0; k < 2; ++k)
  {
    ExplicitBody free = block();
    RigidBoundary plate(free, nodes, parameters);
    const double dt = 1e-3 / (k + 1);
    plate.prescribe({1, 0, 0}, {3, 0.1, 2}, dt);
    free.kick(dt);
    free.drift(dt);
    const double energy = plate.kinetic_energy(), x = plate.centre()[0];
    const int n = 1000 * (k + 1);
    for (int step = 0; step < n; ++step)
    {
      plate.move({1e13, 0, 0}, {}, dt);
      free.kick(dt);
      free.drift(dt);
    }
    // x = v t + ½ t² and half a step of the leapfrog's start.
    CHECK(plate.centre()[0] - x == Approx(1 + 0.5 * (1 + dt)).epsilon(1e-8));
    const double translation = 0.5 * parameters.mass * std::pow(plate.velocity()[0], 2);
    drift[k] = std::abs(plate.kinetic_energy() - translation - (energy - 0.5 * parameters.mass)) / energy;
  }
  CHECK(drift[0] < 1e-5);
  CHECK(drift[1] < 0.3 * drift[0]); // second order
}

TEST_CASE("a rigid body beside its nodes turns about the centre of both, with the inertia of both", "[fe]")
{
  ExplicitBody body = block();
  const auto nodes = body.boundary_nodes(5);
  double of_nodes = 0;
  for (const unsigned int node : nodes)
    of_nodes += body.mass()[3 * node];
  const RigidBodyParameters own{.mass = 2 * of_nodes, .centre = {0.5, 2.5, 4}, .inertia = {300, 200, 100}};
  RigidBoundary plate(body, nodes, own);
  const Vector centre{0.5, (1 + 2 * 2.5) / 3, (3 + 2 * 4.) / 3}; // of the nodes' centre (0.5, 1, 3) and twice its own
  const auto about_x = [&](const double mass, const Vector &place)
  { return mass * (std::pow(place[1] - centre[1], 2) + std::pow(place[2] - centre[2], 2)); };
  double inertia = own.inertia[0] + about_x(own.mass, own.centre);
  for (const unsigned int node : nodes)
    inertia += about_x(body.mass()[3 * node], body.node_position()[node]);
  CHECK(plate.mass() == Approx(3 * of_nodes));
  for (int i = 0; i < 3; ++i)
    CHECK(plate.centre()[i] == Approx(centre[i]));
  constexpr double dt = 1e-6, moment = 50;
  plate.move({}, {moment, 0, 0}, dt);
  CHECK(plate.angular_velocity()[0] == Approx(moment * dt / inertia).epsilon(1e-9));
}

TEST_CASE("a rigid body on a block: energy is kept and a static load is carried", "[fe]")
{
  ExplicitBody body = block({2, 3, 4}, GENERATE(0., 60.));
  for (unsigned int i = 0; i < 3; ++i)
    body.prescribe_velocity(4u, i);
  const RigidBodyParameters parameters{.mass = 4000, .centre = {0.5, 1, 3.2}, .inertia = {900, 500, 1100}};
  RigidBoundary footing(body, body.boundary_nodes(5), parameters);
  const double dt = 0.3 * stable_step(body).time_step;
  const Vector load{0, 1e3, -5e4};
  double work = 0, largest = 0, greatest_force = 0;
  for (int k = 0; k < 6000; ++k)
  {
    body.compute_internal_force();
    const double kinetic_before = footing.kinetic_energy();
    const Vector before = footing.centre();
    footing.move(load, {}, dt);
    body.kick(dt);
    // At whole steps: kinetic energies of the half steps around them, work up to there.
    const double kinetic = 0.5 * (kinetic_before + footing.kinetic_energy());
    const BodyEnergy e = body.energy();
    largest = std::max(largest, std::abs(e.kinetic + kinetic + e.elastic + e.viscous_dissipation - work));
    greatest_force = std::max(greatest_force, std::abs(footing.force()[2] + load[2]));
    body.drift(dt);
    const Vector after = footing.centre();
    work += load[1] * (after[1] - before[1]) + load[2] * (after[2] - before[2]);
  }
  CAPTURE(body.damping(), largest, work, dt);
  // The mean of the energies before and after is above their product's by M Δv²/4 [J]; the damping of the footing's
  // nodes takes the speed before the kick, and misses α dt/2 of a loss that is at most the work.
  const double kick = dt * dt * greatest_force * greatest_force / (4 * parameters.mass);
  CHECK(largest < kick + 0.5 * body.damping() * dt * std::abs(work));
  if (body.damping() > 0) // settled: what the block bears is the load
  {
    CHECK(footing.force()[2] == Approx(-load[2]).epsilon(1e-2));
    CHECK(footing.force()[1] == Approx(-load[1]).margin(2e-2 * 5e4));
  }
}

TEST_CASE("rigid bodies of bad parameters are refused", "[fe]")
{
  ExplicitBody body = block();
  const auto nodes = body.boundary_nodes(5);
  CHECK_THROWS_WITH(RigidBoundary(body, nodes, {.mass = -1}), Contains("mass") && Contains("-1"));
  CHECK_THROWS_WITH(RigidBoundary(body, {}, {}), Contains("no nodes"));
  body.prescribe_velocity(5u, 0);
  CHECK_THROWS_WITH(RigidBoundary(body, nodes, {}), Contains("held by another condition"));
  const unsigned int beyond[] = {1000000};
  CHECK_THROWS_WITH(RigidBoundary(body, beyond, {}), Contains("does not exist"));
}
