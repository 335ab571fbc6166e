#pragma once

#include "coupling/arlequin/overlap.h"
#include "dem/core/rows.h"

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

  std::size_t n_nodes() const { return of_node_.size(); }
  std::size_t n_particles() const { return volume_.size(); }

  /// Pi: particle values to node values.
  void project(ConstVectors particle_values, Vectors node_values) const;

  /// N^T: values of the finite element field at the particles.
  void interpolate(ConstVectors node_values, Vectors particle_values) const;

  /// N: sums of particle forces to the nodes of their elements.
  void collect(ConstVectors particle_values, Vectors node_values) const;

private:
  struct Solver;

  std::vector<double> volume_;

  struct ShapeValue
  {
    int at; // a particle or a node
    double value;
  };
  Rows<ShapeValue> of_particle_, of_node_; // at the nodes of each particle, at the particles of each node

  std::vector<double> inverse_lumped_;   ///< 1 / A*_II [1/m^3]
  std::unique_ptr<const Solver> solver_; ///< of A; none for the lumped kind

  void factorize(const Overlap &overlap);
  void apply_inverse(Vectors node_values) const;
};

} // namespace bergamo::coupling
