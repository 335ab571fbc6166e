#pragma once

namespace bergamo::dem
{

/// Energies of the grains at one step and what flowed in and out since the start, all with the grains' and contacts'
/// weights [J]. In exact arithmetic kinetic + elastic + losses - work stays constant.
struct GrainEnergy
{
  double kinetic = 0.;        ///< m v-.v+ / 2 of the half steps around, and H-.T I^-1 T^T H+ / 2
  double normal = 0.;         ///< stored in the contacts' normal springs
  double tangential = 0.;     ///< stored in their tangential springs
  double friction_loss = 0.;  ///< lost tangentially
  double viscous_loss = 0.;   ///< lost in the dashpots
  double curvature_work = 0.; ///< put in by changes of the contacts' stiffness, see Losses
  double search_work = 0.;    ///< put in by searches, which correct the overlaps that were followed
  double quadrature_work =
      0.;                ///< put in by the steps of time: trapezoidal work of the normal springs less their energy
  double wall_work = 0.; ///< done by walls on grains
  double gravity_work = 0.;
  double external_work = 0.; ///< done by Particles::external_force
  double cell_work = 0.;     ///< done by the deformation of a periodic cell
  double exchanged = 0.;     ///< brought in by grains and walls that were added, less what removed ones took away

  double step_change = 0.; ///< put in by changes of the time step, see step_change_work()

  double stored() const { return kinetic + normal + tangential; }
  double balance() const
  {
    return stored() + friction_loss + viscous_loss - curvature_work - search_work - quadrature_work - wall_work -
           gravity_work - external_work - cell_work - exchanged - step_change;
  }
};

} // namespace bergamo::dem
