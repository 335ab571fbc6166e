#pragma once

#include "coupling/adapter/model_energy.h"
#include "drivers/common/run/state_visitor.h"
#include "drivers/common/run/table.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{

/// What is read of a step, and the columns of history.csv.
struct SpecimenSample
{
  double time = 0.;                                  ///< of the loading [s]
  int stage = 1;                                     ///< 1: isotropic, 2: shear
  Vec3 strain = Vec3::Zero(), stress = Vec3::Zero(); ///< tension positive [-], [Pa]
  coupling::ModelEnergy energy;
  double residual = 0.;                                  ///< of the energy's balance since the first sample [J]
  double coordination_number = 0., largest_overlap = 0.; ///< of the grains; the overlap over the smaller radius
  double coupling_difference = 0.;                       ///< largest, between both models' displacements [m]

  Table table() const
  {
    return Table{{{"time_s", [this] { return time; }},
                  {"stage", [this] { return stage; }},
                  {"strain_1", [this] { return strain[0]; }},
                  {"strain_2", [this] { return strain[1]; }},
                  {"strain_3", [this] { return strain[2]; }},
                  {"stress_1_Pa", [this] { return stress[0]; }},
                  {"stress_2_Pa", [this] { return stress[1]; }},
                  {"stress_3_Pa", [this] { return stress[2]; }},
                  {"energy_kinetic_J", [this] { return energy.kinetic; }},
                  {"energy_grains_elastic_J", [this] { return energy.grains_elastic; }},
                  {"energy_continuum_elastic_J", [this] { return energy.continuum_elastic; }},
                  {"energy_coupling_J", [this] { return energy.coupling; }},
                  {"energy_friction_loss_J", [this] { return energy.friction_loss; }},
                  {"energy_viscous_loss_J", [this] { return energy.viscous_loss; }},
                  {"energy_plastic_loss_J", [this] { return energy.plastic_loss; }},
                  {"energy_wall_work_J", [this] { return energy.wall_work; }},
                  {"energy_gravity_work_J", [this] { return energy.gravity_work; }},
                  {"energy_curvature_work_J", [this] { return energy.curvature_work; }},
                  {"energy_residual_J", [this] { return residual; }},
                  {"coordination_number", [this] { return coordination_number; }},
                  {"max_overlap_over_radius", [this] { return largest_overlap; }},
                  {"coupling_difference_m", [this] { return coupling_difference; }}}};
  }
};

/// What a run keeps of its samples for the summary.
struct SpecimenExtremes
{
  double first_balance = 0., largest_residual = 0., largest_work = 0.; ///< of the energy [J]
  double largest_overlap = 0.;                                         ///< over the smaller radius

  /// Takes in a sample and tells it its residual.
  void add(SpecimenSample &sample)
  {
    if (sample.time == 0.)
      first_balance = sample.energy.balance();
    sample.residual = sample.energy.balance() - first_balance;
    largest_residual = std::max(largest_residual, std::abs(sample.residual));
    largest_work = std::max(largest_work, std::abs(sample.energy.wall_work));
    largest_overlap = std::max(largest_overlap, sample.largest_overlap);
  }

  /// Largest error of the energy's balance over the largest work; 0 without work.
  double energy_residual() const { return largest_work > 0. ? largest_residual / largest_work : 0.; }

  void visit(StateVisitor &visit)
  {
    visit("extremes/first_balance", first_balance);
    visit("extremes/residual", largest_residual);
    visit("extremes/work", largest_work);
    visit("extremes/overlap", largest_overlap);
  }
};

} // namespace bergamo::driver
