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
    double step;
    std::vector<std::size_t> couplings; ///< that act on it, as places in `couplings`
  };
  std::vector<OfMover> movers;
  std::vector<OfCoupling> couplings;

  /// Bound for the whole: the squared frequencies of a mover and of the couplings that act on it add up at most, as the
  /// energies of all parts together are at most the sum of these over the movers. Infinite without movers.
  double combined() const;
};

} // namespace bergamo::coupling
