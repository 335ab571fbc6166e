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

const Overlap &validated(const Overlap &overlap)
{
  overlap.validate();
  return overlap;
}

} // namespace

struct CoarseProjection::Solver : Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>
{
  using SimplicialLDLT::SimplicialLDLT;
};

CoarseProjection::CoarseProjection(CoarseProjection &&) noexcept = default;
CoarseProjection::~CoarseProjection() = default;

CoarseProjection::CoarseProjection(const Overlap &overlap, const Projection kind)
    : volume_(validated(overlap).particle_volume), blocks_(std::make_shared<const ElementBlocks>(overlap))
{
  sum_matrix();
  for (std::size_t node = 0; node < n_nodes(); ++node)
  {
    const double sum = matrix_.row(static_cast<int>(node)).sum();
    inverse_lumped_.push_back(sum > 0. ? 1. / sum : 0.); // a node that no grain reaches has no difference
  }
  if (kind == Projection::consistent)
    factorize(overlap);
}

/// A from its blocks.
void CoarseProjection::sum_matrix()
{
  using Eight = Eigen::Matrix<double, 8, 1>;
  std::vector<Eigen::Triplet<double>> entries;
  for (const ElementBlocks::Block &block : blocks_->blocks())
  {
    Eigen::Matrix<double, 8, 8> of_block = Eigen::Matrix<double, 8, 8>::Zero();
    for (std::size_t particle = block.begin; particle < block.end; ++particle)
    {
      const std::array<double, 8> values = blocks_->shape_values(particle);
      const Eigen::Map<const Eight> n(values.data());
      of_block.noalias() += (volume_[particle] * n) * n.transpose();
    }
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        entries.emplace_back(block.nodes[i], block.nodes[j], of_block(i, j));
  }
  matrix_.resize(static_cast<int>(n_nodes()), static_cast<int>(n_nodes()));
  matrix_.setFromTriplets(entries.begin(), entries.end());
}

void CoarseProjection::factorize(const Overlap &overlap)
{
  const int n = static_cast<int>(n_nodes());
  Eigen::SparseMatrix<double> matrix = matrix_;
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

void CoarseProjection::divide(const Vectors sums) const
{
  assert(sums.size() == n_nodes());
  if (!solver_)
  {
    parallel_for(n_nodes(), [&](const std::size_t node) { sums[node] *= inverse_lumped_[node]; });
    return;
  }
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  Eigen::Map<Rows> values(sums.data()->data(), static_cast<Eigen::Index>(n_nodes()), 3);
  const Columns right_hand_side = values;
  values = solver_->solve(right_hand_side);
}

void CoarseProjection::multiply(const ConstVectors node_values, const Vectors product) const
{
  assert(node_values.size() == n_nodes() && product.size() == n_nodes());
  parallel_for(n_nodes(),
               [&](const std::size_t node)
               {
                 Eigen::Vector3d sum = Eigen::Vector3d::Zero();
                 for (Matrix::InnerIterator entry(matrix_, static_cast<int>(node)); entry; ++entry)
                   sum += entry.value() * node_values[entry.col()];
                 product[node] = sum;
               });
}

void CoarseProjection::project(const ConstVectors particle_values, const Vectors node_values) const
{
  assert(particle_values.size() == n_particles() && node_values.size() == n_nodes());
  std::vector<Eigen::Vector3d> weighted(particle_values.begin(), particle_values.end());
  for (std::size_t particle = 0; particle < n_particles(); ++particle)
    weighted[particle] *= volume_[particle];
  blocks_->collect(weighted, node_values);
  divide(node_values);
}

} // namespace bergamo::coupling
