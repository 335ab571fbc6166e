// Several bodies, a membrane, a rigid body and grains in one model: parts that nothing couples move as they do alone,
// and several overlaps keep the laws that one keeps.

#include "coupling/adapter/arlequin_coupling.h"
#include "coupling/adapter/dealii_adapter.h"
#include "coupling/model/model.h"
#include "dem/core/error.h"
#include "dem/loading/compression.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/state/positions_by_id.h"
#include "fe_dealii/membrane_body.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <catch2/catch.hpp>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace bergamo;
using namespace bergamo::coupling;

namespace
{

constexpr double edge = 0.006, layer = 0.002; // [m]
constexpr double time_step = 2.5e-7;          // [s], below the stable ones of all parts

/// Loose grains in a box, some of which meet.
std::unique_ptr<dem::Simulation> grains_in(const dem::Box &box, const bool has_walls, const unsigned int seed = 7)
{
  std::mt19937_64 generator(seed);
  const auto grains = dem::draw_grains(dem::GrainDistribution(), 0.2 * box.volume(), generator);
  dem::SimulationParameters parameters;
  parameters.time_step = time_step;
  auto simulation = std::make_unique<dem::Simulation>(parameters, dem::add_at_random(grains, box, 2650., generator()),
                                                      has_walls ? dem::box_walls(box) : std::vector<dem::PlaneWall>());
  std::uniform_real_distribution<double> uniform(-2., 2.);
  for (Vec3 &v : simulation->particles.velocity)
    v = Vec3(uniform(generator), uniform(generator), uniform(generator));
  return simulation;
}

std::unique_ptr<fe::ExplicitBody> body_in(const dem::Box &box, const std::array<unsigned int, 3> &n,
                                          const fe::Material &material)
{
  dealii::Triangulation<3> mesh;
  fe::make_box({{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}, n}, mesh);
  fe::ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.gravity = {0, 0, -9.81};
  auto body = std::make_unique<fe::ExplicitBody>(mesh, parameters);
  for (std::size_t dof = 0; dof < body->velocity().size(); ++dof)
    body->velocity()[dof] = 0.05 * std::sin(3. * dof);
  return body;
}

const fe::Material sand = fe::MohrCoulomb({.cohesion = 100});
const fe::Material strong = fe::MohrCoulomb({.cohesion = 1e9}); // elastic

std::unique_ptr<fe::MembraneBody> sheet()
{
  dealii::Triangulation<2> flat;
  dealii::GridGenerator::subdivided_hyper_rectangle(flat, {4, 4}, dealii::Point<2>(), dealii::Point<2>(edge, edge));
  dealii::Triangulation<2, 3> mesh;
  dealii::GridGenerator::flatten_triangulation(flat, mesh);
  fe::MembraneBodyParameters parameters;
  parameters.material = fe::Ogden({});
  auto body = std::make_unique<fe::MembraneBody>(mesh, parameters);
  for (std::size_t dof = 0; dof < body->velocity().size(); ++dof)
    body->velocity()[dof] = 0.3 * std::cos(2. * dof);
  return body;
}

const dem::Box middle{Vec3(0., 0., layer), Vec3(edge, edge, 2. * layer)};

std::vector<double> state_of(const fe::MovingBody &body)
{
  std::vector<double> state(body.displacement().begin(), body.displacement().end());
  state.insert(state.end(), body.velocity().begin(), body.velocity().end());
  return state;
}

std::vector<double> state_of(const dem::Simulation &grains)
{
  std::vector<double> state;
  for (const auto *vectors : {&grains.particles.position, &grains.particles.velocity})
    for (const Vec3 &x : *vectors)
      state.insert(state.end(), x.data(), x.data() + 3);
  return state;
}

void step_alone(fe::MovingBody &body)
{
  body.compute_internal_force();
  body.kick(time_step);
  body.drift(time_step);
}

/// 1 above the height, going down to 0 over a layer.
std::vector<double> weights_above(const fe::ExplicitBody &body, const double height)
{
  std::vector<double> weight;
  for (const auto &x : body.node_position())
    weight.push_back(std::clamp(1. + (x[2] - height) / layer, 0., 1.));
  return weight;
}

} // namespace

