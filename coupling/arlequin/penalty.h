#pragma once

#include "coupling/arlequin/held_edge.h"
#include "coupling/arlequin/projection.h"

#include <algorithm>
#include <cmath>
#include <concepts>
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

  /// Holds another edge from now on, after renew(); see HeldEdge::become().
  void hold_instead(HeldEdge edge, std::vector<std::size_t> &fresh) { put_in_ += edge_.become(std::move(edge), fresh); }

  /// Displacements [m] of the coupled particles and of the whole FE mesh (3 * node + component) to the coupling forces
  /// [N]: `particle_force` is overwritten, `fe_force` is added to. Throws ConfigError for wrong sizes.
  PenaltyState compute(std::span<const Eigen::Vector3d> particle_displacement, std::span<const double> fe_displacement,
                       std::span<Eigen::Vector3d> particle_force, std::span<double> fe_force);

  /// The same for particles wherever they are kept.
  /// @param displacement displacement(particle) [m]; @param add_force add_force(particle, force) [N]: called from
  /// several threads, each for particles of its own, and twice for a held one
  template <std::invocable<std::size_t> Displacement, std::invocable<std::size_t, Eigen::Vector3d> AddForce>
  PenaltyState compute(const Displacement &displacement, const std::span<const double> fe_displacement,
                       const AddForce &add_force, const std::span<double> fe_force)
  {
    require_nodes(fe_displacement, fe_force);
    return add_forces(displacement, fe_displacement, add_force, fe_force, Loads::all);
  }

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

  /// Two passes over the particles: what they give to the nodes' differences, and what these give to them.
  template <class Displacement, class AddForce>
  PenaltyState add_forces(const Displacement &displacement, std::span<const double> fe_displacement,
                          const AddForce &add_force, std::span<double> fe_force, Loads loads);
  double load_nodes(std::span<double> fe_force, Loads loads);
  PenaltyState state_of(double stored, double held, Loads loads);
  void require_nodes(std::span<const double> fe_displacement, std::span<const double> fe_force) const;
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
  std::vector<Eigen::Vector3d> held_displacement_, held_force_;            // of the edge's particles
  std::vector<Eigen::Vector3d> moment_, difference_, density_, node_load_; // at the nodes: N V u, r, g, A g
  std::vector<double> largest_motion_;                                     // by block
};

template <class Displacement, class AddForce>
PenaltyState PenaltyCoupling::add_forces(const Displacement &displacement,
                                         const std::span<const double> fe_displacement, const AddForce &add_force,
                                         const std::span<double> fe_force, const Loads loads)
{
  const ElementBlocks &blocks = *projection_->blocks();
  blocks.sum_at_nodes(
      [&](const std::size_t b, const ElementBlocks::Block &block)
      {
        const ElementBlocks::Eights field = ElementBlocks::coefficients(
            block, [&](const int node)
            { return Eigen::Map<const Eigen::Vector3d>(&fe_displacement[3 * overlap_.nodes[node]]); });
        double largest_square = 0.;
        const ElementBlocks::Eights moments =
            blocks.moments_of(block,
                              [&](const std::size_t particle, const ElementBlocks::Products &at)
                              {
                                const Padded difference = padded(displacement(particle)) - at.value_of(field);
                                largest_square = std::max(largest_square, math::sum(difference * difference));
                                return projection_->volume(particle) * difference;
                              });
        largest_motion_[b] = std::sqrt(largest_square);
        return ElementBlocks::at_nodes(moments);
      },
      [&](const std::size_t node, const Eigen::Vector3d &sum) { moment_[node] = sum; });

  const double stored = load_nodes(fe_force, loads);

  blocks.for_each(
      [&](std::size_t, const ElementBlocks::Block &block)
      {
        const ElementBlocks::Eights field = ElementBlocks::coefficients(
            block, [&](const int node) -> const Eigen::Vector3d & { return density_[node]; });
        for (std::size_t particle = block.begin; particle < block.end; ++particle)
          add_force(particle, unpadded(-projection_->volume(particle) * blocks.products(particle).value_of(field)));
      });

  held_displacement_.resize(edge_.size());
  held_force_.resize(edge_.size());
  for (std::size_t k = 0; k < edge_.size(); ++k)
    held_displacement_[k] = displacement(edge_.particles()[k]);
  const double held = edge_.add_forces(held_displacement_, fe_displacement, held_force_, fe_force,
                                       loads == Loads::all ? HeldEdge::Loads::all : HeldEdge::Loads::springs);
  for (std::size_t k = 0; k < edge_.size(); ++k)
    add_force(edge_.particles()[k], held_force_[k]);
  return state_of(stored, held, loads);
}

} // namespace bergamo::coupling
