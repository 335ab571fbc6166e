#include "coupling/arlequin/projection.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"

#include <Eigen/SparseCholesky>

#include <cassert>

namespace bergamo::coupling
{

namespace
{

/// Least pivot over the diagonal entry of A: below, A counts as singular.
constexpr double least_pivot = 1e-10;

} // namespace

struct CoarseProjection::Solver : Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>
{
  using SimplicialLDLT::SimplicialLDLT;
};

CoarseProjection::CoarseProjection(CoarseProjection &&) noexcept = default;
CoarseProjection::~CoarseProjection() = default;

CoarseProjection::CoarseProjection(const Overlap &overlap, const Projection kind)
    : volume_(overlap.particle_volume), inverse_lumped_(overlap.n_nodes(), 0.)
{
  overlap.validate();

  const auto each_value = [&](const auto &visit) // visit(particle, node, value)
  {
    for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
      for (std::size_t k = overlap.shape_offset[particle]; k < overlap.shape_offset[particle + 1]; ++k)
        visit(static_cast<int>(particle), overlap.shape_node[k], overlap.shape_value[k]);
  };
  of_particle_ = {overlap.n_particles(), [&](const auto &put) {
                    each_value([&](const int particle, const int node, const double n) { put(particle, {node, n}); });
                  }};
  of_node_ = {overlap.n_nodes(), [&](const auto &put) {
                each_value([&](const int particle, const int node, const double n) { put(node, {particle, n}); });
              }};
  each_value([&](const int particle, const int node, const double n)
             { inverse_lumped_[node] += n * volume_[particle]; });
  for (double &value : inverse_lumped_)
    value = value > 0. ? 1. / value : 0.; // a node that no grain reaches has no difference

  if (kind == Projection::consistent)
    factorize(overlap);
}

void CoarseProjection::factorize(const Overlap &overlap)
{
  const int n = static_cast<int>(n_nodes());
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t particle = 0; particle < n_particles(); ++particle)
    for (const ShapeValue &a : of_particle_[particle])
      for (const ShapeValue &b : of_particle_[particle])
        entries.emplace_back(a.at, b.at, a.value * volume_[particle] * b.value);
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());

  auto solver = std::make_unique<Solver>(matrix);
  if (solver->info() != Eigen::Success) // a pivot of 0: go round it, to see below which one
  {
    for (int node = 0; node < n; ++node)
      matrix.coeffRef(node, node) *= 1. + 0.01 * least_pivot;
    solver->compute(matrix);
  }
  int weakest = 0;
  double least = 2.;
  for (int node = 0; node < n; ++node)
  {
    const double pivot = solver->vectorD()[solver->permutationP().indices()[node]] / matrix.coeff(node, node);
    if (!(pivot >= least))
    {
      least = pivot;
      weakest = node;
    }
  }
  if (!(least > least_pivot))
    reject(
        "consistent projection: too few particles around the node at (", overlap.node_position[weakest].transpose(),
        ") m to tell its motion from its neighbours'; take larger elements, smaller grains or the lumped projection");
  solver_ = std::move(solver);
}

void CoarseProjection::apply_inverse(const Vectors node_values) const
{
  if (!solver_)
  {
    parallel_for(n_nodes(), [&](const std::size_t node) { node_values[node] *= inverse_lumped_[node]; });
    return;
  }
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  Eigen::Map<Rows> values(node_values.data()->data(), static_cast<Eigen::Index>(n_nodes()), 3);
  const Columns right_hand_side = values;
  values = solver_->solve(right_hand_side);
}

void CoarseProjection::project(const ConstVectors particle_values, const Vectors node_values) const
{
  assert(particle_values.size() == n_particles() && node_values.size() == n_nodes());
  parallel_for(n_nodes(),
               [&](const std::size_t node)
               {
                 Eigen::Vector3d sum = Eigen::Vector3d::Zero();
                 for (const ShapeValue &n : of_node_[node])
                   sum += n.value * volume_[n.at] * particle_values[n.at];
                 node_values[node] = sum;
               });
  apply_inverse(node_values);
}

void CoarseProjection::interpolate(const ConstVectors node_values, const Vectors particle_values) const
{
  assert(particle_values.size() == n_particles() && node_values.size() == n_nodes());
  parallel_for(n_particles(),
               [&](const std::size_t particle)
               {
                 Eigen::Vector3d sum = Eigen::Vector3d::Zero();
                 for (const ShapeValue &n : of_particle_[particle])
                   sum += n.value * node_values[n.at];
                 particle_values[particle] = sum;
               });
}

void CoarseProjection::collect(const ConstVectors particle_values, const Vectors node_values) const
{
  assert(particle_values.size() == n_particles() && node_values.size() == n_nodes());
  parallel_for(n_nodes(),
               [&](const std::size_t node)
               {
                 Eigen::Vector3d sum = Eigen::Vector3d::Zero();
                 for (const ShapeValue &n : of_node_[node])
                   sum += n.value * particle_values[n.at];
                 node_values[node] = sum;
               });
}

} // namespace bergamo::coupling
