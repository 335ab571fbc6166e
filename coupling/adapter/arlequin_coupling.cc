#include "coupling/adapter/arlequin_coupling.h"

#include "coupling/adapter/dealii_adapter.h"

#include <utility>

namespace bergamo::coupling
{
namespace
{

/// Sets the weights of both models on the way.
Overlap set_up(GrainsMover &grains, SolidMover &body, const CouplingParameters &parameters, const OverlapPlace &place)
{
  const dem::Particles &p = grains.simulation().particles;
  std::vector<Vec3> reference(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    reference[i] = place.reference_by_id[p.id[i]];
  Overlap overlap = make_overlap(body.solid(), p.id, reference, p.volume);

  std::vector<double> node_weight;
  for (const int node : overlap.nodes)
    node_weight.push_back(place.nodal_weight[node]);
  grains.set_weights(overlap.particle_id, particle_weights(overlap, node_weight, parameters.least_weight));
  body.add_weights(place.nodal_weight);
  return overlap;
}

} // namespace

ArlequinCoupling::ArlequinCoupling(GrainsMover &grains, SolidMover &body, const CouplingParameters &parameters,
                                   const OverlapPlace &place, std::string name)
    : Coupling(std::move(name)), grains_(grains), body_(body),
      penalty_(set_up(grains, body, parameters, place), parameters.projection, parameters.penalty),
      particle_displacement_(penalty_.overlap().n_particles()), particle_force_(penalty_.overlap().n_particles())
{
  dem::Particles &p = grains.simulation().particles;
  if (p.external_force.empty())
    p.external_force.assign(p.size(), Vec3::Zero());
}

void ArlequinCoupling::apply()
{
  dem::Simulation &grains = grains_.simulation();
  const Overlap &overlap = penalty_.overlap();
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    particle_displacement_[k] =
        grains.particles.position[grains.index_of(overlap.particle_id[k])] - overlap.reference_position[k];
  state_ = penalty_.compute(particle_displacement_, body_.solid().displacement(), particle_force_,
                            body_.solid().external_force());
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    grains.particles.external_force[grains.index_of(overlap.particle_id[k])] += particle_force_[k];
}

double ArlequinCoupling::stable_step()
{
  const dem::Simulation &grains = grains_.simulation();
  std::vector<double> mass;
  for (const std::int64_t id : penalty_.overlap().particle_id)
  {
    const auto i = grains.index_of(id);
    mass.push_back(grains.particles.weight[i] * grains.particles.mass[i]);
  }
  return penalty_.stable_time_step({mass, body_.solid().mass(), {}});
}

} // namespace bergamo::coupling
