// What is done element by element, beside the sums over shape values and gradients that it stands for.

#include "coupling/arlequin/element_blocks.h"
#include "coupling/arlequin/penalty.h"
#include "coupling/arlequin/weight.h"
#include "coupling/arlequin/weight_transfer.h"
#include "tests/unit/coupling_arlequin_block.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>

using namespace bergamo::coupling;
using Vectors = std::vector<Eigen::Vector3d>;

namespace
{

Vectors random_vectors(const std::size_t n, const unsigned seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  Vectors vectors(n);
  for (auto &v : vectors)
    v = Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  return vectors;
}

double largest_difference(const Vectors &a, const Vectors &b)
{
  double largest = 0.;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

/// The particles of an overlap in another order.
Overlap shuffled(const Overlap &overlap)
{
  std::vector<std::size_t> order(overlap.n_particles());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(6));
  Overlap other = overlap;
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    other.particle_id[k] = overlap.particle_id[order[k]];
    other.particle_volume[k] = overlap.particle_volume[order[k]];
    other.reference_position[k] = overlap.reference_position[order[k]];
    std::copy_n(overlap.shape_node.begin() + 8 * order[k], 8, other.shape_node.begin() + 8 * k);
    std::copy_n(overlap.shape_value.begin() + 8 * order[k], 8, other.shape_value.begin() + 8 * k);
    std::copy_n(overlap.shape_gradient.begin() + 8 * order[k], 8, other.shape_gradient.begin() + 8 * k);
  }
  return other;
}

/// Overlaps that differ in what blocks are: some to an element, one to each particle, and skewed elements.
Overlap any_overlap()
{
  const int kind = GENERATE(0, 1, 2, 3);
  CAPTURE(kind);
  return kind == 0   ? test::block(2, 9)
         : kind == 1 ? test::block(1, 2 * static_cast<int>(ElementBlocks::longest) + 44)
         : kind == 2 ? shuffled(test::distorted(test::block(2, 9)))
                     : test::distorted(test::block(2, 30));
}

/// Calls visit(particle, node, value, gradient) for all shape functions of all particles.
template <class Visit>
void for_each_shape(const Overlap &overlap, const Visit &visit)
{
  for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
    for (std::size_t k = overlap.shape_offset[particle]; k < overlap.shape_offset[particle + 1]; ++k)
      visit(particle, overlap.shape_node[k], overlap.shape_value[k], overlap.shape_gradient[k]);
}

} // namespace

TEST_CASE("fields at particles and sums at nodes are those of the shape values")
{
  const Overlap overlap = any_overlap();
  CHECK_NOTHROW(overlap.validate());
  const ElementBlocks blocks(overlap);
  const Vectors at_nodes = random_vectors(overlap.n_nodes(), 1),
                at_particles = random_vectors(overlap.n_particles(), 2);
  Vectors field(overlap.n_particles(), Eigen::Vector3d::Zero()), sums(overlap.n_nodes(), Eigen::Vector3d::Zero());
  for_each_shape(overlap,
                 [&](const std::size_t particle, const int node, const double n, const Eigen::Vector3d &)
                 {
                   field[particle] += n * at_nodes[node];
                   sums[node] += n * at_particles[particle];
                 });
  Vectors by_blocks(overlap.n_particles());
  blocks.interpolate(at_nodes, by_blocks);
  CHECK(largest_difference(by_blocks, field) < 1e-15 * 8);
  by_blocks.resize(overlap.n_nodes());
  blocks.collect(at_particles, by_blocks);
  CHECK(largest_difference(by_blocks, sums) < 1e-16 * static_cast<double>(overlap.n_particles()));
}

