#pragma once

#include "coupling/adapter/body_mover.h"
#include "coupling/adapter/grains_mover.h"
#include "coupling/arlequin/penalty.h"
#include "coupling/arlequin/weight.h"
#include "coupling/model/coupling.h"

#include <span>
#include <vector>

namespace bergamo::coupling
{

/// How grains and continuum are joined.
struct CouplingParameters
{
  double penalty = 1e14; ///< epsilon [Pa/m^2], > 0
  Projection projection = Projection::lumped;
  double least_weight = default_min_weight; ///< bound of the grains' weights from below, see weight.h
};

/// Where an overlap lies.
struct OverlapPlace
{
  /// Of the grains, one a node of the body: 1 where grains alone count, 0 where the body alone does. They set the
  /// body's share and the grains' weights.
  std::span<const double> nodal_weight;
  std::span<const Vec3> reference_by_id; ///< places of the grains in the reference configuration, by id [m]
};

/// Grains and a solid that share a part of their space, joined by an Arlequin overlap (Wellmann, 6.1-6.3). Several
/// overlaps may lie in one model; no grain lies in two.
class ArlequinCoupling final : public Coupling
{
public:
  /// Sets the weights and the share, once. Both movers have to outlive it.
  /// @throws ConfigError where the overlap is empty or too coarse
  ArlequinCoupling(GrainsMover &grains, SolidMover &body, const CouplingParameters &parameters,
                   const OverlapPlace &place, std::string name = "overlap");

  void apply() override;
  std::vector<const Mover *> movers() const override { return {&grains_, &body_}; }
  double stable_step() override;
  double energy() const override { return state_.energy; }

  const PenaltyCoupling &penalty() const { return penalty_; }

  /// Of the last apply(): energy stored in the penalty and the largest nodal difference.
  const PenaltyState &state() const { return state_; }

  /// Forces of the last apply() on the coupled particles, in the order of the overlap [N].
  std::span<const Eigen::Vector3d> particle_forces() const { return particle_force_; }

private:
  GrainsMover &grains_;
  SolidMover &body_;
  PenaltyCoupling penalty_;
  PenaltyState state_;
  std::vector<Eigen::Vector3d> particle_displacement_, particle_force_;
};

} // namespace bergamo::coupling
