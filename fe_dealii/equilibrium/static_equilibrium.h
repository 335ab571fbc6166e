#pragma once

#include <cstddef>
#include <vector>

namespace bergamo::fe
{

class ExplicitBody;

struct EquilibriumParameters
{
  double tolerance = 1e-9;          ///< out-of-balance over acting forces (Euclidean norms), > 0
  int max_iterations = 40;          ///< of Newton's method, >= 1
  double duration = 0;              ///< prescribed dofs move by their velocity times this [s]; 0: they stay
  std::size_t direct_limit = 10000; ///< largest number of dofs that is solved directly, see TangentSystem

  /// Throws ConfigError.
  void validate() const;
};

struct EquilibriumReport
{
  std::vector<double> residual;         ///< out-of-balance over acting forces, at the start and after each iteration
  unsigned int n_linear_iterations = 0; ///< of all systems; 0 if they were solved directly
};

/// Finds the displacement at which a body rests under gravity, its present external_force() - a dead load - and the
/// prescribed dofs, from its present stresses: Newton's method with the consistent tangent, damped by halving. One
/// call is one increment of the path: where plastic flow depends on the path, load in several. Leaves the body at rest
/// (ExplicitBody::rest()); keep the external forces as they are and the explicit run starts without motion.
/// Throws ConfigError, and RunError with the place of the largest force out of balance where no equilibrium is
/// found; the body is then as before.
EquilibriumReport find_equilibrium(ExplicitBody &body, const EquilibriumParameters &parameters = {});

} // namespace bergamo::fe
