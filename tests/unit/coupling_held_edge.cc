#include "coupling/arlequin/penalty.h"
#include "coupling/arlequin/weight.h"
#include "tests/unit/coupling_arlequin_block.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace bergamo;
using namespace bergamo::coupling;

namespace
{

/// Weights that grow linearly from 0 on one side of a block of n elements a side.
struct LinearWeights
{
  explicit LinearWeights(const Overlap &overlap, const int n) : length(0.009 * n)
  {
    // The block's third edge leans; the weights follow the plane of the other two.
    Eigen::Vector3d origin = overlap.node_position[0];
    normal = Eigen::Vector3d(0.010, 0., 0.001).cross(Eigen::Vector3d(0.002, 0.012, 0.)).normalized();
    length = normal.dot(overlap.node_position.back() - origin);
    for (const auto &x : overlap.node_position)
      node.push_back(std::clamp(normal.dot(x - origin) / length, 0., 1.));
    particle = particle_weights(overlap, node, 0.05);
    for (const auto &x : overlap.reference_position)
      distance.push_back(normal.dot(x - origin));
  }

  double length; ///< over which they grow [m]
  Eigen::Vector3d normal;
  std::vector<double> node, particle, distance; ///< the last: of the particles from the edge [m]
};

double mean_diameter(const Overlap &overlap)
{
  double sum = 0.;
  for (const double volume : overlap.particle_volume)
    sum += std::cbrt(6. * volume / std::numbers::pi);
  return sum / overlap.n_particles();
}

} // namespace

TEST_CASE("the grains held at an edge are those within its depth")
{
  const Overlap overlap = test::block(3, 40);
  const LinearWeights weights(overlap, 3);
  const double depth = GENERATE(0.5, 1.5, 3.);
  const HeldEdge edge(overlap, weights.node, weights.particle, {.depth = depth});
  std::vector<int> expected;
  for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
    if (weights.distance[particle] < depth * mean_diameter(overlap))
      expected.push_back(static_cast<int>(particle));
  REQUIRE(expected.size() > 10);
  CHECK(std::vector<int>(edge.particles().begin(), edge.particles().end()) == expected);
  CHECK(HeldEdge(overlap, weights.node, weights.particle, {.depth = 0.}).size() == 0);
}

TEST_CASE("springs and dead loads of a held edge are the gradient of their energy")
{
  const Overlap overlap = test::block(2, 20);
  const LinearWeights weights(overlap, 2);
  HeldEdge edge(overlap, weights.node, weights.particle, {.depth = 1., .stiffness = 1e12});
  REQUIRE(edge.size() > 5);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1e-6, 1e-6);
  const auto vector = [&] { return Eigen::Vector3d(uniform(random), uniform(random), uniform(random)); };
  std::vector<Eigen::Vector3d> difference(edge.size());
  for (auto &d : difference)
    d = vector();
  for (auto &load : edge.dead_load)
    load = 1e3 * vector();
  std::vector<double> fe(test::n_dofs(overlap));
  for (double &u : fe)
    u = uniform(random);
  std::vector<double> fe_force;
  const auto energy_and = [&](std::vector<Eigen::Vector3d> &force)
  {
    force.assign(edge.size(), Eigen::Vector3d::Zero());
    fe_force.assign(fe.size(), 0.);
    return edge.add_forces(difference, fe, force, fe_force, HeldEdge::Loads::all);
  };
  std::vector<Eigen::Vector3d> force, ignored;
  energy_and(force);
  const std::vector<double> on_nodes = fe_force;

  // The energy is quadratic: central differences of any width are exact but for rounding.
  for (std::size_t k = 0; k < edge.size(); ++k)
    for (int d = 0; d < 3; ++d)
    {
      constexpr double h = 1e-6;
      difference[k][d] += h;
      const double above = energy_and(ignored);
      difference[k][d] -= 2. * h;
      const double below = energy_and(ignored);
      difference[k][d] += h;
      CHECK(force[k][d] == Approx((below - above) / (2. * h)).epsilon(1e-6).margin(1e-9));
    }
  double largest_load = 0.;
  for (std::size_t dof = 0; dof < fe.size(); ++dof)
  {
    constexpr double h = 1e-6;
    fe[dof] += h;
    const double above = energy_and(ignored);
    fe[dof] -= 2. * h;
    const double below = energy_and(ignored);
    fe[dof] += h;
    CHECK(on_nodes[dof] == Approx((below - above) / (2. * h)).epsilon(1e-6).margin(1e-9));
    largest_load = std::max(largest_load, std::abs(on_nodes[dof]));
  }
  CHECK(largest_load > 1e-4);
  // A spring has the weight: w V k.
  const int first = edge.particles()[0];
  std::vector<Eigen::Vector3d> of_springs(edge.size());
  fe.assign(fe.size(), 0.);
  edge.add_forces(difference, fe, of_springs, fe_force, HeldEdge::Loads::springs);
  CHECK((of_springs[0] + 1e12 * weights.particle[first] * overlap.particle_volume[first] * difference[0]).norm() <
        1e-12 * of_springs[0].norm());
}

