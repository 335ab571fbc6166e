#pragma once

#include "coupling/adapter/body_mover.h"
#include "coupling/adapter/grains_mover.h"
#include "coupling/adapter/stray_grains.h"
#include "coupling/arlequin/penalty.h"
#include "coupling/arlequin/weight.h"
#include "coupling/arlequin/weight_transfer.h"
#include "coupling/model/coupling.h"

#include <span>
#include <vector>

namespace bergamo::coupling
{

/// How grains and continuum are joined.
struct CouplingParameters
{
  double penalty = 1e15; ///< epsilon [Pa/m^2], > 0
  Projection projection = Projection::lumped;
  double least_weight = default_min_weight; ///< bound of the grains' weights from below, see weight.h
  EdgeParameters edge;
  double transfer_time = 1e-4; ///< in which the transfer follows the contacts [s], > 0

  /// Motion of a grain relative to the continuum after which the overlap is made anew, of the present places, in mean
  /// diameters of its grains; 0: never.
  double renewal = 0.;

  /// Up to which grains above the mesh, where an overlap comes to a free surface, belong to the nearest place of it, in
  /// mean diameters; 0: those in elements alone. What settles lies up to two and a half diameters above its level.
  double surface_reach = 0.;

  /// Throws ConfigError for a value out of its range; the penalty and the least weight are looked at where they are
  /// used.
  void validate() const;
};

/// Where an overlap lies.
struct OverlapPlace
{
  /// Of the grains, one a node of the body: 1 where grains alone count, 0 where the body alone does. They set the
  /// body's share and the grains' weights.
  std::span<const double> nodal_weight;
  std::span<const Vec3> reference_by_id; ///< places of the grains in the reference configuration, by id [m]
};

/// Grains and a solid that share a part of their space, joined by an Arlequin overlap (Wellmann, 6.1-6.3) with forces
/// that are blended (WeightTransfer) and an edge that is held (HeldEdge). Several overlaps may lie in one model; no
/// grain lies in two. The places at the first step are those without a difference, whatever the body's displacement is
/// by then. Held grains start in equilibrium, if the others do: at the first step they get the dead loads that keep
/// them where they are.
///
/// Grains may move through the overlap: from time to time it is made anew of the present places, with the grains that
/// are in the elements by then and their weights there. The coupling's forces and energy do not jump (PenaltyCoupling::
/// renew()), held grains stay tied to where they were held, and what a change of weight puts in is booked.
class ArlequinCoupling final : public Coupling
{
public:
  /// Sets the weights and the share, once. Both movers have to outlive it.
  /// @throws ConfigError where the overlap is empty or too coarse
  ArlequinCoupling(GrainsMover &grains, SolidMover &body, const CouplingParameters &parameters,
                   const OverlapPlace &place, std::string name = "overlap");

  /// The next step is a first one again: for a body that was brought to rest under the forces of the overlap.
  void begin() { has_started_ = 0; }

  void apply() override;
  void follow(double time_step) override;
  std::vector<const Mover *> movers() const override { return {&grains_, &body_}; }
  double stable_step() override;
  double energy() const override { return state_.energy; }

  const PenaltyCoupling &penalty() const { return penalty_; }

  /// Of the last apply(): energy stored in the penalty and the edge, and the largest nodal difference.
  const PenaltyState &state() const { return state_; }

  /// Work on both models of what the gradient of the weights transfers, since the start until the last apply() [J].
  double transfer_work() const { return transfer_work_; }

  /// What slips of the held edge have taken from both models until the last apply() [J].
  double slip_loss() const { return penalty_.edge().slip_loss(); }

  /// Makes the overlap anew, as follow() does when it is due; between follow() and apply().
  void renew();

  /// The overlap goes elsewhere on the same mesh, between steps: the body's share and the grains' weights become those
  /// of the new nodal weights, the edge is held where it is now, and grains that are new, with the highest ids, are in
  /// it. What the old edge held is let go; the new one starts in equilibrium, if the others are, as at the first step.
  /// @param place of the grains known so far it needs no references
  /// @throws ConfigError as the constructor does
  void move_to(const OverlapPlace &place);

  /// Where the grains are in the body's reference configuration, by id, as the present overlap has them [m]: a
  /// restarted run is joined with these.
  const std::vector<Vec3> &reference_by_id() const { return reference_by_id_; }

  /// All that a step depends on beside the movers, by name; see dem/core/state.h.
  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("resting_place", self.resting_place_);
    visit("penalty", self.penalty_);
    visit("has_started", self.has_started_);
    visit("drifted", self.drifted_);
    visit("transfer_force", self.transfer_.force);
    visit("transfer_torque", self.transfer_.torque);
    visit("transfer_on_nodes", self.transfer_.on_nodes);
    visit("transfer_work", self.transfer_work_);
    visit("stray", self.stray_);
  }

private:
  /// What the gradient of the weights gives at one step.
  struct Transfer
  {
    std::vector<Vec3> force, torque; // on the coupled particles [N], [N m]
    std::vector<double> on_nodes;    // by degree of freedom [N]

    explicit Transfer(const std::size_t n_particles = 0) { resize(n_particles); }
    void resize(const std::size_t n_particles)
    {
      force.resize(n_particles, Vec3::Zero());
      torque.resize(n_particles, Vec3::Zero());
    }
  };

  void start();
  double reach() const;
  void look_at_overlap();
  void find_particles();
  bool must_be_renewed();
  template <class AddForce>
  void compute_penalty(const AddForce &add_force, std::span<double> fe_force);
  void give_transfer();
  void balance_edge(std::span<const std::size_t> held);
  void limit_edge();
  bool has_just_come() const { return has_started_ == 0 || has_just_moved_; }
  double power_of(const Transfer &transfer) const;
  double power_on_nodes(const Transfer &transfer) const;

  GrainsMover &grains_;
  SolidMover &body_;
  PenaltyCoupling penalty_;
  WeightTransfer weight_transfer_;
  CouplingParameters parameters_;
  std::vector<double> nodal_weight_;
  std::vector<Vec3> reference_by_id_; // [m]
  std::vector<std::int32_t> index_;   // of the coupled grains in the engine's arrays
  std::int64_t seen_order_ = -1;      // of the engine's grains, for which these are right
  StrayGrains stray_;                 // that may come into the elements
  double farthest_ = 0.;              // motion after which the overlap is made anew [m]
  PenaltyState state_;
  std::vector<Vec3>
      resting_place_; // of the coupled particles, without a difference if the body had no displacement [m]
  Transfer transfer_;
  double transfer_work_ = 0.; // [J]
  double drifted_ = 0.;       // since the last apply() [s]
  std::int64_t has_started_ = 0;

  // Between move_to() and the apply() of the same step.
  bool has_just_moved_ = false;
  std::vector<std::size_t> fresh_; // places in the edge
};

} // namespace bergamo::coupling