TEST_CASE("a transfer gives the nodes N f + t x grad N / 2 with the gradients at the particles, and balances")
{
  const Overlap overlap = any_overlap();
  const Vectors force = random_vectors(overlap.n_particles(), 3);
  Vectors torque = random_vectors(overlap.n_particles(), 4);
  for (auto &t : torque)
    t *= 3e-3; // as large as what forces make of an element's size
  Vectors expected(overlap.n_nodes(), Eigen::Vector3d::Zero());
  for_each_shape(overlap, [&](const std::size_t particle, const int node, const double n, const Eigen::Vector3d &grad)
                 { expected[node] -= n * force[particle] + 0.5 * torque[particle].cross(grad); });
  std::vector<double> fe_force(test::n_dofs(overlap), 0.);
  WeightTransfer(std::make_shared<const ElementBlocks>(overlap), overlap.nodes).add_opposite(force, torque, fe_force);
  Vectors given;
  for (const int node : overlap.nodes)
    given.push_back(Eigen::Map<Eigen::Vector3d>(&fe_force[3 * static_cast<std::size_t>(node)]));
  CHECK(largest_difference(given, expected) < 1e-15 * static_cast<double>(overlap.n_particles()));

  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = sum;
  double size = 0., turning = 0.;
  for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
  {
    const Eigen::Vector3d m = overlap.reference_position[particle].cross(force[particle]) + torque[particle];
    sum += force[particle];
    moment += m;
    size += force[particle].norm();
    turning += m.norm();
  }
  for (std::size_t node = 0; node < overlap.n_nodes(); ++node)
  {
    sum += given[node];
    moment += overlap.node_position[node].cross(given[node]);
  }
  CHECK(sum.norm() < 1e-14 * size);
  CHECK(moment.norm() < 1e-14 * turning);
}

TEST_CASE("the penalty's energy is that of the difference's coarse part, and its forces are the gradient")
{
  constexpr double penalty = 1e14;
  const Overlap overlap = any_overlap();
  const auto kind = GENERATE(Projection::lumped, Projection::consistent);
  const auto n_nodes = static_cast<Eigen::Index>(overlap.n_nodes()),
             n_particles = static_cast<Eigen::Index>(overlap.n_particles());
  Eigen::MatrixXd shape = Eigen::MatrixXd::Zero(n_nodes, n_particles);
  for_each_shape(overlap, [&](const std::size_t particle, const int node, const double n, const Eigen::Vector3d &)
                 { shape(node, static_cast<Eigen::Index>(particle)) = n; });
  const Eigen::Map<const Eigen::VectorXd> volume(overlap.particle_volume.data(), n_particles);
  const Eigen::MatrixXd weighted = shape * volume.asDiagonal(), mass = weighted * shape.transpose();
  const Eigen::MatrixXd divisor =
      kind == Projection::consistent ? mass : Eigen::MatrixXd(mass.rowwise().sum().asDiagonal());

  const Vectors u = random_vectors(overlap.n_particles(), 5), of_nodes = random_vectors(overlap.n_nodes(), 6);
  std::vector<double> fe(test::n_dofs(overlap), 0.), fe_force(fe);
  Eigen::MatrixXd difference(n_particles, 3), at_nodes(n_nodes, 3);
  for (Eigen::Index i = 0; i < n_nodes; ++i)
  {
    at_nodes.row(i) = 1e-5 * of_nodes[i];
    Eigen::Map<Eigen::Vector3d>(fe.data() + 3 * overlap.nodes[i]) = at_nodes.row(i);
  }
  Vectors displacement(u);
  for (Eigen::Index i = 0; i < n_particles; ++i)
  {
    displacement[i] *= 1e-5;
    difference.row(i) = displacement[i];
  }
  difference -= shape.transpose() * at_nodes;
  const Eigen::MatrixXd r = divisor.ldlt().solve(weighted * difference);
  const Eigen::MatrixXd on_particles = -penalty * weighted.transpose() * r, on_nodes = penalty * mass * r;
  const double energy = 0.5 * penalty * (r.transpose() * divisor * r).trace();

  PenaltyCoupling coupling(overlap, kind, penalty);
  Vectors force(overlap.n_particles());
  const PenaltyState state = coupling.compute(displacement, fe, force, fe_force);
  CHECK(state.energy == Approx(energy).epsilon(1e-10));
  CHECK(state.largest_motion == Approx(difference.rowwise().norm().maxCoeff()).epsilon(1e-12));
  CHECK(state.largest_difference == Approx(r.rowwise().norm().maxCoeff()).epsilon(1e-9));
  double error = 0.;
  for (Eigen::Index i = 0; i < n_particles; ++i)
    error = std::max(error, (force[i].transpose() - on_particles.row(i)).norm());
  CHECK(error < 1e-10 * on_particles.rowwise().norm().maxCoeff());
  error = 0.;
  for (Eigen::Index i = 0; i < n_nodes; ++i)
    error = std::max(error, (Eigen::Map<Eigen::RowVector3d>(&fe_force[3 * static_cast<std::size_t>(overlap.nodes[i])]) -
                             on_nodes.row(i))
                                .norm());
  CHECK(error < 1e-10 * on_nodes.rowwise().norm().maxCoeff());
}