TEST_CASE("an edge that loses particles and becomes another one gives back the energy of those it lets go, once")
{
  Overlap overlap = test::block(3, 40);
  const LinearWeights weights(overlap, 3);
  HeldEdge edge(overlap, weights.node, weights.particle, {.depth = 3., .stiffness = 1e12});
  const std::vector<double> fe(test::n_dofs(overlap), 0.);
  std::vector<double> fe_force(fe.size());
  const auto energy_of = [&](HeldEdge &some, const Overlap &of)
  {
    std::vector<Eigen::Vector3d> difference, force(some.size());
    for (const std::int32_t particle : some.particles()) // each its own
      difference.emplace_back(1e-8 * static_cast<double>(of.particle_id[particle] + 1), 2e-7, 0.);
    return some.add_forces(difference, fe, force, fe_force, HeldEdge::Loads::all);
  };
  const double before = energy_of(edge, overlap);

  const std::size_t lost = edge.particles()[2]; // no longer in the overlap
  const auto erase = [&](auto &values, const std::size_t n)
  { values.erase(values.begin() + n * lost, values.begin() + n * (lost + 1)); };
  erase(overlap.particle_id, 1);
  erase(overlap.particle_volume, 1);
  erase(overlap.reference_position, 1);
  erase(overlap.shape_node, 8);
  erase(overlap.shape_value, 8);
  erase(overlap.shape_gradient, 8);
  overlap.shape_offset.pop_back();
  const double let_go =
      edge.renew(overlap, std::vector(overlap.n_particles(), Eigen::Vector3d(Eigen::Vector3d::Zero())));
  CHECK(let_go > 0.);
  const LinearWeights left(overlap, 3);
  std::vector<std::size_t> fresh;
  const std::size_t n_before = edge.size();
  const double given_up =
      edge.become(HeldEdge(overlap, left.node, left.particle, {.depth = 1., .stiffness = 1e12}), fresh);
  CHECK(fresh.empty());
  REQUIRE(edge.size() < n_before);
  CHECK(let_go + given_up + energy_of(edge, overlap) == Approx(before).epsilon(1e-12));
}

