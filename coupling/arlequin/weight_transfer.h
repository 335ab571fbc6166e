#pragma once

#include "coupling/arlequin/element_blocks.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace bergamo::coupling
{

/// What the gradient of the weights takes from the grains and gives to the continuum.
///
/// A contact between grains of different weights counts for each of them with that grain's own weight, so grains move
/// as if there were none: neither is one of small weight pushed about by the uneven weights of its contacts, which
/// would loosen it, nor do coupling forces have to stand in for the stress at the weights' gradient. What is left over
/// at each contact, the difference of weights times the force, is the continuum's: it acts on it with the opposite
/// sign, with its moment, at the places of both grains. Summed up it is the integral of N_I sigma grad w, which the
/// continuum's own share of the stress, 1 - w, asks for. The forces have no potential (as those of blended force-based
/// couplings of atoms and continuum; Li, Luskin & Ortner, 2012): their work is small where both models move alike, and
/// has an account of its own.
class WeightTransfer
{
public:
  /// What the weights' gradient gives to a particle.
  struct Load
  {
    Eigen::Vector3d force, torque; ///< [N], [N m]
  };

  /// @param nodes of the overlap, as it numbers them
  WeightTransfer(std::shared_ptr<const ElementBlocks> blocks, std::vector<int> nodes);

  /// Adds the opposite of the forces [N] and torques [N m] that the weights' gradient gives to the coupled particles to
  /// those of the FE mesh (3 * node + component). Sum and moment balance to rounding; the same bits on any number of
  /// threads.
  void add_opposite(std::span<const Eigen::Vector3d> force, std::span<const Eigen::Vector3d> torque,
                    std::span<double> fe_force) const;

  /// The same for who finds the loads on the way. @param load_on load_on(block, particle): Load, asked for once for
  /// each particle, in their order within a block
  template <class LoadOn>
  void add_opposite(const LoadOn &load_on, const std::span<double> fe_force) const
  {
    blocks_->sum_at_nodes(
        [&](const std::size_t number, const ElementBlocks::Block &block)
        {
          std::array<Padded, ElementBlocks::longest> force, torque;
          const std::size_t n = block.end - block.begin;
          for (std::size_t k = 0; k < n; ++k)
          {
            const Load load = load_on(number, block.begin + k);
            force[k] = padded(load.force);
            torque[k] = padded(load.torque);
          }
          return node_loads(number, {force.data(), n}, {torque.data(), n});
        },
        [&](const std::size_t node, const Eigen::Vector3d &sum)
        { Eigen::Map<Eigen::Vector3d>(fe_force.data() + 3 * nodes_[node]) -= sum; });
  }

private:
  /// Loads on the particles of a block, at the nodes of its element.
  ElementBlocks::Eights node_loads(std::size_t block, std::span<const Padded> force,
                                   std::span<const Padded> torque) const;

  std::shared_ptr<const ElementBlocks> blocks_;
  std::vector<int> nodes_;
};

} // namespace bergamo::coupling
