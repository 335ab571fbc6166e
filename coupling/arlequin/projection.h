#pragma once

#include "coupling/arlequin/element_blocks.h"

#include <Eigen/SparseCore>

#include <memory>
#include <span>
#include <vector>

namespace bergamo::coupling
{

enum class Projection
{
  lumped,    ///< local: Pi = A*^-1 N V, A*_II = sum N_Ialpha V_alpha [6.22]
  consistent ///< volume-weighted least squares: Pi = A^-1 N V, A = N V N^T, solved at each use [6.20]
};

/// Coarse part of the particles' displacements on the ansatz of the finite elements (Wellmann, 6.2).
///
/// What is projected is the difference of both models at the particles,
///   r = Pi (u_alpha - sum_J N_Jalpha u_J^FE),
/// where the dissertation takes r = Pi u_alpha - u_I^FE. For the consistent Pi both are the same, as Pi N^T = 1. For
/// the lumped Pi they are not: the N-weighted mean of the particles' places is not the place of the node, so in the
/// dissertation's form a homogeneous strain of both models together, or a common rotation, is resisted by coupling
/// forces. The difference at the particles vanishes there before any projection. Its transpose acts on both models at
/// the same points, -Pi^T f on the particles and +N Pi^T f on the nodes, so that forces and torques about any point
/// balance, for both kinds.
///
/// Sums run in a fixed order: the bits of every result are the same on any number of threads.
class CoarseProjection
{
public:
  using Vectors = std::span<Eigen::Vector3d>;
  using ConstVectors = std::span<const Eigen::Vector3d>;

  /// Throws ConfigError where Overlap::validate() does, and for a singular A (consistent; too few particles
  /// around a node, whose position the message names).
  CoarseProjection(const Overlap &overlap, Projection kind);
  CoarseProjection(CoarseProjection &&) noexcept;
  ~CoarseProjection();

  std::size_t n_nodes() const { return blocks_->n_nodes(); }
  std::size_t n_particles() const { return volume_.size(); }
  double volume(const std::size_t particle) const { return volume_[particle]; } ///< [m^3]
  const std::shared_ptr<const ElementBlocks> &blocks() const { return blocks_; }

  /// Pi: particle values to node values.
  void project(ConstVectors particle_values, Vectors node_values) const;

  /// The same on nodes, for who goes over the particles by himself. @{
  void divide(Vectors sums) const; ///< sums of N V over the particles to values of Pi, by A or A*
  void multiply(ConstVectors node_values, Vectors product) const; ///< by A = N V N^T, whatever the kind
  /// @}

private:
  struct Solver;
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  void sum_matrix();
  void factorize(const Overlap &overlap);

  std::vector<double> volume_;
  std::shared_ptr<const ElementBlocks> blocks_;
  Matrix matrix_;                        // A [m^3]
  std::vector<double> inverse_lumped_;   // 1 / A*_II [1/m^3]
  std::unique_ptr<const Solver> solver_; // of A; none for the lumped kind
};

} // namespace bergamo::coupling
