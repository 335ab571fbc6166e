#include "coupling/arlequin/projection.h"

#include <cassert>
#include <sstream>
#include <stdexcept>

namespace bergamo::coupling
{

namespace
{

/// Least pivot over the diagonal entry of A: below, A counts as singular.
constexpr double least_pivot = 1e-10;

/// Loops shorter than this are not worth the start of the threads.
constexpr std::size_t shortest_parallel_loop = 256;

/// Calls body(i) for i in [0, n); each call writes only what belongs to i.
template <class Body>
void for_each(const std::size_t n, const Body &body)
{
#pragma omp parallel for schedule(static) if (n >= shortest_parallel_loop)
  for (std::size_t i = 0; i < n; ++i)
    body(i);
}

} // namespace

CoarseProjection::CoarseProjection(const Overlap &overlap, const Projection kind)
    : volume_(overlap.particle_volume), particle_offset_(overlap.shape_offset), particle_node_(overlap.shape_node),
      particle_value_(overlap.shape_value), node_offset_(overlap.n_nodes() + 1, 0),
      node_particle_(overlap.shape_node.size()), node_value_(overlap.shape_node.size()),
      inverse_lumped_(overlap.n_nodes(), 0.)
{
  overlap.validate();

  for (const int node : particle_node_)
    ++node_offset_[node + 1];
  for (std::size_t node = 0; node < n_nodes(); ++node)
    node_offset_[node + 1] += node_offset_[node];
  std::vector<std::size_t> next(node_offset_.begin(), node_offset_.end() - 1);
  for (std::size_t particle = 0; particle < n_particles(); ++particle)
    for (std::size_t k = particle_offset_[particle]; k < particle_offset_[particle + 1]; ++k)
    {
      const int node = particle_node_[k];
      node_particle_[next[node]] = static_cast<int>(particle);
      node_value_[next[node]++] = particle_value_[k];
      inverse_lumped_[node] += particle_value_[k] * volume_[particle];
    }
  for (double &value : inverse_lumped_)
    value = 1. / value;

  if (kind == Projection::consistent)
    factorize(overlap);
}

void CoarseProjection::factorize(const Overlap &overlap)
{
  const int n = static_cast<int>(n_nodes());
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t particle = 0; particle < n_particles(); ++particle)
    for (std::size_t k = particle_offset_[particle]; k < particle_offset_[particle + 1]; ++k)
      for (std::size_t l = particle_offset_[particle]; l < particle_offset_[particle + 1]; ++l)
        entries.emplace_back(particle_node_[k], particle_node_[l],
                             particle_value_[k] * volume_[particle] * particle_value_[l]);
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
  {
    std::ostringstream message;
    message << "consistent projection: too few particles around the node at ("
            << overlap.node_position[weakest].transpose()
            << ") m to tell its motion from its neighbours'; take larger elements, smaller grains or the lumped "
               "projection";
    throw std::invalid_argument(message.str());
  }
  solver_ = std::move(solver);
}

void CoarseProjection::apply_inverse(const Vectors node_values) const
{
  if (!solver_)
  {
    for_each(n_nodes(), [&](const std::size_t node) { node_values[node] *= inverse_lumped_[node]; });
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
  for_each(n_nodes(),
           [&](const std::size_t node)
           {
             Eigen::Vector3d sum = Eigen::Vector3d::Zero();
             for (std::size_t k = node_offset_[node]; k < node_offset_[node + 1]; ++k)
               sum += node_value_[k] * volume_[node_particle_[k]] * particle_values[node_particle_[k]];
             node_values[node] = sum;
           });
  apply_inverse(node_values);
}

void CoarseProjection::transpose_project(const ConstVectors node_values, const Vectors particle_values) const
{
  std::vector<Eigen::Vector3d> solved(node_values.begin(), node_values.end());
  apply_inverse(solved);
  interpolate(solved, particle_values);
  for_each(n_particles(), [&](const std::size_t particle) { particle_values[particle] *= volume_[particle]; });
}

void CoarseProjection::interpolate(const ConstVectors node_values, const Vectors particle_values) const
{
  assert(particle_values.size() == n_particles() && node_values.size() == n_nodes());
  for_each(n_particles(),
           [&](const std::size_t particle)
           {
             Eigen::Vector3d sum = Eigen::Vector3d::Zero();
             for (std::size_t k = particle_offset_[particle]; k < particle_offset_[particle + 1]; ++k)
               sum += particle_value_[k] * node_values[particle_node_[k]];
             particle_values[particle] = sum;
           });
}

void CoarseProjection::collect(const ConstVectors particle_values, const Vectors node_values) const
{
  assert(particle_values.size() == n_particles() && node_values.size() == n_nodes());
  for_each(n_nodes(),
           [&](const std::size_t node)
           {
             Eigen::Vector3d sum = Eigen::Vector3d::Zero();
             for (std::size_t k = node_offset_[node]; k < node_offset_[node + 1]; ++k)
               sum += node_value_[k] * particle_values[node_particle_[k]];
             node_values[node] = sum;
           });
}

} // namespace bergamo::coupling
