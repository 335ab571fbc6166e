#include "coupling/arlequin/weight_transfer.h"

#include "dem/core/parallel.h"

#include <Eigen/Geometry>

namespace bergamo::coupling
{

WeightTransfer::WeightTransfer(const Overlap &overlap)
    : nodes_(overlap.nodes),
      of_node_(overlap.n_nodes(),
               [&](const auto &put)
               {
                 for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
                   for (std::size_t k = overlap.shape_offset[particle]; k < overlap.shape_offset[particle + 1]; ++k)
                     put(overlap.shape_node[k],
                         {static_cast<int>(particle), overlap.shape_value[k], overlap.shape_gradient[k]});
               })
{
}

void WeightTransfer::add_opposite(const std::span<const Eigen::Vector3d> force,
                                  const std::span<const Eigen::Vector3d> torque, const std::span<double> fe_force) const
{
  // A couple t is the node forces t x grad N / 2: their moment is t, as sum x_I grad N_I = 1, and they move the nodes
  // like a spin about t.
  parallel_for(nodes_.size(),
               [&](const std::size_t node)
               {
                 Eigen::Vector3d sum = Eigen::Vector3d::Zero();
                 for (const ShapeFunction &n : of_node_[node])
                   sum += n.value * force[n.particle] + 0.5 * torque[n.particle].cross(n.gradient);
                 Eigen::Map<Eigen::Vector3d>(fe_force.data() + 3 * nodes_[node]) -= sum;
               });
}

} // namespace bergamo::coupling
