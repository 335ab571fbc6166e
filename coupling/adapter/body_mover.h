#pragma once

#include "coupling/model/mover.h"
#include "fe_dealii/conditions/rigid_boundary.h"
#include "fe_dealii/explicit_body.h"

#include <memory>
#include <span>
#include <vector>

namespace bergamo::coupling
{

/// A body of solids or of membranes as a mover, with the rigid bodies that hold some of its nodes.
class BodyMover : public Mover
{
public:
  explicit BodyMover(std::unique_ptr<fe::MovingBody> body, std::string name = "continuum");

  void compute_forces() override;
  void kick(double time_step) override;
  void drift(double time_step) override;
  double stable_step() override;
  MoverEnergy energy() const override;

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
  std::unique_ptr<fe::MovingBody> body_;
  std::vector<std::unique_ptr<Rigid>> rigid_;
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
  std::span<const double> weights() const { return weight_; } ///< their sum by node; empty where there are no grains

private:
  SolidMover(fe::ExplicitBody &solid, std::unique_ptr<fe::ExplicitBody> &&owner, std::string name);

  fe::ExplicitBody &solid_; // the body that it moves
  std::vector<double> weight_;
};

} // namespace bergamo::coupling
