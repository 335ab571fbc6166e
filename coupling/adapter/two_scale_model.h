#pragma once

#include "coupling/adapter/arlequin_coupling.h"
#include "coupling/model/model.h"

#include <memory>

namespace bergamo::coupling
{

/// Grains, a continuum body, or both joined by an Arlequin overlap, stepped together; membranes, further bodies and
/// overlaps may come to them. One step: compute_forces(); kick(); sample energies; drift(). The same bits on any number
/// of threads.
class TwoScaleModel
{
public:
  /// Either may be missing. The time step is the grains' or, without grains, the one given [s].
  TwoScaleModel(std::unique_ptr<dem::Simulation> grains, std::unique_ptr<fe::ExplicitBody> body, double time_step);

  /// Joins the models, see ArlequinCoupling.
  void join(const CouplingParameters &parameters, std::span<const double> nodal_weight,
            std::span<const Vec3> reference_by_id);

  void compute_forces() { model_.compute_forces(); } ///< contacts, internal forces, coupling forces
  void kick() { model_.kick(time_step_); }           ///< from here to drift() the energies of this step can be read
  void drift() { model_.drift(time_step_); }         ///< to the next step

  dem::Simulation *grains() { return grains_ ? &grains_->simulation() : nullptr; }
  const dem::Simulation *grains() const { return grains_ ? &grains_->simulation() : nullptr; }
  fe::ExplicitBody *body() { return body_ ? &body_->solid() : nullptr; }
  const fe::ExplicitBody *body() const { return body_ ? &body_->solid() : nullptr; }
  SolidMover *continuum() { return body_; } ///< the body as a mover: how often its forces are computed
  const SolidMover *continuum() const { return body_; }
  /// Of the grains, by node of the body; empty where they do not share its space.
  std::span<const double> weight_of_grains() const { return body_ ? body_->weights() : std::span<const double>(); }

  ArlequinCoupling *overlap() { return overlap_; }
  const ArlequinCoupling *overlap() const { return overlap_; }
  const PenaltyCoupling *coupling() const { return overlap_ ? &overlap_->penalty() : nullptr; }

  /// Of the last compute_forces(); zero before join().
  PenaltyState penalty_state() const { return overlap_ ? overlap_->state() : PenaltyState(); }

  StableSteps stable_steps() const { return model_.stable_steps(); }

  /// @name For further parts
  /// @{
  Model &parts() { return model_; }
  GrainsMover *grains_mover() { return grains_; } ///< none without grains
  /// @}
  const Model &parts() const { return model_; }

private:
  Model model_; // owns what the pointers point to
  GrainsMover *grains_ = nullptr;
  SolidMover *body_ = nullptr;
  ArlequinCoupling *overlap_ = nullptr;
  double time_step_;
};

} // namespace bergamo::coupling
