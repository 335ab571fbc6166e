#include "coupling/adapter/arlequin_coupling.h"

#include "coupling/adapter/dealii_adapter.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace bergamo::coupling
{
namespace
{

/// The overlap of a body and of all grains, in the order of their ids: it is the same after a restart.
Overlap overlap_of(const dem::Particles &p, const SolidMover &body, const std::span<const Vec3> reference_by_id)
{
  std::vector<std::int32_t> order(p.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](const auto i, const auto j) { return p.id[i] < p.id[j]; });
  std::vector<std::int64_t> id;
  std::vector<Vec3> reference;
  std::vector<double> volume;
  for (const std::int32_t i : order)
  {
    id.push_back(p.id[i]);
    reference.push_back(reference_by_id[p.id[i]]);
    volume.push_back(p.volume[i]);
  }
  return make_overlap(body.solid(), id, reference, volume);
}

/// Sets the weights of both models on the way.
PenaltyCoupling set_up(GrainsMover &grains, SolidMover &body, const CouplingParameters &parameters,
                       const OverlapPlace &place)
{
  if (!(parameters.transfer_time > 0.) || !std::isfinite(parameters.transfer_time))
    reject("the transfer time of an overlap is ", parameters.transfer_time,
           " s; it must be positive: long beside the oscillations of grains and elements, short beside the loading");
  parameters.edge.validate();
  const Overlap overlap = overlap_of(grains.simulation().particles, body, place.reference_by_id);
  std::vector<double> node_weight;
  for (const int node : overlap.nodes)
    node_weight.push_back(place.nodal_weight[node]);
  const std::vector<double> weight = particle_weights(overlap, node_weight, parameters.least_weight);
  grains.set_weights(overlap.particle_id, weight);
  body.add_weights(place.nodal_weight);
  PenaltyCoupling penalty(overlap, parameters.projection, parameters.penalty);
  penalty.hold(HeldEdge(overlap, node_weight, weight, parameters.edge));
  return penalty;
}

} // namespace

ArlequinCoupling::ArlequinCoupling(GrainsMover &grains, SolidMover &body, const CouplingParameters &parameters,
                                   const OverlapPlace &place, std::string name)
    : Coupling(std::move(name)), grains_(grains), body_(body), penalty_(set_up(grains, body, parameters, place)),
      weight_transfer_(penalty_.overlap()), transfer_time_(parameters.transfer_time),
      particle_displacement_(penalty_.overlap().n_particles()), particle_force_(penalty_.overlap().n_particles())
{
  dem::Particles &p = grains.simulation().particles;
  for (std::vector<Vec3> *external : {&p.external_force, &p.external_torque})
    if (external->empty())
      external->assign(p.size(), Vec3::Zero());
}

void ArlequinCoupling::apply()
{
  dem::Simulation &grains = grains_.simulation();
  dem::Particles &p = grains.particles;
  const Overlap &overlap = penalty_.overlap();
  follow_transfer();
  if (has_started_ == 0)
    start();
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    particle_displacement_[k] = p.position[grains.index_of(overlap.particle_id[k])] - resting_place_[k];
  const std::span<double> fe_force = body_.solid().external_force();
  state_ = penalty_.compute(particle_displacement_, body_.solid().displacement(), particle_force_, fe_force);
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
  const std::span<const double> displacement = std::as_const(body_.solid()).displacement();
  std::vector<Vec3> of_nodes;
  for (const int node : overlap.nodes)
    of_nodes.push_back(Eigen::Map<const Vec3>(&displacement[3 * node]));
  resting_place_.resize(overlap.n_particles());
  penalty_.projection().interpolate(of_nodes, resting_place_);
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    resting_place_[k] = grains.particles.position[grains.index_of(overlap.particle_id[k])] - resting_place_[k];
}

/// Brings the transfer from the last step to this one, once.
void ArlequinCoupling::follow_transfer()
{
  if (has_started_ != 0 && drifted_ == 0.)
    return; // forces may be asked for again
  const dem::Simulation &grains = grains_.simulation();
  const dem::Particles &p = grains.particles;
  const Overlap &overlap = penalty_.overlap();
  const double work_before = has_started_ != 0 ? work_of(transfer_) : 0.;
  const double share = has_started_ != 0 ? -std::expm1(-drifted_ / transfer_time_) : 1.;
  transfer_.force.resize(overlap.n_particles(), Vec3::Zero());
  transfer_.torque.resize(overlap.n_particles(), Vec3::Zero());
  if (p.are_weighted())
    for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    {
      const auto i = grains.index_of(overlap.particle_id[k]);
      transfer_.force[k] += share * (p.transfer_force[i] - transfer_.force[k]);
      transfer_.torque[k] += share * (p.transfer_torque[i] - transfer_.torque[k]);
    }
  transfer_.on_nodes.assign(body_.solid().displacement().size(), 0.);
  weight_transfer_.add_opposite(transfer_.force, transfer_.torque, transfer_.on_nodes);
  if (has_started_ != 0)
    transfer_work_ += 0.5 * drifted_ * (work_before + work_of(transfer_));
  drifted_ = 0.;
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
