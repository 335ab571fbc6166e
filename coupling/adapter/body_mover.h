#pragma once

#include "coupling/model/mover.h"
#include "fe_dealii/conditions/rigid_boundary.h"
#include "fe_dealii/explicit_body.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace bergamo::coupling
{

/// How often the forces of a body's elements are computed.
struct Subcycling
{
  int steps = 1;             ///< from one computation to the next, >= 1
  double steady_time = 1e-4; ///< in which the steady part of the couplings' forces follows them [s], > 0
};

/// A body of solids or of membranes as a mover, with the rigid bodies that hold some of its nodes.
class BodyMover : public Mover
{
public:
  explicit BodyMover(std::unique_ptr<fe::MovingBody> body, std::string name = "continuum");

  void compute_forces() override;
  void kick(double time_step) override;
  void drift(double time_step) override;
  double stable_step() override;
  int steps_per_force() const override { return steps_per_force_; }
  MoverEnergy energy() const override;

  /// @name Subcycling: the elements' forces at every n-th step alone
  /// The nodes move with every step and feel what couplings exert on them then; the forces of the elements, the weight,
  /// and a steady part of the couplings' forces come as impulses of n steps at the first step of each cycle of n, and
  /// the steady part is taken back in equal shares within the cycle (r-RESPA, Tuckerman, Berne & Martyna 1992). Without
  /// it a body that is held by its couplings would swing within a cycle. The scheme is the leapfrog of n steps with
  /// that of one inside, and each force has its whole impulse at the end of each cycle. As long as the steady part
  /// stays, it is symmetric in time and keeps the energy to second order; as it follows, vibrations gain n dt / 4
  /// steady_time^2 of their energy in unit time. Velocities that the body has before its first kick belong to half a
  /// cycle before. Stresses, energies and reactions are known at the first step of each cycle; in between they are
  /// those of the last.
  /// @{

  /// @param time_step of the run [s]. To be called before the first step. Throws ConfigError for values out of their
  /// range, a body that has moved, or where n steps are above the stable step of the body.
  void compute_every(const Subcycling &subcycling, double time_step);

  /// Resultant force that the boundary exerts on the body in the constrained component [N]. MovingBody::reaction() has
  /// the impulses in it where the body is subcycled.
  double reaction(fe::MovingBody::Constraint constraint) const;
  /// @}

  /// All that a step depends on beside body and rigid bodies, by name; see dem/core/state.h.
  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("phase", self.phase_);
    visit("has_begun", self.has_begun_);
    visit("steady_force", self.steady_force_);
    visit("slow_force", self.slow_force_);
    visit("impulse_force", self.impulse_force_);
  }

  fe::MovingBody &body() { return *body_; }
  const fe::MovingBody &body() const { return *body_; }

  /// A rigid body that moves freely with nodes of the body.
  struct Rigid
  {
    fe::RigidBoundary boundary;
    fe::RigidBoundary::Vector force{}, moment{}; ///< of the user on its centre, kept from step to step [N, N m]
  };
  /// Errors as fe::RigidBoundary has.
  Rigid &hold(std::span<const unsigned int> nodes, const fe::RigidBodyParameters &parameters);

private:
  void add_impulses();

  std::unique_ptr<fe::MovingBody> body_;
  std::vector<std::unique_ptr<Rigid>> rigid_;

  int steps_per_force_ = 1;
  double following_ = 0.;                  // share of the way that the steady part follows the couplings in a cycle
  std::int64_t phase_ = 0, has_begun_ = 0; // steps since the elements' forces were computed
  // By degree of freedom, none where each step computes forces [N]: the steady part of the couplings' forces, what
  // comes as impulses, and what the last kick had beyond the forces of its step.
  std::vector<double> steady_force_, slow_force_, impulse_force_;
};

/// A body of solids, which may share its space with grains.
class SolidMover final : public BodyMover
{
public:
  explicit SolidMover(std::unique_ptr<fe::ExplicitBody> solid, std::string name = "continuum");

  fe::ExplicitBody &solid() { return solid_; }
  const fe::ExplicitBody &solid() const { return solid_; }

  /// Adds the weights of grains that share the body's space, one a node in [0, 1]: the body's share is what all of them
  /// leave. Call before the first step. Errors as ExplicitBody::set_share() has, for the sum of all weights.
  void add_weights(std::span<const double> nodal_weight);
  /// Other ones instead of those that were added before, between steps; see ExplicitBody::set_share().
  void change_weights(std::span<const double> old_weight, std::span<const double> nodal_weight);
  std::span<const double> weights() const { return weight_; } ///< their sum by node; empty where there are no grains

private:
  SolidMover(fe::ExplicitBody &solid, std::unique_ptr<fe::ExplicitBody> &&owner, std::string name);

  fe::ExplicitBody &solid_; // the body that it moves
  std::vector<double> weight_;
};

} // namespace bergamo::coupling
