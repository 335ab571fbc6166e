#include "coupling/adapter/model_energy.h"

namespace bergamo::coupling
{

ModelEnergy energy_of(const TwoScaleModel &model)
{
  ModelEnergy e;
  if (const dem::Simulation *grains = model.grains())
  {
    const dem::GrainEnergy g = grains->energy();
    e.kinetic += g.kinetic;
    e.grains_elastic = g.normal + g.tangential;
    e.friction_loss = g.friction_loss;
    e.viscous_loss += g.viscous_loss;
    e.wall_work += g.wall_work + g.cell_work;
    e.gravity_work += g.gravity_work;
    e.curvature_work = g.curvature_work;
    e.search_work = g.search_work;
    e.quadrature_work = g.quadrature_work;
    e.weight_work = g.exchanged;
  }
  if (const fe::ExplicitBody *body = model.body())
  {
    const fe::BodyEnergy b = body->energy();
    e.kinetic += b.kinetic;
    e.continuum_elastic = b.elastic;
    e.plastic_loss = b.plastic_dissipation;
    e.stiffness_loss = b.stiffness_loss;
    e.viscous_loss += b.viscous_dissipation + b.radiated;
    e.wall_work += b.boundary_work;
    e.gravity_work += b.gravity_work;
    e.weight_work += b.exchanged;
  }
  e.coupling = model.penalty_state().energy;
  if (model.overlap())
  {
    e.transfer_work = model.overlap()->transfer_work();
    e.slip_loss = model.overlap()->slip_loss();
  }
  return e;
}

} // namespace bergamo::coupling
