#pragma once

#include "coupling/arlequin/overlap.h"
#include "dem/core/pack.h"
#include "dem/core/parallel.h"
#include "dem/core/rows.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace bergamo::coupling
{

/// A vector and a zero, in one register where the build has registers of four.
using Padded = Lanes<4>;

BERGAMO_INLINE Padded padded(const Eigen::Vector3d &v)
{
  return Padded([&](auto lane) { return lane < 3 ? v.data()[lane] : 0.; });
}
BERGAMO_INLINE Eigen::Vector3d unpadded(const Padded &v)
{
  return {v[0], v[1], v[2]};
}

/// The coupled particles element by element, and the two ways between nodes and particles: fields of the elements at
/// the particles, and sums over the particles at the nodes. Each is one pass over the particles.
///
/// In an element of 8 nodes with local coordinates xi, eta, zeta in [-1, 1], fields are made of eight products: number
/// k has those coordinates as factors whose bits (1, 2, 4) are in k. So three numbers of a particle stand for its shape
/// values and their gradients; nodal values become coefficients of the products once an element, and moments, the sums
/// over particles of a value times the products, become sums over N_I once an element.
///
/// Every block writes only what is its own, and nodes add up their blocks in order: same bits on any number of threads.
class ElementBlocks
{
public:
  using Vectors = std::span<Eigen::Vector3d>;
  using ConstVectors = std::span<const Eigen::Vector3d>;
  using Eights = std::array<Padded, 8>; ///< by node of an element or by product

  /// Particles [begin, end) of one element, at most `longest`.
  struct Block
  {
    std::size_t begin, end;
    std::array<int, 8> nodes;       ///< places in Overlap::nodes
    bool is_skewed;                 ///< not a parallelepiped: the gradients of the local coordinates vary
    Eigen::Matrix3d local_gradient; ///< columns: gradients of xi, eta, zeta in a parallelepiped [1/m]
  };
  static constexpr std::size_t longest = 128;

  /// The products at a particle.
  class Products
  {
  public:
    BERGAMO_INLINE explicit Products(const Eigen::Vector3d &local)
        : x_(local[0]), y_(local[1]), z_(local[2]), xy_(x_ * y_), xz_(x_ * z_), yz_(y_ * z_), xyz_(xy_ * z_)
    {
    }

    /// Of a field of these coefficients.
    BERGAMO_INLINE Padded value_of(const Eights &c) const
    {
      return ((c[0] + x_ * c[1]) + (y_ * c[2] + xy_ * c[3])) + ((z_ * c[4] + xz_ * c[5]) + (yz_ * c[6] + xyz_ * c[7]));
    }

    /// Adds a particle's part to the moments of its element.
    BERGAMO_INLINE void add_to(Eights &moments, const Padded &value) const
    {
      moments[0] += value;
      moments[1] += x_ * value;
      moments[2] += y_ * value;
      moments[3] += xy_ * value;
      moments[4] += z_ * value;
      moments[5] += xz_ * value;
      moments[6] += yz_ * value;
      moments[7] += xyz_ * value;
    }

  private:
    Padded x_, y_, z_, xy_, xz_, yz_, xyz_;
  };

  /// Precondition: the overlap is valid. It costs least if the particles of an element follow one another.
  explicit ElementBlocks(const Overlap &overlap);

  std::size_t n_nodes() const { return corners_.size(); }
  std::size_t n_particles() const { return place_.size(); }
  const std::vector<Block> &blocks() const { return blocks_; }
  BERGAMO_INLINE Products products(const std::size_t particle) const { return Products(place_[particle]); }

  /// N_I at a particle, by node of its element.
  std::array<double, 8> shape_values(std::size_t particle) const;

  /// Gradients of xi, eta, zeta at a particle of a block [1/m], as columns.
  Eigen::Matrix3d local_gradient(std::size_t block, std::size_t particle) const;

  static Eights coefficients(const Eights &at_nodes); ///< of the field with these values at the nodes
  static Eights at_nodes(const Eights &moments);      ///< sums over N_I, by node

  /// Coefficients of a field in a block. @param value value(node): vector at the place of a node in Overlap::nodes
  template <class Value>
  static Eights coefficients(const Block &block, const Value &value)
  {
    Eights values;
    for (int corner = 0; corner < 8; ++corner)
      values[corner] = padded(value(block.nodes[corner]));
    return coefficients(values);
  }

  /// Calls body(number, block) for all blocks, in parallel.
  template <class Body>
  void for_each(const Body &body) const
  {
    parallel_ranges(blocks_.size(), 4,
                    [&](std::size_t, const std::size_t begin, const std::size_t end)
                    {
                      for (std::size_t b = begin; b < end; ++b)
                        body(b, blocks_[b]);
                    });
  }

  /// Moments of the particles of a block. @param value value(particle, products): Padded
  template <class Value>
  BERGAMO_INLINE Eights moments_of(const Block &block, const Value &value) const
  {
    Eights moments{};
    for (std::size_t particle = block.begin, end = block.end; particle < end; ++particle)
    {
      const Products at = products(particle);
      at.add_to(moments, value(particle, at));
    }
    const Eights sums = moments; // of which alone the address is taken: the others stay in registers
    return sums;
  }

  /// Calls give(node, sum) with what the blocks give to each node. @param of_block of_block(number, block): Eights by
  /// node of the element
  template <class OfBlock, class Give>
  void sum_at_nodes(const OfBlock &of_block, const Give &give) const
  {
    const auto given = std::make_unique_for_overwrite<Eights[]>(blocks_.size());
    for_each([&](const std::size_t b, const Block &block) { given[b] = of_block(b, block); });
    parallel_for(n_nodes(),
                 [&](const std::size_t node)
                 {
                   Padded sum(0.);
                   for (const Corner &at : corners_[node])
                     sum += given[at.block][at.corner];
                   give(node, unpadded(sum));
                 });
  }

  /// N^T: values of a nodal field at the particles.
  void interpolate(ConstVectors node_values, Vectors particle_values) const;

  /// N: sums of particle values to the nodes of their elements.
  void collect(ConstVectors particle_values, Vectors node_values) const;

private:
  struct Corner
  {
    int block, corner;
  };

  std::vector<Eigen::Vector3d> place_; // local coordinates of the particles
  std::vector<Block> blocks_;
  std::vector<Eights> geometry_; // coefficients of the places, by block [m]
  Rows<Corner> corners_;         // that each node is
};

} // namespace bergamo::coupling
