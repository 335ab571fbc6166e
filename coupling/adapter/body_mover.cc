#include "coupling/adapter/body_mover.h"

#include "fe_dealii/stable_step.h"

#include <algorithm>

namespace bergamo::coupling
{

BodyMover::BodyMover(std::unique_ptr<fe::MovingBody> body, std::string name)
    : Mover(std::move(name)), body_(std::move(body))
{
}

void BodyMover::compute_forces()
{
  body_->clear_external_force();
  body_->compute_internal_force();
}

void BodyMover::kick(const double time_step)
{
  for (const auto &rigid : rigid_)
    rigid->boundary.move(rigid->force, rigid->moment, time_step);
  body_->kick(time_step);
}

void BodyMover::drift(const double time_step)
{
  body_->drift(time_step);
}

double BodyMover::stable_step()
{
  return fe::stable_step(*body_).time_step;
}

MoverEnergy BodyMover::energy() const
{
  const fe::BodyEnergy e = body_->energy();
  return {e.kinetic, e.elastic, e.plastic_dissipation + e.viscous_dissipation + e.radiated + e.stiffness_loss,
          e.boundary_work + e.gravity_work};
}

BodyMover::Rigid &BodyMover::hold(const std::span<const unsigned int> nodes, const fe::RigidBodyParameters &parameters)
{
  rigid_.push_back(std::unique_ptr<Rigid>(new Rigid{fe::RigidBoundary(*body_, nodes, parameters), {}, {}}));
  return *rigid_.back();
}

SolidMover::SolidMover(std::unique_ptr<fe::ExplicitBody> solid, std::string name)
    : SolidMover(*solid, std::move(solid), std::move(name))
{
}

SolidMover::SolidMover(fe::ExplicitBody &solid, std::unique_ptr<fe::ExplicitBody> &&owner, std::string name)
    : BodyMover(std::move(owner), std::move(name)), solid_(solid)
{
}

void SolidMover::add_weights(const std::span<const double> nodal_weight)
{
  std::vector<double> sum(nodal_weight.begin(), nodal_weight.end());
  for (std::size_t node = 0; node < std::min(sum.size(), weight_.size()); ++node)
    sum[node] += weight_[node];
  solid_.set_share(sum);
  weight_ = std::move(sum);
}

} // namespace bergamo::coupling
