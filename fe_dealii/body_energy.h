#pragma once

namespace bergamo::fe
{

/// Energies of a body [J] at the whole step of its last kick, the continuum's share included. Works and losses count
/// from the first kick on. The leapfrog keeps
///   kinetic + elastic + plastic + viscous − (boundary + gravity + external work) − step change = initial
/// to rounding: kinetic is ½ v⁻·m v⁺ with the half-step velocities around the kick, v⁺ for a step as long as the one
/// before, and every work and loss is ½(F_{n−1} + F_n)·(u_n − u_{n−1}).
struct BodyEnergy
{
  double kinetic = 0;
  double elastic = 0; ///< ½ ∫ σ : C⁻¹ : σ, initial stress included
  double plastic_dissipation = 0;
  double viscous_dissipation = 0; ///< by mass-proportional damping
  double boundary_work = 0;       ///< of the reactions at prescribed velocities
  double gravity_work = 0;
  double external_work = 0; ///< of external_force()
  /// Σ ⅛ (Δt_before² − Δt_after²) a·m a over the changes of the time step: the kinetic energy above lies ⅛ Δt² a·m a
  /// below that of the velocity at the whole step, and jumps with it.
  double step_change = 0;
  double initial = 0; ///< kinetic + elastic + plastic at the first kick

  /// What the balance fails to close by; zero to rounding in a sound run.
  double residual() const
  {
    return kinetic + elastic + plastic_dissipation + viscous_dissipation - boundary_work - gravity_work -
           external_work - step_change - initial;
  }
};

} // namespace bergamo::fe
