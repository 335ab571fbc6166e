#include "coupling/adapter/arlequin_coupling.h"

#include "coupling/adapter/dealii_adapter.h"
#include "coupling/adapter/overlap_setup.h"
#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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
  const dem::Particles &p = grains.simulation().particles;
  const Overlap overlap = overlap_of(p, body, place.reference_by_id, place.nodal_weight,
                                     parameters.surface_reach * mean_diameter(p.volume));
  const OverlapWeights weights(overlap, place.nodal_weight, parameters.least_weight);
  grains.set_weights(overlap.particle_id, weights.particle);
  body.add_weights(place.nodal_weight);
  PenaltyCoupling penalty(overlap, parameters.projection, parameters.penalty);
  penalty.hold(HeldEdge(overlap, weights.node, weights.particle, parameters.edge));
  return penalty;
}

constexpr std::size_t ahead = 32; // grains, about as long as memory takes to answer

/// Fetches what will be asked of the engine's arrays: the grains of an element are near one another there, in any
/// order.
template <class... Arrays>
BERGAMO_INLINE void prefetch(const std::vector<std::int32_t> &index, const std::size_t k, const Arrays &...arrays)
{
  const std::int32_t later = index[std::min(k + ahead, index.size() - 1)];
  (__builtin_prefetch(arrays.data() + later), ...);
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
  if (!(surface_reach >= 0.) || !std::isfinite(surface_reach))
    reject(
        "an overlap reaches ", surface_reach,
        " diameters above a free surface; it must be 0, for its elements alone, or positive: 3 take all that settles");
  edge.validate();
}

ArlequinCoupling::ArlequinCoupling(GrainsMover &grains, SolidMover &body, const CouplingParameters &parameters,
                                   const OverlapPlace &place, std::string name)
    : Coupling(std::move(name)), grains_(grains), body_(body), penalty_(set_up(grains, body, parameters, place)),
      weight_transfer_(penalty_.projection().blocks(), penalty_.overlap().nodes), parameters_(parameters),
      nodal_weight_(place.nodal_weight.begin(), place.nodal_weight.end()),
      reference_by_id_(place.reference_by_id.begin(), place.reference_by_id.end())
{
  dem::Particles &p = grains.simulation().particles;
  for (std::vector<Vec3> *external : {&p.external_force, &p.external_torque})
    if (external->empty())
      external->assign(p.size(), Vec3::Zero());
  look_at_overlap();
}

void ArlequinCoupling::apply()
{
  find_particles();
  give_transfer();
  if (has_started_ == 0)
    start();
  balance_edge(fresh_);
  fresh_.clear();
  limit_edge();
  has_just_moved_ = false;
  const std::span<double> fe_force = body_.solid().external_force();
  for (std::size_t dof = 0; dof < fe_force.size(); ++dof)
    fe_force[dof] += transfer_.on_nodes[dof];
  std::vector<Vec3> &external = grains_.simulation().particles.external_force;
  compute_penalty(
      [&](const std::size_t k, const Vec3 &force)
      {
        prefetch(index_, k, external);
        external[index_[k]] += force;
      },
      fe_force);
  has_started_ = 1;
}

/// Where the grains are in the engine's arrays, which it sorts now and then.
void ArlequinCoupling::find_particles()
{
  const dem::Simulation &grains = grains_.simulation();
  if (seen_order_ == grains.n_orders())
    return;
  index_.clear();
  for (const std::int64_t id : penalty_.overlap().particle_id)
    index_.push_back(grains.index_of(id));
  seen_order_ = grains.n_orders();
}

void ArlequinCoupling::start()
{
  fresh_.resize(penalty_.edge().size());
  std::iota(fresh_.begin(), fresh_.end(), std::size_t(0));
  const dem::Particles &p = grains_.simulation().particles;
  resting_place_ = displacement_at(penalty_.overlap(), body_.solid());
  for (std::size_t k = 0; k < resting_place_.size(); ++k)
    resting_place_[k] = p.position[index_[k]] - resting_place_[k];
}