TEST_CASE("held edge: a spring slips at its strength, holds on from there, and books what the slip takes")
{
  const Overlap overlap = test::block(2, 20);
  const LinearWeights weights(overlap, 2);
  HeldEdge edge(overlap, weights.node, weights.particle, {.depth = 1., .stiffness = 1e15});
  REQUIRE(edge.size() > 5);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1e-2, 1e-2);
  for (auto &load : edge.dead_load)
    load = Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  const std::vector<double> fe(test::n_dofs(overlap), 0.);
  std::vector<double> unused(fe.size(), 0.);
  std::vector<Eigen::Vector3d> force(edge.size());
  // Pulled along a straight line and back: elastic to the strength, then all of the rest slips.
  const Eigen::Vector3d direction = Eigen::Vector3d(1., -2., 0.5).normalized();
  const auto energy_at = [&](const double way)
  {
    const std::vector<Eigen::Vector3d> displacement(edge.size(), way * direction);
    return edge.add_forces(displacement, fe, force, unused, HeldEdge::Loads::all);
  };
  constexpr double unit = 1e-7; // [m]
  energy_at(unit);
  std::vector<Eigen::Vector3d> spring(edge.size()); // at one unit
  for (std::size_t k = 0; k < edge.size(); ++k)
  {
    spring[k] = force[k] - edge.dead_load[k];
    edge.strength.push_back(2. * spring[k].norm());
  }
  energy_at(1.9 * unit);
  CHECK(edge.slip_loss() == 0.);
  const int n_steps = 1000;
  double work = 0., before = energy_at(2. * unit), at_start = before;
  for (int step = 1; step <= n_steps; ++step)
  {
    const std::vector<Eigen::Vector3d> earlier = force;
    before = energy_at((2. + 3. * step / n_steps) * unit);
    for (std::size_t k = 0; k < edge.size(); ++k)
      work -= 0.5 * (earlier[k] + force[k]).dot(direction) * 3. * unit / n_steps; // done on the edge
  }
  for (std::size_t k = 0; k < edge.size(); ++k)
    CHECK((force[k] - edge.dead_load[k] - 2. * spring[k]).norm() < 1e-9 * spring[k].norm());
  CHECK(edge.slip_loss() > 0.);
  CHECK(before - at_start + edge.slip_loss() == Approx(work).epsilon(1e-9));
  // Back by one unit: elastic, from where it has slipped to.
  const double lost = edge.slip_loss();
  energy_at(4. * unit);
  for (std::size_t k = 0; k < edge.size(); ++k)
    CHECK((force[k] - edge.dead_load[k] - spring[k]).norm() < 1e-9 * spring[k].norm());
  CHECK(edge.slip_loss() == lost);
}

TEST_CASE("the stable step of a coupling knows the stiffness of its edge and not its dead loads")
{
  // So stiff that it alone counts, on nodes that do not move: omega^2 = V k / m for each grain by itself.
  const Overlap overlap = test::block(1, 12);
  const LinearWeights weights(overlap, 1);
  HeldEdge edge(overlap, weights.node, weights.particle, {.depth = 2., .stiffness = 1e18});
  for (auto &load : edge.dead_load)
    load = Eigen::Vector3d(1e3, 2e3, 3e3);
  PenaltyCoupling coupling(overlap, Projection::lumped, 1e8);
  coupling.hold(edge);
  constexpr double density = 2650.;
  std::vector<double> mass;
  for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
    mass.push_back(density * weights.particle[particle] * overlap.particle_volume[particle]);
  const std::vector<double> fe_mass(test::n_dofs(overlap), 1.);
  const std::vector<std::uint8_t> fixed(test::n_dofs(overlap), 1);
  CHECK(coupling.stable_time_step({mass, fe_mass, fixed}) == Approx(2. / std::sqrt(1e18 / density)).epsilon(2e-3));
}

TEST_CASE("an edge that makes no sense is refused")
{
  const Overlap overlap = test::block(1, 12);
  const LinearWeights weights(overlap, 1);
  HeldEdge edge(overlap, weights.node, weights.particle, {.depth = 2.});
  std::vector<Eigen::Vector3d> force(edge.size());
  std::vector<double> fe(test::n_dofs(overlap), 0.), unused(fe.size(), 0.);
  const auto add_forces = [&] { edge.add_forces(force, fe, force, unused, HeldEdge::Loads::all); };
  edge.strength.assign(edge.size() - 1, 1.);
  CHECK_THROWS_WITH(add_forces(), Catch::Contains(std::to_string(edge.size() - 1) + " strengths"));
  edge.strength.clear();
  CHECK_NOTHROW(add_forces());
  edge.dead_load.pop_back();
  CHECK_THROWS_WITH(add_forces(), Catch::Contains(std::to_string(edge.size() - 1) + " dead loads"));

  CHECK_THROWS_WITH(EdgeParameters{.depth = -1.}.validate(), Catch::Contains("depth") && Catch::Contains("-1"));
  CHECK_THROWS_WITH(EdgeParameters{.stiffness = 0.}.validate(),
                    Catch::Contains("stiffness") && Catch::Contains("must be positive"));
  CHECK_THROWS_WITH(EdgeParameters{.strength = -1.}.validate(), Catch::Contains("strength") && Catch::Contains("-1"));
}
