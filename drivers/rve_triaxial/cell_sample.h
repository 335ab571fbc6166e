#pragma once

#include "dem/loading/cell_loading.h"
#include "dem/measure/assembly_measures.h"
#include "drivers/common/run/table.h"

#include <algorithm>

namespace bergamo::driver
{

/// What is read of a step of a periodic cell, and the columns of history.csv.
struct CellSample
{
  double time = 0.; ///< [s]
  double stage = 0.;
  Vec3 strain = Vec3::Zero(); ///< since the stage began
  double solid_fraction = 0., inertial_number = 0., rattler_fraction = 0.;
  dem::AssemblyMeasures assembly;
  double overlap = 0.; ///< largest, over the smaller bounding radius
  dem::GrainEnergy energy;
  double residual = 0.; ///< of the energy's balance since the first sample [J]

  Table table() const
  {
    const dem::AssemblyMeasures &a = assembly;
    const auto shear = [&a](const int i, const int j)
    { return [&a, i, j] { return 0.5 * (a.stress(i, j) + a.stress(j, i)); }; };
    return Table{{{"time_s", [this] { return time; }},
                  {"stage", [this] { return stage; }},
                  {"strain_x", [this] { return strain[0]; }},
                  {"strain_y", [this] { return strain[1]; }},
                  {"strain_z", [this] { return strain[2]; }},
                  {"volumetric_strain", [this] { return (strain + Vec3::Ones()).prod() - 1.; }},
                  {"stress_xx_Pa", [&a] { return a.stress(0, 0); }},
                  {"stress_yy_Pa", [&a] { return a.stress(1, 1); }},
                  {"stress_zz_Pa", [&a] { return a.stress(2, 2); }},
                  {"stress_xy_Pa", shear(0, 1)},
                  {"stress_xz_Pa", shear(0, 2)},
                  {"stress_yz_Pa", shear(1, 2)},
                  {"solid_fraction", [this] { return solid_fraction; }},
                  {"inertial_number", [this] { return inertial_number; }},
                  {"n_contacts", [&a] { return static_cast<double>(a.n_contacts); }},
                  {"coordination_number", [&a] { return a.coordination.mean; }},
                  {"mechanical_coordination_number", [&a] { return a.coordination.mechanical; }},
                  {"coordination_number_without_rattlers", [&a] { return a.coordination.without_rattlers; }},
                  {"rattler_fraction", [this] { return rattler_fraction; }},
                  {"fabric_xx", [&a] { return a.fabric(0, 0); }},
                  {"fabric_yy", [&a] { return a.fabric(1, 1); }},
                  {"fabric_zz", [&a] { return a.fabric(2, 2); }},
                  {"fabric_anisotropy", [&a] { return dem::fabric_anisotropy(a.fabric); }},
                  {"sliding_fraction", [&a] { return a.sliding_fraction; }},
                  {"mean_normal_force_N", [&a] { return a.mean_normal_force; }},
                  {"max_overlap_over_radius", [this] { return overlap; }},
                  {"energy_kinetic_J", [this] { return energy.kinetic; }},
                  {"energy_grains_elastic_J", [this] { return energy.normal + energy.tangential; }},
                  {"energy_friction_loss_J", [this] { return energy.friction_loss; }},
                  {"energy_viscous_loss_J", [this] { return energy.viscous_loss; }},
                  {"energy_curvature_work_J", [this] { return energy.curvature_work; }},
                  {"energy_cell_work_J", [this] { return energy.cell_work; }},
                  {"energy_residual_J", [this] { return residual; }}}};
  }
};

} // namespace bergamo::driver
