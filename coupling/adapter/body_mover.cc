#include "coupling/adapter/body_mover.h"

#include "dem/core/error.h"
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
  if (phase_ == 0)
    body_->compute_internal_force();
}

void BodyMover::kick(const double time_step)
{
  if (steps_per_force_ > 1)
    add_impulses();
  for (const auto &rigid : rigid_)
    rigid->boundary.move(rigid->force, rigid->moment, time_step);
  body_->kick(time_step);
}

void BodyMover::drift(const double time_step)
{
  body_->drift(time_step);
  phase_ = (phase_ + 1) % steps_per_force_;
}

void BodyMover::compute_every(const Subcycling &subcycling, const double time_step)
{
  const int n = subcycling.steps;
  if (n < 1)
    reject(name(), ": its forces are to be computed at every ", n, "-th step; give 1 or more");
  if (body_->n_steps() > 0)
    reject(name(), ": how often its forces are computed is set after ", body_->n_steps(),
           " steps; set it before the first");
  if (!(subcycling.steady_time > 0.))
    reject(name(), ": the steady part of its loads follows them in ", subcycling.steady_time,
           " s; give a positive time");
  const double stable = stable_step();
  if (n > 1 && !(n * time_step < stable))
    reject(name(), ": forces at every ", n, "-th step of ", time_step, " s are ", n * time_step,
           " s apart; they must stay below ", stable, " s, the stable step of its elements: compute them more often");
  steps_per_force_ = n;
  following_ = std::min(1., n * time_step / subcycling.steady_time);
  const std::size_t n_dofs = n > 1 ? body_->displacement().size() : 0;
  for (std::vector<double> *force : {&steady_force_, &slow_force_, &impulse_force_})
    force->assign(n_dofs, 0.);
}

/// What a kick has beyond the forces of its step, put into the external forces. A steady force that came step by step
/// between impulses that balance it would make the nodes swing; so what the couplings exert on the mean comes with
/// them.
void BodyMover::add_impulses()
{
  const std::span<double> external = body_->external_force();
  if (phase_ == 0)
  {
    std::span<const double> held; // by quiet boundaries: until the first kick they hold, then it is a dead load
    for (const auto &[part, values] : body_->state())
      if (part == "held_force")
        held = values;
    const double share = has_begun_ == 0 ? 1. : following_;
    for (std::size_t dof = 0; dof < external.size(); ++dof)
    {
      steady_force_[dof] += share * (external[dof] - steady_force_[dof]);
      slow_force_[dof] = steady_force_[dof] + body_->weight(dof) - body_->internal_force()[dof];
      if (!held.empty())
        slow_force_[dof] += held[dof];
    }
    has_begun_ = 1;
  }
  const double factor = phase_ == 0 ? steps_per_force_ - 1 : -1;
  for (std::size_t dof = 0; dof < external.size(); ++dof)
  {
    impulse_force_[dof] = factor * slow_force_[dof];
    external[dof] += impulse_force_[dof];
  }
}

double BodyMover::reaction(const fe::MovingBody::Constraint constraint) const
{
  double sum = body_->reaction(constraint);
  for (std::size_t dof = 0; dof < impulse_force_.size(); ++dof)
    if (const auto of_dof = body_->constraint_of(dof); of_dof && of_dof->place() == constraint.place())
      sum += impulse_force_[dof];
  return sum;
}

double BodyMover::stable_step()
{
  return fe::stable_step(*body_).time_step;
}

MoverEnergy BodyMover::energy() const
{
  const fe::BodyEnergy e = body_->energy();
  return {e.kinetic, e.elastic, e.plastic_dissipation + e.viscous_dissipation + e.radiated + e.stiffness_loss,
          e.boundary_work + e.gravity_work + e.exchanged};
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

void SolidMover::change_weights(const std::span<const double> old_weight, const std::span<const double> nodal_weight)
{
  if (old_weight.size() != weight_.size() || nodal_weight.size() != weight_.size())
    reject("continuum: ", old_weight.size(), " weights are to become ", nodal_weight.size(), " of ", weight_.size(),
           " nodes; give one per node");
  std::vector<double> sum(weight_);
  for (std::size_t node = 0; node < sum.size(); ++node)
    sum[node] = std::clamp(sum[node] - old_weight[node] + nodal_weight[node], 0., 1.); // rounding
  solid_.set_share(sum);
  weight_ = std::move(sum);
}

} // namespace bergamo::coupling
