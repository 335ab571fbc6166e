#include "coupling/adapter/overlap_setup.h"

#include "coupling/adapter/dealii_adapter.h"
#include "coupling/arlequin/weight.h"

#include <algorithm>
#include <numeric>

namespace bergamo::coupling
{

Overlap overlap_of(const dem::Particles &p, const SolidMover &body, const std::span<const Vec3> reference_by_id,
                   const std::span<const double> nodal_weight, const double reach)
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
  return make_overlap(body.solid(), id, reference, volume, nodal_weight, reach);
}

OverlapWeights::OverlapWeights(const Overlap &overlap, const std::span<const double> nodal_weight,
                               const double least_weight)
{
  for (const int number : overlap.nodes)
    node.push_back(nodal_weight[number]);
  particle = particle_weights(overlap, node, least_weight);
}

std::vector<Vec3> displacement_at(const Overlap &overlap, const fe::ExplicitBody &body)
{
  std::vector<Vec3> displacement(overlap.n_particles(), Vec3::Zero());
  for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
    for (std::size_t k = overlap.shape_offset[particle]; k < overlap.shape_offset[particle + 1]; ++k)
    {
      const std::size_t node = overlap.nodes[overlap.shape_node[k]];
      displacement[particle] += overlap.shape_value[k] * Eigen::Map<const Vec3>(&body.displacement()[3 * node]);
    }
  return displacement;
}

} // namespace bergamo::coupling
