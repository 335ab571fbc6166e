#include "coupling/adapter/arlequin_coupling.h"

#include "coupling/adapter/dealii_adapter.h"
#include "coupling/adapter/overlap_setup.h"
#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace bergamo::coupling
{
namespace
{

/// Sets the weights of both models on the way.
PenaltyCoupling set_up(GrainsMover &grains, SolidMover &body, const CouplingParameters &parameters,
                       const OverlapPlace &place)
{
  parameters.validate();
  const Overlap overlap = overlap_of(grains.simulation().particles, body, place.reference_by_id);
  const OverlapWeights weights(overlap, place.nodal_weight, parameters.least_weight);
  grains.set_weights(overlap.particle_id, weights.particle);
  body.add_weights(place.nodal_weight);
  PenaltyCoupling penalty(overlap, parameters.projection, parameters.penalty);
  penalty.hold(HeldEdge(overlap, weights.node, weights.particle, parameters.edge));
  return penalty;
}

} // namespace

void CouplingParameters::validate() const
{
  if (!(transfer_time > 0.) || !std::isfinite(transfer_time))
    reject("the transfer time of an overlap is ", transfer_time,
           " s; it must be positive: long beside the oscillations of grains and elements, short beside the loading");
  if (!(renewal >= 0.) || !std::isfinite(renewal))
    reject("the renewal of an overlap is due after ", renewal,
           " diameters; it must be 0, for never, or positive: a tenth is small beside grains and elements");
  edge.validate();
}

ArlequinCoupling::ArlequinCoupling(GrainsMover &grains, SolidMover &body, const CouplingParameters &parameters,
                                   const OverlapPlace &place, std::string name)
    : Coupling(std::move(name)), grains_(grains), body_(body), penalty_(set_up(grains, body, parameters, place)),
      weight_transfer_(penalty_.overlap()), parameters_(parameters),
      nodal_weight_(place.nodal_weight.begin(), place.nodal_weight.end()),
      reference_by_id_(place.reference_by_id.begin(), place.reference_by_id.end()),
      particle_displacement_(penalty_.overlap().n_particles()), particle_force_(penalty_.overlap().n_particles())
{
  dem::Particles &p = grains.simulation().particles;
  for (std::vector<Vec3> *external : {&p.external_force, &p.external_torque})
    if (external->empty())
      external->assign(p.size(), Vec3::Zero());
  look_at_overlap();
}

void ArlequinCoupling::apply()
{
  dem::Simulation &grains = grains_.simulation();
  dem::Particles &p = grains.particles;
  const Overlap &overlap = penalty_.overlap();
  follow_transfer();
  if (has_started_ == 0)
    start();
  const std::span<double> fe_force = body_.solid().external_force();
  compute_penalty(fe_force);
  for (std::size_t dof = 0; dof < fe_force.size(); ++dof)
    fe_force[dof] += transfer_.on_nodes[dof];
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
  {
    const auto i = grains.index_of(overlap.particle_id[k]);
    particle_force_[k] += transfer_.force[k];
    p.external_force[i] += particle_force_[k];
    p.external_torque[i] += transfer_.torque[k];
  }
  has_started_ = 1;
}

void ArlequinCoupling::start()
{
  balance_edge();
  const dem::Simulation &grains = grains_.simulation();
  const Overlap &overlap = penalty_.overlap();
  resting_place_ = displacement_at(overlap, body_.solid());
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    resting_place_[k] = grains.particles.position[grains.index_of(overlap.particle_id[k])] - resting_place_[k];
}

void ArlequinCoupling::compute_penalty(const std::span<double> fe_force)
{
  const dem::Simulation &grains = grains_.simulation();
  const Overlap &overlap = penalty_.overlap();
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    particle_displacement_[k] = grains.particles.position[grains.index_of(overlap.particle_id[k])] - resting_place_[k];
  state_ =
      penalty_.compute(particle_displacement_, std::as_const(body_.solid()).displacement(), particle_force_, fe_force);
}

void ArlequinCoupling::follow(const double time_step)
{
  drifted_ = time_step;
  transfer_work_ += 0.5 * drifted_ * work_of(transfer_);
  if (must_be_renewed())
    renew();
}

bool ArlequinCoupling::must_be_renewed() const
{
  return parameters_.renewal > 0. && (state_.largest_motion > farthest_ || stray_.may_have_come(grains_.simulation()));
}

void ArlequinCoupling::renew()
{
  std::vector<double> ignored(body_.solid().displacement().size(), 0.);
  compute_penalty(ignored); // the load densities at the present places
  const dem::Simulation &grains = grains_.simulation();
  const dem::Particles &p = grains.particles;
  const std::vector<Vec3> present = reference_places(body_.solid(), p.position);
  for (std::size_t i = 0; i < p.size(); ++i)
    reference_by_id_[p.id[i]] = present[i];

  Overlap overlap = overlap_of(p, body_, reference_by_id_);
  const std::vector<std::int64_t> old_id = penalty_.overlap().particle_id;
  std::unordered_map<std::int64_t, std::size_t> old_place;
  for (std::size_t k = 0; k < old_id.size(); ++k)
    old_place.emplace(old_id[k], k);
  const std::size_t n = overlap.n_particles();
  std::vector<Vec3> resting = displacement_at(overlap, body_.solid()), moved(n, Vec3::Zero());
  Transfer transfer{std::vector<Vec3>(n, Vec3::Zero()), std::vector<Vec3>(n, Vec3::Zero()), {}};
  for (std::size_t k = 0; k < n; ++k)
  {
    const std::int64_t id = overlap.particle_id[k];
    resting[k] = p.position[grains.index_of(id)] - resting[k];
    const auto old = old_place.find(id);
    if (old == old_place.end())
      continue;
    moved[k] = resting[k] - resting_place_[old->second];
    transfer.force[k] = transfer_.force[old->second];
    transfer.torque[k] = transfer_.torque[old->second];
  }
  resting_place_ = std::move(resting);
  transfer_ = std::move(transfer);
  grains_.change_weights(old_id, overlap.particle_id,
                         OverlapWeights(overlap, nodal_weight_, parameters_.least_weight).particle);
  weight_transfer_ = WeightTransfer(overlap);
  give_transfer_to_nodes();
  particle_displacement_.resize(n);
  particle_force_.resize(n);
  penalty_.renew(std::move(overlap), moved);
  look_at_overlap();
}

/// Notes when it has to be made anew.
void ArlequinCoupling::look_at_overlap()
{
  if (parameters_.renewal == 0.)
    return;
  const Overlap &overlap = penalty_.overlap();
  farthest_ = parameters_.renewal * overlap.mean_diameter();
  stray_ = StrayGrains(grains_.simulation().particles, overlap.particle_id, body_.solid(), farthest_);
}

/// Brings the transfer from the last step to this one, once.
void ArlequinCoupling::follow_transfer()
{
  if (has_started_ != 0 && drifted_ == 0.)
    return; // forces may be asked for again
  const dem::Simulation &grains = grains_.simulation();
  const dem::Particles &p = grains.particles;
  const Overlap &overlap = penalty_.overlap();
  const double share = has_started_ != 0 ? -std::expm1(-drifted_ / parameters_.transfer_time) : 1.;
  transfer_.force.resize(overlap.n_particles(), Vec3::Zero());
  transfer_.torque.resize(overlap.n_particles(), Vec3::Zero());
  if (p.are_weighted())
    for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    {
      const auto i = grains.index_of(overlap.particle_id[k]);
      transfer_.force[k] += share * (p.transfer_force[i] - transfer_.force[k]);
      transfer_.torque[k] += share * (p.transfer_torque[i] - transfer_.torque[k]);
    }
  give_transfer_to_nodes();
  if (has_started_ != 0)
    transfer_work_ += 0.5 * drifted_ * work_of(transfer_); // the first half is that of follow()
  drifted_ = 0.;
}

void ArlequinCoupling::give_transfer_to_nodes()
{
  transfer_.on_nodes.assign(body_.solid().displacement().size(), 0.);
  weight_transfer_.add_opposite(transfer_.force, transfer_.torque, transfer_.on_nodes);
}

/// Dead loads of the held grains, of what acts on them at this step; see HeldEdge.
void ArlequinCoupling::balance_edge()
{
  const dem::Simulation &grains = grains_.simulation();
  const dem::Particles &p = grains.particles;
  HeldEdge &edge = penalty_.edge();
  for (std::size_t k = 0; k < edge.size(); ++k)
  {
    const int coupled = edge.particles()[k];
    const auto i = grains.index_of(penalty_.overlap().particle_id[coupled]);
    edge.dead_load[k] =
        -(p.force[i] + transfer_.force[coupled] + p.weight[i] * p.mass[i] * grains.parameters().gravity);
  }
}

/// Of a transfer along the step that led here, over its time [W].
double ArlequinCoupling::work_of(const Transfer &transfer) const
{
  const dem::Simulation &grains = grains_.simulation();
  const dem::Particles &p = grains.particles;
  const Overlap &overlap = penalty_.overlap();
  double sum = 0.;
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
  {
    const auto i = grains.index_of(overlap.particle_id[k]);
    sum += transfer.force[k].dot(p.drift_velocity[i]) + transfer.torque[k].dot(p.angular_velocity[i]);
  }
  const std::span<const double> velocity = std::as_const(body_.solid()).velocity();
  for (const int node : overlap.nodes)
    for (int d = 0; d < 3; ++d)
      sum += transfer.on_nodes[3 * node + d] * velocity[3 * node + d];
  return sum;
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
