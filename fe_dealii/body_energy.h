#pragma once

namespace bergamo::fe
{

/// Energies of a body [J] at the whole step of its last kick, the continuum's share included. Works and losses count
/// from the first kick on. At a constant time step the leapfrog keeps
///   kinetic + elastic + plastic + viscous − (boundary + gravity + external work) = initial
/// to rounding: kinetic is ½ v⁻·m v⁺ with the half-step velocities around the kick, and every work and loss is
/// ½(F_{n−1} + F_n)·(u_n − u_{n−1}). A change of the time step adds an error of the order of one step's work.
struct BodyEnergy
{
  double kinetic = 0;
  double elastic = 0; ///< ½ ∫ σ : C⁻¹ : σ, initial stress included
  double plastic_dissipation = 0;
  double viscous_dissipation = 0; ///< by mass-proportional damping
  double boundary_work = 0;       ///< of the reactions at prescribed velocities
  double gravity_work = 0;
  double external_work = 0; ///< of external_force()
  double initial = 0;       ///< kinetic + elastic + plastic at the first kick

  /// What the balance fails to close by; zero to rounding in a sound run.
  double residual() const
  {
    return kinetic + elastic + plastic_dissipation + viscous_dissipation - boundary_work - gravity_work -
           external_work - initial;
  }
};

} // namespace bergamo::fe
