#include "coupling/arlequin/held_edge.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace bergamo::coupling
{
void EdgeParameters::validate() const
{
  if (!(depth >= 0.) || !std::isfinite(depth))
    reject("the depth of the held edge of an overlap is ", depth,
           " grains; it must be 0, for none, or positive: 1 to 2 holds those that have lost neighbours");
  if (!(stiffness > 0.) || !std::isfinite(stiffness))
    reject("the stiffness of the held edge of an overlap is ", stiffness,
           " Pa/m^2; it must be positive, about that of a grain's contacts over its volume");
  if (!(strength >= 0.) || !std::isfinite(strength))
    reject("the strength of the held edge of an overlap is ", strength,
           "; it must be 0, for springs that hold any force, or positive: about 1 lets grains slide as neighbours do");
}

HeldEdge::HeldEdge(const Overlap &overlap, const std::span<const double> node_weight,
                   const std::span<const double> particle_weight, const EdgeParameters &parameters)
{
  parameters.validate();
  if (parameters.depth == 0.)
    return;
  const double depth = parameters.depth * overlap.mean_diameter();
  for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
  {
    double weight = 0.;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero(); // [1/m]
    for (std::size_t k = overlap.shape_offset[particle]; k < overlap.shape_offset[particle + 1]; ++k)
    {
      weight += overlap.shape_value[k] * node_weight[overlap.shape_node[k]];
      gradient += node_weight[overlap.shape_node[k]] * overlap.shape_gradient[k];
    }
    if (!(weight < depth * gradient.norm()))
      continue;
    for (std::size_t k = overlap.shape_offset[particle]; k < overlap.shape_offset[particle + 1]; ++k)
      node_.push_back(overlap.nodes[overlap.shape_node[k]]);
    place_.push_back(overlap.local_place(particle));
    id_.push_back(overlap.particle_id[particle]);
    particle_.push_back(static_cast<std::int32_t>(particle));
    stiffness_.push_back(parameters.stiffness * particle_weight[particle] * overlap.particle_volume[particle]);
  }
  dead_load.assign(size(), Eigen::Vector3d::Zero());
  shift_.assign(size(), Eigen::Vector3d::Zero());
  stretch_.assign(size(), Eigen::Vector3d::Zero());
}

double HeldEdge::add_forces(const std::span<const Eigen::Vector3d> particle_displacement,
                            const std::span<const double> fe_displacement,
                            const std::span<Eigen::Vector3d> particle_force, const std::span<double> fe_force,
                            const Loads loads)
{
  if (dead_load.size() != size() || (!strength.empty() && strength.size() != size()))
    reject("the held edge of an overlap has ", size(), " grains, ", dead_load.size(), " dead loads and ",
           strength.size(), " strengths; give each grain one of both, or none a strength");
  energy_.assign(size(), 0.);
  double sum = 0.;
  for (std::size_t begin = 0, end = 0; begin < size(); begin = end)
  {
    end = end_of_element(begin);
    const std::int32_t *const nodes = &node_[n_nodes * begin];
    ElementBlocks::Eights at_nodes, of_forces{};
    for (std::size_t n = 0; n < n_nodes; ++n)
      at_nodes[n] = padded(Eigen::Map<const Eigen::Vector3d>(&fe_displacement[3 * nodes[n]]));
    const ElementBlocks::Eights field = ElementBlocks::coefficients(at_nodes);
    for (std::size_t k = begin; k < end; ++k)
    {
      const ElementBlocks::Products at(place_[k]);
      Eigen::Vector3d difference = particle_displacement[k] - unpadded(at.value_of(field));
      if (loads == Loads::all)
      {
        difference += shift_[k];
        slip(k, difference);
        stretch_[k] = difference;
      }
      Eigen::Vector3d force = -stiffness_[k] * difference;
      energy_[k] = 0.5 * stiffness_[k] * difference.squaredNorm();
      if (loads == Loads::all)
      {
        force += dead_load[k];
        energy_[k] -= dead_load[k].dot(difference);
      }
      particle_force[k] = force;
      at.add_to(of_forces, padded(force));
      sum += energy_[k];
    }
    at_nodes = ElementBlocks::at_nodes(of_forces);
    for (std::size_t n = 0; n < n_nodes; ++n)
      Eigen::Map<Eigen::Vector3d>(fe_force.data() + 3 * nodes[n]) -= unpadded(at_nodes[n]);
  }
  return sum;
}

/// Lets a spring slip that is stretched beyond its strength: it keeps the direction. Over the slip of one step the
/// force is that of its end, so the loss is of first order in the step.
void HeldEdge::slip(const std::size_t k, Eigen::Vector3d &stretch)
{
  if (strength.empty())
    return;
  const double pull = stiffness_[k] * stretch.norm();
  if (!(pull > strength[k]))
    return;
  const Eigen::Vector3d slipped = (1. - strength[k] / pull) * stretch;
  stretch -= slipped;
  shift_[k] -= slipped;
  slip_loss_ += (0.5 * stiffness_[k] * (stretch_[k] + stretch) - dead_load[k]).dot(slipped);
}

/// Of particles in the same element that follow one another.
std::size_t HeldEdge::end_of_element(const std::size_t k) const
{
  const auto nodes_of = [&](const std::size_t particle) { return node_.begin() + n_nodes * particle; };
  std::size_t end = k + 1;
  while (end < size() && std::equal(nodes_of(k), nodes_of(k + 1), nodes_of(end)))
    ++end;
  return end;
}

double HeldEdge::renew(const Overlap &overlap, const std::span<const Eigen::Vector3d> moved)
{
  std::unordered_map<std::int64_t, std::int32_t> place;
  for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
    place.emplace(overlap.particle_id[particle], static_cast<std::int32_t>(particle));
  energy_.resize(size(), 0.); // none is known before the first add_forces()
  double let_go = 0.;
  std::vector<bool> is_gone(size(), false);
  for (std::size_t k = 0; k < size(); ++k)
    if (const auto found = place.find(id_[k]); found != place.end())
    {
      particle_[k] = found->second;
      shift_[k] += moved[found->second];
    }
    else
    {
      is_gone[k] = true;
      let_go += energy_[k];
    }
  remove(is_gone);
  return let_go;
}

double HeldEdge::become(HeldEdge other, std::vector<std::size_t> &fresh)
{
  std::unordered_map<std::int64_t, std::size_t> own;
  for (std::size_t k = 0; k < size(); ++k)
    own.emplace(id_[k], k);
  energy_.resize(size(), 0.);
  double let_go = std::accumulate(energy_.begin(), energy_.end(), 0.);
  other.energy_.assign(other.size(), 0.);
  for (std::size_t k = 0; k < other.size(); ++k)
    if (const auto found = own.find(other.id_[k]); found != own.end())
    {
      const std::int32_t particle = other.particle_[k];
      other.copy(found->second, *this, k);
      other.particle_[k] = particle;
      let_go -= energy_[found->second];
    }
    else
      fresh.push_back(k);
  other.slip_loss_ = slip_loss_;
  *this = std::move(other);
  return let_go;
}

/// A particle of another edge, or of this one, as one of its own.
void HeldEdge::copy(const std::size_t from, const HeldEdge &other, const std::size_t to)
{
  id_[to] = other.id_[from];
  particle_[to] = other.particle_[from];
  stiffness_[to] = other.stiffness_[from];
  shift_[to] = other.shift_[from];
  dead_load[to] = other.dead_load[from];
  stretch_[to] = other.stretch_[from];
  place_[to] = other.place_[from];
  energy_[to] = other.energy_[from];
  std::copy_n(other.node_.begin() + n_nodes * from, n_nodes, node_.begin() + n_nodes * to);
}

void HeldEdge::remove(const std::vector<bool> &is_gone)
{
  std::size_t kept = 0;
  for (std::size_t k = 0; k < is_gone.size(); ++k)
    if (!is_gone[k])
      copy(k, *this, kept++);
  id_.resize(kept);
  particle_.resize(kept);
  stiffness_.resize(kept);
  shift_.resize(kept);
  dead_load.resize(kept);
  strength.clear();
  stretch_.resize(kept);
  place_.resize(kept);
  energy_.resize(kept);
  node_.resize(n_nodes * kept);
}

} // namespace bergamo::coupling
