#include "coupling/arlequin/weight.h"

#include "dem/core/error.h"

#include <algorithm>

namespace bergamo::coupling
{

double weight_at(const WeightShape shape, const double share)
{
  const double s = std::clamp(share, 0., 1.);
  return shape == WeightShape::linear ? s : s * s * (3. - 2. * s);
}

std::vector<double> particle_weights(const Overlap &overlap, const std::span<const double> node_weight,
                                     const double min_weight)
{
  if (!(min_weight > 0. && min_weight <= 1.))
    reject("least weight ", min_weight, " of the coupled models: take a value in (0, 1], e.g. ", default_min_weight);
  if (node_weight.size() != overlap.n_nodes())
    reject(node_weight.size(), " weights for ", overlap.n_nodes(), " coupling nodes: give one a node");
  for (std::size_t node = 0; node < node_weight.size(); ++node)
    if (!(node_weight[node] >= 0. && node_weight[node] <= 1.))
      reject("weight ", node_weight[node], " of the coupling node at ", overlap.node_position[node].transpose(),
             " m: take values in [0, 1]");

  std::vector<double> weight(overlap.n_particles());
  for (std::size_t particle = 0; particle < weight.size(); ++particle)
  {
    double sum = 0.;
    for (std::size_t k = overlap.shape_offset[particle]; k < overlap.shape_offset[particle + 1]; ++k)
      sum += overlap.shape_value[k] * node_weight[overlap.shape_node[k]];
    weight[particle] = std::clamp(sum, min_weight, 1.);
  }
  return weight;
}

} // namespace bergamo::coupling
