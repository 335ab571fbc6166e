// Grains above the free surface of a mesh, where an overlap comes to it: they belong to the nearest place of the mesh,
// so that the weights of neighbours stay near one another.

#include "coupling/adapter/dealii_adapter.h"
#include "coupling/adapter/overlap_setup.h"
#include "dem/simulation/simulation.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <catch2/catch.hpp>
#include <deal.II/grid/tria.h>

#include <cmath>
#include <map>
#include <memory>

using namespace bergamo;

namespace
{

constexpr double edge = 2e-3, reach = 1e-3; // [m]

/// Three elements in a row; grains weigh 1 at x = 0 and nothing at the other end.
struct Row
{
  dealii::Triangulation<3> mesh;
  std::unique_ptr<fe::ExplicitBody> body;
  std::vector<double> weight;

  Row()
  {
    fe::make_box({{0., 0., 0.}, {3. * edge, edge, edge}, {3, 1, 1}}, mesh);
    fe::ExplicitBodyParameters parameters;
    parameters.material = fe::MohrCoulomb({.cohesion = 1e9});
    body = std::make_unique<fe::ExplicitBody>(mesh, parameters);
    for (const auto &x : body->node_position())
      weight.push_back(1. - x[0] / (3. * edge));
  }

  /// Weights of the grains that belong to the overlap, by their number.
  std::map<std::int64_t, double> weights(const std::vector<Vec3> &position, const double within) const
  {
    std::vector<std::int64_t> id(position.size());
    for (std::size_t i = 0; i < id.size(); ++i)
      id[i] = static_cast<std::int64_t>(i);
    const std::vector<double> volume(position.size(), 1e-10);
    const coupling::Overlap overlap = coupling::make_overlap(*body, id, position, volume, weight, within);
    const coupling::OverlapWeights weights(overlap, weight, 0.05);
    std::map<std::int64_t, double> by_id;
    for (std::size_t k = 0; k < overlap.n_particles(); ++k)
      by_id[overlap.particle_id[k]] = weights.particle[k];
    return by_id;
  }
};

} // namespace

TEST_CASE("grains above the free surface of an overlap have the weight of the nearest place, as far as it reaches")
{
  const Row row;
  const Vec3 inside(1.5 * edge, 0.5 * edge, 0.5 * edge);
  const std::vector<Vec3> places{inside,
                                 {1.2 * edge, 0.5 * edge, edge + 0.9 * reach},
                                 {2.7 * edge, 0.3 * edge, edge + 0.9 * reach},
                                 {1.2 * edge, 0.5 * edge, edge + 1.1 * reach},
                                 {3. * edge + 0.9 * reach, 0.5 * edge, 0.5 * edge},
                                 {3. * edge + 0.8 * reach, 0.5 * edge, edge + 0.8 * reach}};
  CHECK(row.weights(places, 0.) == std::map<std::int64_t, double>{{0, row.weights({inside}, 0.)[0]}});
  const auto found = row.weights(places, reach);
  REQUIRE(found.size() == 4);
  CHECK(found.at(0) == Approx(0.5).epsilon(1e-12));
  CHECK(found.at(1) == Approx(0.6).epsilon(1e-12));
  CHECK(found.at(2) == Approx(0.1).epsilon(1e-12));
  CHECK(found.at(4) == 0.05); // where grains weigh nothing, the least weight
}

TEST_CASE("grains beside the end of an overlap where they weigh 1 are left to grains alone")
{
  const Row row;
  const Vec3 inside(1.5 * edge, 0.5 * edge, 0.5 * edge);
  CHECK(row.weights({inside, {-0.1 * reach, 0.5 * edge, 0.5 * edge}}, reach).size() == 1);
}

TEST_CASE("places beside a mesh go with its nearest place into the reference configuration, as far as it reaches")
{
  const Row row;
  const Vec3 moved(1e-4, -2e-4, 3e-3); // further than the mesh reaches by itself
  const double stretch = 0.1;
  const auto displacement = row.body->displacement();
  for (std::size_t node = 0; node < row.body->n_nodes(); ++node)
    for (int d = 0; d < 3; ++d)
      displacement[3 * node + d] = moved[d] + (d == 0 ? stretch * row.body->node_position()[node][0] : 0.);
  const Vec3 nearest(1.5 * edge, 0.5 * edge, edge), above = Vec3(0., 0., 0.5 * reach);
  const Vec3 present = nearest + moved + Vec3(stretch * nearest[0], 0., 0.) + above;
  const double wide = moved[2] + 2. * reach; // the first look is at the present place
  const Vec3 found = coupling::reference_places(*row.body, std::vector{present}, wide)[0];
  CHECK((found - (nearest + above)).norm() < 1e-3 * edge); // the square of the gradient times the displacement
  CHECK(coupling::reference_places(*row.body, std::vector{present}, 0.)[0] == present);
}

TEST_CASE("a place in an absent element is in none, and goes with what is left of the mesh, as far as it reaches")
{
  const Row row;
  std::vector<double> weight;
  for (const auto &x : row.body->node_position())
    weight.push_back(x[0] < 1.5 * edge ? 1. : 0.);
  row.body->set_share(weight); // the first element is no more
  const double stretch = 0.1;
  for (std::size_t node = 0; node < row.body->n_nodes(); ++node)
    row.body->displacement()[3 * node] = stretch * row.body->node_position()[node][0];
  const std::vector<Vec3> places{{0.5 * edge, 0.5 * edge, 0.5 * edge}, {edge - 0.1 * reach, 0.5 * edge, 0.5 * edge}};
  const auto found = coupling::reference_places(*row.body, places, reach - stretch * edge);
  CHECK(found[0] == places[0]);
  CHECK((found[1] - (places[1] - Vec3(stretch * edge, 0., 0.))).norm() < 1e-12 * edge);
  CHECK(coupling::values_at(*row.body, places, row.body->displacement())[0] == Vec3::Zero());
}

TEST_CASE("a grain above the mesh asks its light neighbour for no shorter step, where it has that one's weight")
{
  // What touches a grain of weight 1 counts wholly: a spring k between masses m and w m swings at omega^2 = k (1 +
  // 1/w)/m, and between masses w m, of their weight, at 2 k/m. Each mode of the contact does, turns with them.
  const Row row;
  const double radius = 0.4 * reach;
  const Vec3 below(2.95 * edge, 0.5 * edge, edge - 0.1 * radius);
  const std::vector<Vec3> places{below, below + Vec3(0., 0., 1.999 * radius)};
  const auto stable_step = [&](const double within)
  {
    dem::SimulationParameters parameters;
    parameters.set_damping(0.);
    dem::Particles grains;
    for (const Vec3 &place : places)
      grains.add({Vec3::Constant(radius), 1., 1.}, parameters.grain().density, place, Quaternion::Identity());
    for (const auto &[id, weight] : row.weights(places, within))
      grains.weight[static_cast<std::size_t>(id)] = weight;
    dem::Simulation simulation(parameters, grains, {});
    simulation.compute_forces();
    REQUIRE(simulation.contacts.n_touching() == 1);
    return simulation.stable_time_step();
  };
  const double light = 0.05, of_equal_weights = stable_step(reach);
  CHECK(stable_step(0.) == Approx(of_equal_weights * std::sqrt(2. * light / (1. + light))).epsilon(1e-4));
}
