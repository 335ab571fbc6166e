#pragma once

#include "coupling/arlequin/held_edge.h"
#include "coupling/arlequin/projection.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::coupling
{

/// What the coupling stores and how far apart the models are.
struct PenaltyState
{
  double energy = 0.;             ///< (epsilon / 2) integral of |r|^2 dV, and that of a held edge [J]
  double largest_difference = 0.; ///< largest |r_I| of the coupling nodes [m]
};

/// Masses that the coupling forces move, for the stable time step. All of them weighted as in the run.
struct CoupledMasses
{
  std::span<const double> particle;    ///< w m of each coupled particle [kg]
  std::span<const double> fe;          ///< lumped mass of each degree of freedom, 3 * node + component [kg]
  std::span<const std::uint8_t> fixed; ///< nonzero for prescribed degrees of freedom; empty for none
};

/// Penalty coupling of grains and finite elements in their overlap (Wellmann, 6.23-6.26, in the form that projection.h
/// explains): energy (epsilon / 2) r.V r of the nodal differences r = Pi (u_alpha - N^T u^FE), and as its gradient
///   f_I = epsilon sum_J V_IJ r_J,   -(Pi^T f)_alpha on the particles,   +sum_alpha N_Jalpha (Pi^T f)_alpha on the
///   nodes.
/// Forces and torques (about the reference positions) of both models sum to zero. Displacements count from the
/// reference configuration of the Overlap, in the global frame. Same bits on any number of threads.
class PenaltyCoupling
{
public:
  /// Penalty epsilon [Pa/m^2 = J/m^5] > 0. Throws ConfigError for a bad overlap or penalty.
  PenaltyCoupling(Overlap overlap, Projection kind, double penalty);

  /// Holds the grains at the edge, too. Before the first step.
  void hold(HeldEdge edge) { edge_ = std::move(edge); }
  const HeldEdge &edge() const { return edge_; }
  HeldEdge &edge() { return edge_; }

  const Overlap &overlap() const { return overlap_; }
  const CoarseProjection &projection() const { return projection_; }

  /// Displacements [m] of the coupled particles and of the whole FE mesh (3 * node + component) to the coupling forces
  /// [N]: `particle_force` is overwritten, `fe_force` is added to. Throws ConfigError for wrong sizes.
  PenaltyState compute(std::span<const Eigen::Vector3d> particle_displacement, std::span<const double> fe_displacement,
                       std::span<Eigen::Vector3d> particle_force, std::span<double> fe_force);

  /// Nodal differences r_I of the last compute() [m]; the eigenvalue search computes, too.
  std::span<const Eigen::Vector3d> node_difference() const { return difference_; }

  /// Largest eigenvalue [1/s^2] of the coupling alone, M^-1 K, by power iteration from a fixed start. The residual's
  /// norm is added, so that the result errs to the safe side: it lies within about `tolerance` above the eigenvalue.
  /// For a whole system, the sum of the parts' largest eigenvalues is a bound.
  double largest_eigenvalue(const CoupledMasses &masses, double tolerance = 1e-3);

  /// 2 / sqrt(largest eigenvalue) [s]: the largest stable step of central differences for the coupling alone.
  double stable_time_step(const CoupledMasses &masses);

private:
  enum class Loads
  {
    all,
    linear ///< in the displacements: without the dead loads of the edge
  };

  PenaltyState add_forces(std::span<const Eigen::Vector3d> particle_displacement,
                          std::span<const double> fe_displacement, std::span<Eigen::Vector3d> particle_force,
                          std::span<double> fe_force, Loads loads);

  Overlap overlap_;
  CoarseProjection projection_;
  double penalty_;
  int largest_node_;

  HeldEdge edge_;
  std::vector<Eigen::Vector3d> particle_difference_, particle_work_, node_work_, difference_;
};

} // namespace bergamo::coupling
