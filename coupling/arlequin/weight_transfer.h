#pragma once

#include "coupling/arlequin/overlap.h"
#include "dem/core/rows.h"

#include <Eigen/Core>
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
  WeightTransfer() = default;
  explicit WeightTransfer(const Overlap &overlap);

  /// Adds the opposite of the forces [N] and torques [N m] that the weights' gradient gives to the coupled particles to
  /// those of the FE mesh (3 * node + component). Sum and moment balance to rounding; the same bits on any number of
  /// threads.
  void add_opposite(std::span<const Eigen::Vector3d> force, std::span<const Eigen::Vector3d> torque,
                    std::span<double> fe_force) const;

private:
  struct ShapeFunction
  {
    int particle;
    double value;
    Eigen::Vector3d gradient; // [1/m]
  };
  std::vector<int> nodes_;
  Rows<ShapeFunction> of_node_;
};

} // namespace bergamo::coupling
