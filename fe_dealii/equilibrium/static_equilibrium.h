#pragma once

#include <cstddef>
#include <vector>

namespace bergamo::fe
{

class ExplicitBody;

struct EquilibriumParameters
{
  double tolerance = 1e-9;           ///< out-of-balance over acting forces (Euclidean norms), > 0
  int max_iterations = 40;           ///< of Newton's method, >= 1
  double duration = 0;               ///< prescribed dofs move by their velocity times this [s]; 0: they stay
  double least_increment = 1. / 256; ///< of the path; where none as short has an equilibrium, the path ends
  double least_share = 1;            ///< of the path that must be borne, 0 to 1
  std::size_t direct_limit = 25000;  ///< largest number of dofs that is solved directly, see TangentSystem

  /// Throws ConfigError.
  void validate() const;
};

struct EquilibriumReport
{
  std::vector<double> residual;         ///< out-of-balance over acting forces, at the start and after each iteration
  double borne = 1;                     ///< share of the path that ends in equilibrium
  double left = 0;                      ///< out-of-balance over acting forces, of what is not borne
  int n_increments = 0;                 ///< in which the path was followed; 0 where there was nothing to do
  unsigned int n_linear_iterations = 0; ///< of all systems; 0 if they were solved directly
};

/// Finds the displacement at which a body rests under gravity, its present external_force() - a dead load - and the
/// prescribed dofs, from its present stresses: Newton's method with the consistent tangent and a search for the least
/// energy along its steps. One call is one increment of the path, or several where it has to be cut: where plastic flow
/// depends on the path, load in several calls. Leaves the body at rest
/// (ExplicitBody::rest()); keep the external forces as they are and the explicit run starts without motion.
/// Throws ConfigError, also for rigid motions that nothing holds, by name, and RunError with the place of the largest
/// force out of balance where no equilibrium is found; the body is then as before. With a least_share below 1 it stays
/// where the last equilibrium was, and what it does not bear sets it in motion.
EquilibriumReport find_equilibrium(ExplicitBody &body, const EquilibriumParameters &parameters = {});

} // namespace bergamo::fe
