#pragma once

#include "coupling/arlequin/held_edge.h"
#include "coupling/arlequin/projection.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace bergamo::coupling
{

/// What the coupling stores and how far apart the models are.
struct PenaltyState
{
  double energy = 0.; ///< of the differences, of a held edge, and what was put into forces that are kept [J]
  double largest_difference = 0.; ///< largest |r_I| of the coupling nodes [m]
  double largest_motion = 0.;     ///< largest |u_alpha - N^T u^FE| of the coupled particles [m]
};

/// Masses that the coupling forces move, for the stable time step. All of them weighted as in the run.
struct CoupledMasses
{
  std::span<const double> particle;    ///< w m of each coupled particle [kg]
  std::span<const double> fe;          ///< lumped mass of each degree of freedom, 3 * node + component [kg]
  std::span<const std::uint8_t> fixed; ///< nonzero for prescribed degrees of freedom; empty for none
};

/// Penalty coupling of grains and finite elements in their overlap, on the coarse part of their difference,
///   r = Pi (u_alpha - N^T u^FE),
/// see projection.h. Its energy is (epsilon / 2) r.A r with the volumes of the grains, A = N V N^T or its row sums:
/// where Wellmann (6.23-6.26) integrates |r|^2 over whole elements, only what is filled with grains counts, so elements
/// may be cut by a free surface. As A Pi = N V, its gradient is a load on the grains by their volumes,
///   -V_alpha sum_I N_Ialpha g_I with g_I = epsilon r_I [N/m^3],
/// and the opposite on the nodes at the same places. Forces and torques (about the reference positions) of both models
/// sum to zero. Displacements count from the reference configuration of the Overlap, in the global frame.
///
/// renew() goes on with other places, particles and shape functions: differences count anew from zero and the load
/// densities g_I stay at the nodes, so that forces do not jump. Same bits on any number of threads.
class PenaltyCoupling
{
public:
  /// Penalty epsilon [Pa/m^2 = J/m^5] > 0, per volume of grains. Throws ConfigError for a bad overlap or penalty.
  PenaltyCoupling(Overlap overlap, Projection kind, double penalty);

  /// Holds the grains at the edge, too. Before the first step.
  void hold(HeldEdge edge) { edge_ = std::move(edge); }
  const HeldEdge &edge() const { return edge_; }
  HeldEdge &edge() { return edge_; }

  const Overlap &overlap() const { return overlap_; }
  const CoarseProjection &projection() const { return *projection_; }

  /// Goes on with another overlap of the same mesh, see above. @param moved how far the places from which displacements
  /// count move for particles that are in both, by their order in the new overlap [m]
  /// Throws ConfigError for a bad overlap. Call after compute() at the present displacements.
  void renew(Overlap overlap, std::span<const Eigen::Vector3d> moved);

  /// Displacements [m] of the coupled particles and of the whole FE mesh (3 * node + component) to the coupling forces
  /// [N]: `particle_force` is overwritten, `fe_force` is added to. Throws ConfigError for wrong sizes.
  PenaltyState compute(std::span<const Eigen::Vector3d> particle_displacement, std::span<const double> fe_displacement,
                       std::span<Eigen::Vector3d> particle_force, std::span<double> fe_force);

  /// All that a step depends on beside the overlap, by name; see dem/core/state.h.
  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("kept", self.kept_);
    visit("put_in", self.put_in_);
    visit("n_renewals", self.n_renewals_);
    visit("edge", self.edge_);
  }

  std::int64_t n_renewals() const { return n_renewals_; }

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
    linear ///< in the displacements: without what is kept and the dead loads of the edge
  };

  PenaltyState add_forces(std::span<const Eigen::Vector3d> particle_displacement,
                          std::span<const double> fe_displacement, std::span<Eigen::Vector3d> particle_force,
                          std::span<double> fe_force, Loads loads);
  void take(Overlap overlap);

  Overlap overlap_;
  Projection kind_;
  std::unique_ptr<const CoarseProjection> projection_;
  double penalty_;
  std::vector<Eigen::Vector3d> kept_; // load density at the nodes where the differences are zero [N/m^3]
  double put_in_ = 0.;                // energy stored before the last renewal [J]
  std::int64_t n_renewals_ = 0;
  double difference_energy_ = 0.; // of the differences and what is kept, at the last compute() [J]
  int largest_node_;

  HeldEdge edge_;
  std::vector<Eigen::Vector3d> particle_difference_, particle_work_, node_work_, difference_;
};

} // namespace bergamo::coupling
