#include "coupling/arlequin/held_edge.h"

#include "dem/core/error.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace bergamo::coupling
{
namespace
{

/// Mean diameter of spheres of the particles' volumes [m].
double mean_diameter(const Overlap &overlap)
{
  double sum = 0.;
  for (const double volume : overlap.particle_volume)
    sum += std::cbrt(6. * volume / std::numbers::pi);
  return sum / static_cast<double>(overlap.n_particles());
}

} // namespace

void EdgeParameters::validate() const
{
  if (!(depth >= 0.) || !std::isfinite(depth))
    reject("the depth of the held edge of an overlap is ", depth,
           " grains; it must be 0, for none, or positive: 1 to 2 holds those that have lost neighbours");
  if (!(stiffness > 0.) || !std::isfinite(stiffness))
    reject("the stiffness of the held edge of an overlap is ", stiffness,
           " Pa/m^2; it must be positive, about that of a grain's contacts over its volume");
}

HeldEdge::HeldEdge(const Overlap &overlap, const std::span<const double> node_weight,
                   const std::span<const double> particle_weight, const EdgeParameters &parameters)
{
  parameters.validate();
  if (parameters.depth == 0.)
    return;
  const double depth = parameters.depth * mean_diameter(overlap);
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
    particle_.push_back(static_cast<int>(particle));
    stiffness_.push_back(parameters.stiffness * particle_weight[particle] * overlap.particle_volume[particle]);
  }
  dead_load.assign(size(), Eigen::Vector3d::Zero());
}

double HeldEdge::add_springs(const std::span<const Eigen::Vector3d> difference,
                             const std::span<Eigen::Vector3d> force) const
{
  double energy = 0.;
  for (std::size_t k = 0; k < size(); ++k)
  {
    const Eigen::Vector3d &d = difference[particle_[k]];
    force[particle_[k]] -= stiffness_[k] * d;
    energy += 0.5 * stiffness_[k] * d.squaredNorm();
  }
  return energy;
}

double HeldEdge::add_dead_loads(const std::span<const Eigen::Vector3d> difference,
                                const std::span<Eigen::Vector3d> force) const
{
  double energy = 0.;
  for (std::size_t k = 0; k < size(); ++k)
  {
    force[particle_[k]] += dead_load[k];
    energy -= dead_load[k].dot(difference[particle_[k]]);
  }
  return energy;
}

} // namespace bergamo::coupling
