#pragma once

#include <string>
#include <vector>

namespace bergamo::coupling
{

/// Largest stable steps [s] of the parts of a model, by name.
struct StableSteps
{
  struct OfCoupling
  {
    std::string name;
    double step; ///< infinite for one without stiffness
  };
  struct OfMover
  {
    std::string name;
    double step;                        ///< from one computation of its own forces to the next
    std::vector<std::size_t> couplings; ///< that act on it, as places in `couplings`
    int steps_per_force = 1;
  };
  std::vector<OfMover> movers;
  std::vector<OfCoupling> couplings;

  /// Bound for the whole: the squared frequencies of a mover and of the couplings that act on it add up at most, as the
  /// energies of all parts together are at most the sum of these over the movers. Infinite without movers.
  ///
  /// Own forces that come as impulses every n-th step resonate where the time between two of them is half a period of
  /// the couplings: with H the former, s and c the stable steps of mover and couplings, one mode of both is stable
  /// where
  ///   (H / s)² tan(H / c) < H / c,   H / c < pi / 2
  /// (Biesiadecki & Skeel, 1993), which for H far below c is H < s.
  double combined() const;
};

} // namespace bergamo::coupling
