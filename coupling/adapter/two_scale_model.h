#pragma once

#include "coupling/arlequin/penalty.h"
#include "coupling/arlequin/weight.h"
#include "dem/simulation.h"
#include "fe_dealii/explicit_body.h"

#include <memory>
#include <optional>
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

/// Largest stable steps of the parts [s]; infinity for a part that is not there.
struct StableSteps
{
  double grains, continuum, coupling;

  /// Bound for the whole: the squared frequencies of a part and of the coupling add up at most.
  double combined() const;
};

/// Grains, a continuum body, or both joined by an Arlequin overlap, stepped together in the order of Wellmann's
/// fig. 6.3. One step: compute_forces(); kick(); sample energies; move(). The same bits on any number of threads.
class TwoScaleModel
{
public:
  /// Either may be missing. The time step is the grains' or, without grains, the one given [s].
  TwoScaleModel(std::unique_ptr<dem::Simulation> grains, std::unique_ptr<fe::ExplicitBody> body, double time_step);

  /// Joins the models: nodal weights of the grains (one a node of the body, 1 where grains alone count) set the
  /// continuum's share and the grains' weights; the reference positions are those given, by id of the grain.
  /// @throws ConfigError where the overlap is empty or too coarse
  void join(const CouplingParameters &parameters, std::span<const double> nodal_weight,
            std::span<const Vec3> reference_by_id);

  void compute_forces(); ///< contacts, internal forces, coupling forces at the present step
  void kick();           ///< the body's velocities; from here to move() the energies of this step can be read
  void move();           ///< to the next step

  dem::Simulation *grains() { return grains_.get(); }
  const dem::Simulation *grains() const { return grains_.get(); }
  fe::ExplicitBody *body() { return body_.get(); }
  const fe::ExplicitBody *body() const { return body_.get(); }
  const PenaltyCoupling *coupling() const { return coupling_ ? &*coupling_ : nullptr; }

  /// Of the last compute_forces(): energy stored in the penalty and the largest nodal difference.
  const PenaltyState &penalty_state() const { return penalty_state_; }

  /// Forces of the last compute_forces() [N]: on the coupled particles, in the order of the overlap.
  std::span<const Eigen::Vector3d> particle_forces() const { return particle_force_; }

  StableSteps stable_steps();

private:
  std::unique_ptr<dem::Simulation> grains_;
  std::unique_ptr<fe::ExplicitBody> body_;
  double time_step_;
  std::optional<PenaltyCoupling> coupling_;
  PenaltyState penalty_state_;
  std::vector<Eigen::Vector3d> particle_displacement_, particle_force_;
};

} // namespace bergamo::coupling
