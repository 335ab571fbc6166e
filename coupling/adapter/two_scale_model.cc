#include "coupling/adapter/two_scale_model.h"

#include "coupling/adapter/dealii_adapter.h"
#include "fe_dealii/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bergamo::coupling
{

double StableSteps::combined() const
{
  const auto with_coupling = [&](const double step)
  { return 1. / std::sqrt(1. / (step * step) + 1. / (coupling * coupling)); };
  return std::min(with_coupling(grains), with_coupling(continuum));
}

TwoScaleModel::TwoScaleModel(std::unique_ptr<dem::Simulation> grains, std::unique_ptr<fe::ExplicitBody> body,
                             const double time_step)
    : grains_(std::move(grains)), body_(std::move(body)),
      time_step_(grains_ ? grains_->parameters().time_step : time_step)
{
}

void TwoScaleModel::join(const CouplingParameters &parameters, const std::span<const double> nodal_weight,
                         const std::span<const Vec3> reference_by_id)
{
  dem::Particles &p = grains_->particles;
  std::vector<Vec3> reference(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    reference[i] = reference_by_id[p.id[i]];
  Overlap overlap = make_overlap(*body_, p.id, reference, p.volume);

  std::vector<double> node_weight;
  for (const int node : overlap.nodes)
    node_weight.push_back(nodal_weight[node]);
  const std::vector<double> weight = particle_weights(overlap, node_weight, parameters.least_weight);
  bool has_changed = false; // a restarted run has its weights already, and must not search its contacts anew
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
  {
    double &w = p.weight[grains_->index_of(overlap.particle_id[k])];
    has_changed = has_changed || w != weight[k];
    w = weight[k];
  }
  if (has_changed)
    grains_->refresh_contacts();
  body_->set_share(nodal_weight);

  if (p.external_force.empty())
    p.external_force.assign(p.size(), Vec3::Zero());
  particle_displacement_.resize(overlap.n_particles());
  particle_force_.resize(overlap.n_particles());
  coupling_.emplace(std::move(overlap), parameters.projection, parameters.penalty);
}

void TwoScaleModel::compute_forces()
{
  if (grains_)
    grains_->compute_forces();
  if (body_)
  {
    body_->clear_external_force();
    body_->compute_internal_force();
  }
  if (!coupling_)
    return;

  dem::Particles &p = grains_->particles;
  const Overlap &overlap = coupling_->overlap();
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    particle_displacement_[k] = p.position[grains_->index_of(overlap.particle_id[k])] - overlap.reference_position[k];
  penalty_state_ = coupling_->compute(particle_displacement_, view(std::as_const(*body_).displacement()),
                                      particle_force_, view(body_->external_force()));
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    p.external_force[grains_->index_of(overlap.particle_id[k])] = particle_force_[k];
}

void TwoScaleModel::kick()
{
  if (body_)
    body_->kick(time_step_);
}

void TwoScaleModel::move()
{
  if (grains_)
    grains_->integrate();
  if (body_)
    body_->drift(time_step_);
}

StableSteps TwoScaleModel::stable_steps()
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  StableSteps steps{infinity, infinity, infinity};
  if (grains_)
    steps.grains = grains_->stable_time_step();
  if (body_)
    steps.continuum = fe::stable_step(*body_).time_step;
  if (coupling_)
  {
    std::vector<double> mass;
    for (const std::int64_t id : coupling_->overlap().particle_id)
    {
      const auto i = grains_->index_of(id);
      mass.push_back(grains_->particles.weight[i] * grains_->particles.mass[i]);
    }
    steps.coupling = coupling_->stable_time_step({mass, view(std::as_const(*body_).mass()), {}});
  }
  return steps;
}

} // namespace bergamo::coupling
