#pragma once

#include <string>

namespace bergamo::fe
{

/// Energies of a body [J] at the whole step of its last kick, the continuum's share included. Works and losses count
/// from the first kick on. The leapfrog keeps
///   kinetic + elastic + plastic + viscous + radiated + stiffness loss − (boundary + gravity + external work)
///     − step change − exchanged = initial
/// to rounding: kinetic is ½ v⁻·m v⁺ with the half-step velocities around the kick, v⁺ for a step as long as the one
/// before, and every work and loss is ½(F_{n−1} + F_n)·(u_n − u_{n−1}).
struct BodyEnergy
{
  double kinetic = 0;
  double elastic = 0; ///< that the present stresses store, initial stress included
  /// By plastic flow. A law that stores no energy, hypoplastic sand, has all work of its stresses here, which unloading
  /// lowers.
  double plastic_dissipation = 0;
  double viscous_dissipation = 0; ///< by mass-proportional damping
  double radiated = 0;            ///< what the dashpots of quiet boundaries have taken
  /// Elastic work less what it has stored, where the stiffness depends on the pressure: such a law has no potential.
  /// Small beside the works in a sound run.
  double stiffness_loss = 0;
  double boundary_work = 0; ///< of the reactions at prescribed velocities and of what quiet boundaries hold
  double gravity_work = 0;
  double external_work = 0; ///< of external_force()
  /// Σ ⅛ (Δt_before² − Δt_after²) a·m a over the changes of the time step: the kinetic energy above lies ⅛ Δt² a·m a
  /// below that of the velocity at the whole step, and jumps with it.
  double step_change = 0;
  double exchanged = 0; ///< brought by elements whose share has changed since
  double initial = 0;   ///< kinetic + elastic + the losses at the first kick

  /// What the balance fails to close by; zero to rounding in a sound run.
  double residual() const
  {
    return kinetic + elastic + plastic_dissipation + viscous_dissipation + radiated + stiffness_loss - boundary_work -
           gravity_work - external_work - step_change - exchanged - initial;
  }
};

/// Throws RunError for energies that no slow motion has. They are not finite; kinetic energy is below zero by more than
/// a thousandth of the others: the leapfrog's ½ v⁻·m v⁺ is negative where the fastest modes hold the motion, as an
/// unstable step makes them do; or the changing stiffness has given more than was put in.
/// @param what and when: "the ground at time 3 s"; @param remedy what to choose: "a smaller time step"
void require_bounded(const BodyEnergy &energy, const std::string &what, const std::string &remedy);

} // namespace bergamo::fe