template <class AddForce>
void ArlequinCoupling::compute_penalty(const AddForce &add_force, const std::span<double> fe_force)
{
  const std::vector<Vec3> &position = grains_.simulation().particles.position;
  const auto displacement = [&](const std::size_t k)
  {
    prefetch(index_, k, position);
    return Vec3(position[index_[k]] - resting_place_[k]);
  };
  state_ = penalty_.compute(displacement, std::as_const(body_.solid()).displacement(), add_force, fe_force);
}

void ArlequinCoupling::follow(const double time_step)
{
  drifted_ = time_step;
  if (must_be_renewed())
    renew();
}

bool ArlequinCoupling::must_be_renewed()
{
  return parameters_.renewal > 0. && (state_.largest_motion > farthest_ || stray_.may_have_come(grains_.simulation()));
}

void ArlequinCoupling::renew()
{
  find_particles();
  std::vector<double> ignored(body_.solid().displacement().size(), 0.);
  compute_penalty([](std::size_t, const Vec3 &) {}, ignored); // the load densities at the present places
  transfer_work_ += 0.5 * drifted_ * power_of(transfer_);     // until here; what apply() books anew is taken off below
  const dem::Simulation &grains = grains_.simulation();
  const dem::Particles &p = grains.particles;
  const std::vector<Vec3> present = reference_places(body_.solid(), p.position, reach());
  for (std::size_t i = 0; i < p.size(); ++i)
    reference_by_id_[p.id[i]] = present[i];

  Overlap overlap = overlap_of(p, body_, reference_by_id_, nodal_weight_, reach());
  const std::vector<std::int64_t> old_id = penalty_.overlap().particle_id;
  std::unordered_map<std::int64_t, std::size_t> old_place;
  for (std::size_t k = 0; k < old_id.size(); ++k)
    old_place.emplace(old_id[k], k);
  const std::size_t n = overlap.n_particles();
  std::vector<Vec3> resting = displacement_at(overlap, body_.solid()), moved(n, Vec3::Zero());
  Transfer transfer(n);
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
  penalty_.renew(std::move(overlap), moved);
  weight_transfer_ = WeightTransfer(penalty_.projection().blocks(), penalty_.overlap().nodes);
  transfer_.on_nodes.assign(body_.solid().displacement().size(), 0.);
  weight_transfer_.add_opposite(transfer_.force, transfer_.torque, transfer_.on_nodes);
  look_at_overlap();
  find_particles();
  transfer_work_ -= 0.5 * drifted_ * power_of(transfer_);
}

void ArlequinCoupling::move_to(const OverlapPlace &place)
{
  for (std::size_t id = reference_by_id_.size(); id < place.reference_by_id.size(); ++id)
    reference_by_id_.push_back(place.reference_by_id[id]);
  body_.change_weights(nodal_weight_, place.nodal_weight);
  nodal_weight_.assign(place.nodal_weight.begin(), place.nodal_weight.end());
  renew();
  const OverlapWeights weights(penalty_.overlap(), nodal_weight_, parameters_.least_weight);
  penalty_.hold_instead(HeldEdge(penalty_.overlap(), weights.node, weights.particle, parameters_.edge), fresh_);
  has_just_moved_ = true;
}

/// Of the overlap beside its elements [m].
double ArlequinCoupling::reach() const
{
  return parameters_.surface_reach * mean_diameter(grains_.simulation().particles.volume);
}

/// Notes when it has to be made anew.
void ArlequinCoupling::look_at_overlap()
{
  seen_order_ = -1;
  if (parameters_.renewal == 0.)
    return;
  const Overlap &overlap = penalty_.overlap();
  farthest_ = parameters_.renewal * overlap.mean_diameter();
  stray_ = StrayGrains(grains_.simulation().particles, overlap.particle_id, body_.solid(), {farthest_, reach()});
}

