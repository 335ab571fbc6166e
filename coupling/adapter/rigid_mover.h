#pragma once

#include "coupling/model/mover.h"
#include "fe_dealii/conditions/rigid_body.h"

namespace bergamo::coupling
{

/// A rigid body without a mesh as a mover. Couplings add their forces to body().
class RigidMover final : public Mover
{
public:
  explicit RigidMover(const fe::RigidBodyShape &shape, std::string name = "rigid body")
      : Mover(std::move(name)), body_(shape)
  {
  }

  void compute_forces() override { body_.clear_force(); }
  void kick(const double time_step) override
  {
    kinetic_before_ = body_.kinetic_energy();
    body_.kick(time_step);
  }
  void drift(const double time_step) override { body_.drift(time_step); }
  double stable_step() override; ///< infinite: it has no stiffness of its own

  /// Kinetic energy is the mean of the half steps around the kick.
  MoverEnergy energy() const override;

  fe::RigidBody &body() { return body_; }
  const fe::RigidBody &body() const { return body_; }

private:
  fe::RigidBody body_;
  double kinetic_before_ = 0.; // at the half step before the last kick [J]
};

} // namespace bergamo::coupling
