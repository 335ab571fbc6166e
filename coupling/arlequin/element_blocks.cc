#include "coupling/arlequin/element_blocks.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <limits>

namespace bergamo::coupling
{
namespace
{

using Eights = ElementBlocks::Eights;

/// Gradients of the local coordinates, from the directions in which these grow.
Eigen::Matrix3d inverse_transposed(const Eigen::Vector3d &along_x, const Eigen::Vector3d &along_y,
                                   const Eigen::Vector3d &along_z)
{
  Eigen::Matrix3d gradient;
  gradient << along_y.cross(along_z), along_z.cross(along_x), along_x.cross(along_y);
  return gradient / along_x.dot(gradient.col(0));
}

/// Whether the edges of an element are parallel, up to the rounding of its nodes' places.
bool is_parallelepiped(const Eights &geometry, const double largest_coordinate)
{
  const double rounding = 4. * std::numeric_limits<double>::epsilon() * largest_coordinate;
  return std::all_of(geometry.begin(), geometry.end(),
                     [&, k = 0](const Padded &c) mutable
                     {
                       const int product = k++;
                       return product < 3 || product == 4 || unpadded(c).lpNorm<Eigen::Infinity>() <= rounding;
                     });
}

} // namespace

ElementBlocks::ElementBlocks(const Overlap &overlap)
{
  const auto nodes_of = [&](const std::size_t particle)
  {
    std::array<int, 8> nodes;
    std::copy_n(overlap.shape_node.begin() + overlap.shape_offset[particle], 8, nodes.begin());
    return nodes;
  };
  for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
  {
    place_.push_back(overlap.local_place(particle));
    const std::array<int, 8> nodes = nodes_of(particle);
    if (blocks_.empty() || blocks_.back().nodes != nodes || particle - blocks_.back().begin == longest)
      blocks_.push_back({particle, particle, nodes, false, Eigen::Matrix3d::Zero()});
    blocks_.back().end = particle + 1;
  }
  for (Block &block : blocks_)
  {
    double largest = 0.;
    for (const int node : block.nodes)
      largest = std::max(largest, overlap.node_position[node].lpNorm<Eigen::Infinity>());
    geometry_.push_back(
        coefficients(block, [&](const int node) -> const Eigen::Vector3d & { return overlap.node_position[node]; }));
    const Eights &g = geometry_.back();
    block.is_skewed = !is_parallelepiped(g, largest);
    block.local_gradient = inverse_transposed(unpadded(g[1]), unpadded(g[2]), unpadded(g[4]));
  }
  corners_ = {overlap.n_nodes(), [&](const auto &put)
              {
                for (std::size_t block = 0; block < blocks_.size(); ++block)
                  for (int corner = 0; corner < 8; ++corner)
                    put(blocks_[block].nodes[corner], {static_cast<int>(block), corner});
              }};
}

std::array<double, 8> ElementBlocks::shape_values(const std::size_t particle) const
{
  std::array<double, 8> shape;
  for (int corner = 0; corner < 8; ++corner)
  {
    shape[corner] = 0.125;
    for (int axis = 0; axis < 3; ++axis)
      shape[corner] *= (corner >> axis & 1) != 0 ? 1. + place_[particle][axis] : 1. - place_[particle][axis];
  }
  return shape;
}

Eigen::Matrix3d ElementBlocks::local_gradient(const std::size_t block, const std::size_t particle) const
{
  if (!blocks_[block].is_skewed)
    return blocks_[block].local_gradient;
  // The derivative of a product by one of its factors is the product of the others.
  const Eights &g = geometry_[block];
  const double x = place_[particle][0], y = place_[particle][1], z = place_[particle][2];
  return inverse_transposed(unpadded((g[1] + y * g[3]) + z * (g[5] + y * g[7])),
                            unpadded((g[2] + x * g[3]) + z * (g[6] + x * g[7])),
                            unpadded((g[4] + x * g[5]) + y * (g[6] + x * g[7])));
}

namespace
{

/// Sums over the nodes with the signs that a product has there, or over the products with their signs at a node.
Eights signed_sums(Eights values, const bool are_of_nodes)
{
  for (int bit = 1; bit < 8; bit *= 2)
    for (int low = 0; low < 8; ++low)
      if ((low & bit) == 0)
      {
        const Padded a = values[low], b = values[low | bit];
        values[low] = are_of_nodes ? a + b : a - b;
        values[low | bit] = are_of_nodes ? b - a : a + b;
      }
  for (Padded &value : values)
    value *= 0.125;
  return values;
}

} // namespace

Eights ElementBlocks::coefficients(const Eights &at_nodes)
{
  return signed_sums(at_nodes, true);
}

Eights ElementBlocks::at_nodes(const Eights &moments)
{
  return signed_sums(moments, false);
}

void ElementBlocks::interpolate(const ConstVectors node_values, const Vectors particle_values) const
{
  assert(particle_values.size() == n_particles() && node_values.size() == n_nodes());
  for_each(
      [&](std::size_t, const Block &block)
      {
        const Eights field =
            coefficients(block, [&](const int node) -> const Eigen::Vector3d & { return node_values[node]; });
        for (std::size_t particle = block.begin; particle < block.end; ++particle)
          particle_values[particle] = unpadded(products(particle).value_of(field));
      });
}

void ElementBlocks::collect(const ConstVectors particle_values, const Vectors node_values) const
{
  assert(particle_values.size() == n_particles() && node_values.size() == n_nodes());
  sum_at_nodes(
      [&](std::size_t, const Block &block)
      {
        return at_nodes(moments_of(block, [&](const std::size_t particle, const Products &)
                                   { return padded(particle_values[particle]); }));
      },
      [&](const std::size_t node, const Eigen::Vector3d &sum) { node_values[node] = sum; });
}

} // namespace bergamo::coupling
