#pragma once

#include "coupling/adapter/two_scale_model.h"

namespace bergamo::coupling
{

/// Energies of both models and of their coupling, and what flowed in and out since their accounts were opened [J].
struct ModelEnergy
{
  double kinetic = 0., grains_elastic = 0., continuum_elastic = 0., coupling = 0.;
  double friction_loss = 0., viscous_loss = 0., plastic_loss = 0., stiffness_loss = 0.; ///< the last: fe::BodyEnergy
  double slip_loss = 0.; ///< of the held edge's springs, see HeldEdge
  double wall_work = 0.; ///< of the walls on grains and of the boundary on the continuum
  double gravity_work = 0.;
  double transfer_work = 0.; ///< of what the gradient of the weights transfers, on both models
  double curvature_work = 0., search_work = 0., quadrature_work = 0.; ///< of the grains' contacts, see dem::GrainEnergy
  double weight_work = 0.; ///< brought by grains that came or whose weight changed, and by elements whose share did

  double balance() const
  {
    return kinetic + grains_elastic + continuum_elastic + coupling + friction_loss + viscous_loss + plastic_loss +
           stiffness_loss + slip_loss - wall_work - gravity_work - transfer_work - curvature_work - search_work -
           quadrature_work - weight_work;
  }
};

/// Of the present step: to be called between kick() and move().
ModelEnergy energy_of(const TwoScaleModel &model);

} // namespace bergamo::coupling