TEST_CASE("two bodies, a membrane, a rigid body and grains in one model move as they do alone, bit for bit")
{
  constexpr fe::RigidBodyParameters plate{1e-4, {0.003, 0.003, 0.004}, {1e-9, 1e-9, 1e-9}};
  Model model;
  auto &soft = model.add(std::make_unique<SolidMover>(body_in(middle, {3, 3, 1}, sand), "sand"));
  auto &grains = model.add(std::make_unique<GrainsMover>(grains_in(middle, true)));
  auto &hard = model.add(std::make_unique<SolidMover>(body_in(middle, {2, 2, 2}, strong), "rock"));
  auto &membrane = model.add(std::make_unique<BodyMover>(sheet(), "membrane"));
  auto &rigid = hard.hold(hard.body().boundary_nodes(5), plate);
  rigid.force = {0, 1e-3, -2e-2};

  const auto soft_alone = body_in(middle, {3, 3, 1}, sand), hard_alone = body_in(middle, {2, 2, 2}, strong);
  const auto sheet_alone = sheet();
  const auto grains_alone = grains_in(middle, true);
  fe::RigidBoundary rigid_alone(*hard_alone, hard_alone->boundary_nodes(5), plate);
  for (int k = 0; k < 400; ++k)
  {
    model.step(time_step);

    step_alone(*soft_alone);
    step_alone(*sheet_alone);
    grains_alone->step();
    hard_alone->compute_internal_force();
    rigid_alone.move({0, 1e-3, -2e-2}, {}, time_step);
    hard_alone->kick(time_step);
    hard_alone->drift(time_step);
  }
  CHECK(state_of(soft.body()) == state_of(*soft_alone));
  CHECK(state_of(hard.body()) == state_of(*hard_alone));
  CHECK(state_of(membrane.body()) == state_of(*sheet_alone));
  CHECK(state_of(grains.simulation()) == state_of(*grains_alone));
  CHECK(rigid.boundary.centre() == rigid_alone.centre());
  CHECK(membrane.energy().stored > 0.);
  CHECK(soft.energy().lost > 0.); // it flows
}

TEST_CASE("what an overlap does not touch keeps its bits beside it, and the overlap its own")
{
  const auto joined = [](Model &model)
  {
    const dem::Box above{Vec3(0., 0., layer), Vec3(edge, edge, 3. * layer)},
        below{Vec3(0., 0., 0.), Vec3(edge, edge, 2. * layer)};
    auto &grains = model.add(std::make_unique<GrainsMover>(grains_in(above, false)));
    auto &body = model.add(std::make_unique<SolidMover>(body_in(below, {3, 3, 2}, strong)));
    const std::vector<Vec3> reference = dem::positions_by_id(grains.simulation().particles);
    const std::vector<double> weight = weights_above(body.solid(), 2. * layer);
    model.add(std::make_unique<ArlequinCoupling>(grains, body, CouplingParameters(), OverlapPlace{weight, reference}));
    return std::pair(&grains, &body);
  };
  Model pair, crowd;
  const auto [pair_grains, pair_body] = joined(pair);
  auto &membrane = crowd.add(std::make_unique<BodyMover>(sheet(), "membrane"));
  const auto [crowd_grains, crowd_body] = joined(crowd);
  auto &other = crowd.add(std::make_unique<SolidMover>(body_in(middle, {2, 2, 2}, strong), "apart"));
  const auto sheet_alone = sheet();
  const auto other_alone = body_in(middle, {2, 2, 2}, strong);
  for (int k = 0; k < 300; ++k)
  {
    pair.step(time_step);
    crowd.step(time_step);
    step_alone(*sheet_alone);
    step_alone(*other_alone);
  }
  CHECK(state_of(crowd_grains->simulation()) == state_of(pair_grains->simulation()));
  CHECK(state_of(crowd_body->body()) == state_of(pair_body->body()));
  CHECK(state_of(membrane.body()) == state_of(*sheet_alone));
  CHECK(state_of(other.body()) == state_of(*other_alone));
}

