#include "coupling/arlequin/weight_transfer.h"

#include <Eigen/Geometry>

namespace bergamo::coupling
{

WeightTransfer::WeightTransfer(std::shared_ptr<const ElementBlocks> blocks, std::vector<int> nodes)
    : blocks_(std::move(blocks)), nodes_(std::move(nodes))
{
}

// A couple t is the node forces t x grad N / 2: their moment is t, as sum x_I grad N_I = 1, and they move the nodes
// like a spin about t. The gradient of N_I is that of its products, and that of a product is the sum over its factors
// of the product of the others times the gradient of the factor.
ElementBlocks::Eights WeightTransfer::node_loads(const std::size_t number, const std::span<const Padded> force,
                                                 const std::span<const Padded> torque) const
{
  const ElementBlocks::Block &block = blocks_->blocks()[number];
  const auto moments_of = [&](const std::span<const Padded> values)
  {
    return blocks_->moments_of(block, [&](const std::size_t particle, const ElementBlocks::Products &)
                               { return values[particle - block.begin]; });
  };
  ElementBlocks::Eights moments = moments_of(force);
  const auto add_couples = [&](const ElementBlocks::Eights &of_torque, const Eigen::Matrix3d &local_gradient)
  {
    for (int product = 0; product < 8; ++product)
      for (int axis = 0; axis < 3; ++axis)
        if (const int factor = 1 << axis; (product & factor) != 0)
          moments[product] += padded(0.5 * unpadded(of_torque[product ^ factor]).cross(local_gradient.col(axis)));
  };
  if (!block.is_skewed)
    add_couples(moments_of(torque), block.local_gradient);
  for (std::size_t k = 0; block.is_skewed && k < torque.size(); ++k)
  {
    ElementBlocks::Eights of_one{};
    blocks_->products(block.begin + k).add_to(of_one, torque[k]);
    add_couples(of_one, blocks_->local_gradient(number, block.begin + k));
  }
  return ElementBlocks::at_nodes(moments);
}

void WeightTransfer::add_opposite(const std::span<const Eigen::Vector3d> force,
                                  const std::span<const Eigen::Vector3d> torque, const std::span<double> fe_force) const
{
  add_opposite(
      [&](std::size_t, const std::size_t particle) {
        return Load{force[particle], torque[particle]};
      },
      fe_force);
}

} // namespace bergamo::coupling