/// Brings the transfer from the last step to this one, once, and puts it on the grains; the opposite becomes that of
/// the nodes.
void ArlequinCoupling::give_transfer()
{
  dem::Particles &p = grains_.simulation().particles;
  const bool is_first = has_just_come();
  const double share = !p.are_weighted() ? 0. : is_first ? 1. : -std::expm1(-drifted_ / parameters_.transfer_time);
  transfer_.resize(penalty_.overlap().n_particles());
  const double half_step = is_first ? 0. : 0.5 * drifted_;
  if (half_step > 0.)
    transfer_work_ += half_step * power_on_nodes(transfer_);

  // The power of each block's grains, before and after, along the step that led here.
  std::vector<double> power(penalty_.projection().blocks()->blocks().size(), 0.);
  transfer_.on_nodes.assign(body_.solid().displacement().size(), 0.);
  weight_transfer_.add_opposite(
      [&](const std::size_t block, const std::size_t k)
      {
        const std::int32_t i = index_[k];
        prefetch(index_, k, p.transfer_force, p.transfer_torque, p.drift_velocity, p.angular_velocity, p.external_force,
                 p.external_torque);
        Vec3 &force = transfer_.force[k], &torque = transfer_.torque[k];
        if (share > 0.)
        {
          const Vec3 more_force = share * (p.transfer_force[i] - force),
                     more_torque = share * (p.transfer_torque[i] - torque);
          power[block] += (2. * force + more_force).dot(p.drift_velocity[i]) +
                          (2. * torque + more_torque).dot(p.angular_velocity[i]);
          force += more_force;
          torque += more_torque;
        }
        p.external_force[i] += force;
        p.external_torque[i] += torque;
        return WeightTransfer::Load{force, torque};
      },
      transfer_.on_nodes);
  if (half_step > 0.)
    transfer_work_ += half_step * (std::accumulate(power.begin(), power.end(), 0.) + power_on_nodes(transfer_));
  drifted_ = 0.;
}

/// Dead loads of the held grains, of what acts on them at this step; see HeldEdge.
void ArlequinCoupling::balance_edge(const std::span<const std::size_t> held)
{
  const dem::Simulation &grains = grains_.simulation();
  const dem::Particles &p = grains.particles;
  HeldEdge &edge = penalty_.edge();
  for (const std::size_t k : held)
  {
    const int coupled = edge.particles()[k];
    const std::int32_t i = index_[coupled];
    edge.dead_load[k] =
        -(p.force[i] + transfer_.force[coupled] + p.weight[i] * p.mass[i] * grains.parameters().gravity);
  }
}

/// Strengths of the held grains' springs, of their transfer at this step. A spring bears the dead load, too, where the
/// contacts go that it was in balance with.
void ArlequinCoupling::limit_edge()
{
  if (parameters_.edge.strength == 0.)
    return;
  HeldEdge &edge = penalty_.edge();
  edge.strength.resize(edge.size());
  for (std::size_t k = 0; k < edge.size(); ++k)
    edge.strength[k] =
        edge.dead_load[k].norm() + parameters_.edge.strength * transfer_.force[edge.particles()[k]].norm();
}

/// Of a transfer along the step that led here [W].
double ArlequinCoupling::power_of(const Transfer &transfer) const
{
  const dem::Particles &p = grains_.simulation().particles;
  double sum = power_on_nodes(transfer);
  for (std::size_t k = 0; k < transfer.force.size(); ++k)
    sum += transfer.force[k].dot(p.drift_velocity[index_[k]]) + transfer.torque[k].dot(p.angular_velocity[index_[k]]);
  return sum;
}

double ArlequinCoupling::power_on_nodes(const Transfer &transfer) const
{
  double sum = 0.;
  const std::span<const double> velocity = std::as_const(body_.solid()).velocity();
  for (const int node : penalty_.overlap().nodes)
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
