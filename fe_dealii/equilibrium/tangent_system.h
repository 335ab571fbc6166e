#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace bergamo::fe
{

class ExplicitBody;

/// The linear system of a body's tangent stiffness; prescribed dofs do not move. Solved by Trilinos: directly (MUMPS)
/// where it is small, else by conjugate gradients - GMRES where the flow is not associated - preconditioned with the
/// smoothed aggregation (ML; Vaněk, Mandel, Brezina 1996) of the elastic operator and its six rigid motions.
/// MPI has to be initialized (MpiSession), though a single process does the work.
class TangentSystem
{
public:
  /// @param direct_limit largest number of dofs that is solved directly
  TangentSystem(const ExplicitBody &body, std::size_t direct_limit);
  ~TangentSystem();

  /// Assembles the elastic stiffness at a displacement, which also becomes the preconditioner of what follows.
  /// @param moved what the prescribed dofs move by [m]; @param pull set to minus the forces on free dofs that this
  /// causes [N]
  void assemble_elastic(const double *displacement, std::span<const double> moved, std::span<double> pull);

  /// Assembles the tangent at a displacement, from the body's present stresses, which belong to `before` [m].
  void assemble_tangent(const double *displacement, const double *before);

  /// increment = K⁻¹ residual on the free dofs, 0 on the prescribed ones.
  /// @param tolerance of the linear residual over that of a zero increment
  /// @return linear iterations, 0 of the direct solver; throws RunError where the system has no solution
  unsigned int solve(std::span<const double> residual, double tolerance, std::span<double> increment);

private:
  struct Trilinos;
  std::unique_ptr<Trilinos> trilinos;
  const ExplicitBody &body;
};

} // namespace bergamo::fe