TEST_CASE("a body between two packings: each overlap keeps the balance of forces, the body's share is what both leave")
{
  // Elements in four layers; grains over the two upper and over the two lower ones, each sharing one with the body.
  const dem::Box whole{Vec3(0., 0., 0.), Vec3(edge, edge, 4. * layer)};
  const dem::Box top{Vec3(0., 0., 3. * layer), Vec3(edge, edge, 5. * layer)};
  const dem::Box foot{Vec3(0., 0., -layer), Vec3(edge, edge, layer)};
  Model model;
  auto &body = model.add(std::make_unique<SolidMover>(body_in(whole, {3, 3, 4}, strong)));
  const double true_mass = std::accumulate(body.body().mass().begin(), body.body().mass().end(), 0.);
  auto &upper = model.add(std::make_unique<GrainsMover>(grains_in(top, false, 7), "upper grains"));
  auto &lower = model.add(std::make_unique<GrainsMover>(grains_in(foot, false, 8), "lower grains"));
  std::vector<double> weight = weights_above(body.solid(), 4. * layer);
  const std::vector<Vec3> upper_places = dem::positions_by_id(upper.simulation().particles),
                          lower_places = dem::positions_by_id(lower.simulation().particles);
  auto &over = model.add(std::make_unique<ArlequinCoupling>(upper, body, CouplingParameters(),
                                                            OverlapPlace{weight, upper_places}, "above"));
  CHECK_THROWS_WITH(ArlequinCoupling(upper, body, CouplingParameters(), {weight, upper_places}),
                    Catch::Contains("two overlaps"));
  for (std::size_t node = 0; node < weight.size(); ++node)
    weight[node] = std::clamp(1. - body.body().node_position()[node][2] / layer, 0., 1.);
  auto &under = model.add(std::make_unique<ArlequinCoupling>(lower, body, CouplingParameters(),
                                                             OverlapPlace{weight, lower_places}, "below"));
  // Each overlap takes half of a layer's mass, a quarter of the body's in all.
  CHECK(std::accumulate(body.body().mass().begin(), body.body().mass().end(), 0.) == Approx(0.75 * true_mass));

  for (int k = 0; k < 100; ++k)
    model.step(time_step);
  model.compute_forces();
  Vec3 sum = Vec3::Zero();
  double size = 0.;
  for (const GrainsMover *grains : {&upper, &lower})
    for (const Vec3 &force : grains->simulation().particles.external_force)
    {
      sum += force;
      size += force.norm();
    }
  const auto on_body = body.body().external_force();
  for (std::size_t dof = 0; dof < on_body.size(); ++dof)
    sum[dof % 3] += on_body[dof];
  CHECK(over.energy() > 0.);
  CHECK(under.energy() > 0.);
  CHECK(sum.norm() < 1e-13 * size);
  const StableSteps steps = model.stable_steps();
  CHECK(steps.movers[0].couplings.size() == 2);
  CHECK(steps.combined() < steps.couplings[0].step);
  CHECK_THROWS_WITH(model.step(2. * time_step), Catch::Contains("theirs is"));
}

TEST_CASE("grains and bodies may come to a model in any order: the same bits")
{
  // Grains over a body that shares a layer with them, and a second body.
  const auto end_of = [](const bool grains_come_first)
  {
    Model model;
    GrainsMover *grains = nullptr;
    SolidMover *body = nullptr, *other = nullptr;
    const auto add_grains = [&]
    {
      grains = &model.add(
          std::make_unique<GrainsMover>(grains_in({Vec3(0., 0., layer), Vec3(edge, edge, 3. * layer)}, false)));
    };
    const auto add_bodies = [&]
    {
      other = &model.add(std::make_unique<SolidMover>(
          body_in({Vec3(0., 0., 4. * layer), Vec3(edge, edge, 5. * layer)}, {2, 2, 1}, sand)));
      body = &model.add(
          std::make_unique<SolidMover>(body_in({Vec3(0., 0., 0.), Vec3(edge, edge, 2. * layer)}, {3, 3, 2}, strong)));
    };
    grains_come_first ? (add_grains(), add_bodies()) : (add_bodies(), add_grains());
    const std::vector<double> weight = weights_above(body->solid(), 2. * layer);
    const std::vector<Vec3> places = dem::positions_by_id(grains->simulation().particles);
    model.add(std::make_unique<ArlequinCoupling>(*grains, *body, CouplingParameters(), OverlapPlace{weight, places}));
    const double stable = model.stable_steps().combined();
    for (int k = 0; k < 300; ++k)
      model.step(time_step);
    std::vector<double> state = state_of(grains->simulation());
    for (const SolidMover *mover : {body, other})
    {
      const std::vector<double> of_body = state_of(std::as_const(*mover).body());
      state.insert(state.end(), of_body.begin(), of_body.end());
    }
    state.push_back(stable);
    return state;
  };
  const std::vector<double> one = end_of(true);
  CHECK(end_of(false) == one);
}
