#include "coupling/arlequin/weight.h"

#include <sstream>
#include <stdexcept>

namespace bergamo::coupling
{

std::vector<double> particle_weights(const Overlap &overlap, const std::span<const double> node_weight,
                                     const double min_weight)
{
  std::ostringstream message;
  if (!(min_weight > 0. && min_weight <= 1.))
  {
    message << "least weight " << min_weight << " of the coupled models: take a value in (0, 1], e.g. "
            << default_min_weight;
    throw std::invalid_argument(message.str());
  }
  if (node_weight.size() != overlap.n_nodes())
  {
    message << node_weight.size() << " weights for " << overlap.n_nodes() << " coupling nodes: give one a node";
    throw std::invalid_argument(message.str());
  }
  for (std::size_t node = 0; node < node_weight.size(); ++node)
    if (!(node_weight[node] >= 0. && node_weight[node] <= 1.))
    {
      message << "weight " << node_weight[node] << " of the coupling node at "
              << overlap.node_position[node].transpose() << " m: take values in [0, 1]";
      throw std::invalid_argument(message.str());
    }

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