TEST_CASE("held particles have their spring beside the penalty, the others the penalty alone")
{
  const Overlap overlap = any_overlap();
  std::vector<double> node_weight;
  for (const auto &x : overlap.node_position)
    node_weight.push_back(std::clamp((x.z() - 0.1) / 0.04, 0., 1.));
  const std::vector<double> weight = particle_weights(overlap, node_weight);
  constexpr double stiffness = 1e15;
  const HeldEdge edge(overlap, node_weight, weight, {.depth = 1., .stiffness = stiffness});
  REQUIRE(edge.size() > 5);
  REQUIRE(edge.size() < overlap.n_particles() - 5);
  const Vectors u = random_vectors(overlap.n_particles(), 7);
  std::vector<double> fe(test::n_dofs(overlap));
  for (std::size_t dof = 0; dof < fe.size(); ++dof)
    fe[dof] = std::sin(5. * static_cast<double>(dof));

  PenaltyCoupling coupling(overlap, Projection::lumped, 1e14);
  Vectors alone(overlap.n_particles()), held(overlap.n_particles());
  std::vector<double> fe_alone(fe.size(), 0.), fe_held(fe.size(), 0.);
  coupling.compute(u, fe, alone, fe_alone);
  coupling.hold(edge);
  coupling.compute(u, fe, held, fe_held);

  Vectors expected = u, node_force(overlap.n_nodes(), Eigen::Vector3d::Zero());
  for_each_shape(overlap,
                 [&](const std::size_t particle, const int node, const double n, const Eigen::Vector3d &)
                 {
                   expected[particle] -=
                       n * Eigen::Map<const Eigen::Vector3d>(&fe[3 * static_cast<std::size_t>(overlap.nodes[node])]);
                 });
  double scale = 0.;
  for (std::size_t particle = 0; particle < expected.size(); ++particle)
  {
    const bool is_held =
        std::find(edge.particles().begin(), edge.particles().end(), particle) != edge.particles().end();
    expected[particle] *= is_held ? -stiffness * weight[particle] * overlap.particle_volume[particle] : 0.;
    scale = std::max(scale, expected[particle].norm());
  }
  for_each_shape(overlap, [&](const std::size_t particle, const int node, const double n, const Eigen::Vector3d &)
                 { node_force[node] -= n * expected[particle]; });
  for (std::size_t particle = 0; particle < expected.size(); ++particle)
    CHECK((held[particle] - alone[particle] - expected[particle]).norm() < 1e-12 * scale);
  for (std::size_t node = 0; node < overlap.n_nodes(); ++node)
    for (int d = 0; d < 3; ++d)
    {
      const std::size_t dof = 3 * static_cast<std::size_t>(overlap.nodes[node]) + d;
      CHECK(std::abs(fe_held[dof] - fe_alone[dof] - node_force[node][d]) < 1e-12 * scale * 30);
    }
}

TEST_CASE("elements of other nodes, or with nodes in another order, are refused")
{
  Overlap bad = test::block(1, 12);
  const auto swap_corners = [&](const std::size_t a, const std::size_t b) // with their values: the same field
  {
    std::swap(bad.shape_node[a], bad.shape_node[b]);
    std::swap(bad.shape_value[a], bad.shape_value[b]);
    std::swap(bad.shape_gradient[a], bad.shape_gradient[b]);
  };
  swap_corners(9, 10); // of the second particle
  swap_corners(13, 14);
  CHECK_NOTHROW(bad.validate()); // two coordinates change names
  swap_corners(9, 15);
  CHECK_THROWS_WITH(bad.validate(), Catch::Contains("particle 1007") && Catch::Contains("trilinear"));
  bad = test::block(1, 12);
  bad.shape_offset[3] -= 1;
  CHECK_THROWS_WITH(bad.validate(), Catch::Contains("particle 1014") && Catch::Contains("8 nodes"));
}
