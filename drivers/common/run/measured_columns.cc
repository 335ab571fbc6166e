#include "drivers/common/run/measured_columns.h"

#include "coupling/adapter/model_energy.h"
#include "dem/force/surface_loads.h"
#include "dem/loading/cell_measures.h"

#include <tuple>

namespace bergamo::driver
{
namespace
{

/// What grains have wherever they are.
std::vector<Column> energies_of_grains(const dem::GrainEnergy &energy)
{
  return {{"energy_kinetic_J", [&energy] { return energy.kinetic; }},
          {"energy_grains_elastic_J", [&energy] { return energy.normal + energy.tangential; }},
          {"energy_friction_loss_J", [&energy] { return energy.friction_loss; }},
          {"energy_viscous_loss_J", [&energy] { return energy.viscous_loss; }},
          {"energy_curvature_work_J", [&energy] { return energy.curvature_work; }},
          {"energy_search_work_J", [&energy] { return energy.search_work; }},
          {"energy_quadrature_work_J", [&energy] { return energy.quadrature_work; }}};
}

std::vector<Column> joined(std::vector<Column> columns, const std::vector<Column> &more)
{
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

} // namespace

std::vector<Column> columns_of(const dem::GrainEnergy &energy)
{
  return joined(energies_of_grains(energy), {{"energy_wall_work_J", [&energy] { return energy.wall_work; }},
                                             {"energy_gravity_work_J", [&energy] { return energy.gravity_work; }},
                                             {"energy_exchanged_J", [&energy] { return energy.exchanged; }}});
}

std::vector<Column> columns_of(const std::vector<dem::SurfaceLoad> &loads, const std::vector<std::string> &names)
{
  std::vector<Column> columns;
  for (std::size_t s = 0; s < names.size(); ++s)
    for (const auto &[quantity, unit, vector] :
         {std::tuple("force", "N", &dem::SurfaceLoad::force), std::tuple("moment", "Nm", &dem::SurfaceLoad::moment)})
      for (int d = 0; d < 3; ++d)
        columns.push_back({names[s] + "_" + quantity + "_" + "xyz"[d] + "_" + unit,
                           [&loads, s, vector, d] { return s < loads.size() ? (loads[s].*vector)[d] : 0.; }});
  return columns;
}

std::vector<Column> columns_of(const dem::CellMeasures &cell)
{
  const dem::AssemblyMeasures &a = cell.assembly;
  const auto shear = [&a](const int i, const int j)
  { return [&a, i, j] { return 0.5 * (a.stress(i, j) + a.stress(j, i)); }; };
  const std::vector<Column> state{
      {"strain_x", [&cell] { return cell.strain[0]; }},
      {"strain_y", [&cell] { return cell.strain[1]; }},
      {"strain_z", [&cell] { return cell.strain[2]; }},
      {"volumetric_strain", [&cell] { return (cell.strain + Vec3::Ones()).prod() - 1.; }},
      {"stress_xx_Pa", [&a] { return a.stress(0, 0); }},
      {"stress_yy_Pa", [&a] { return a.stress(1, 1); }},
      {"stress_zz_Pa", [&a] { return a.stress(2, 2); }},
      {"stress_xy_Pa", shear(0, 1)},
      {"stress_xz_Pa", shear(0, 2)},
      {"stress_yz_Pa", shear(1, 2)},
      {"solid_fraction", [&cell] { return cell.solid_fraction; }},
      {"inertial_number", [&cell] { return cell.inertial_number; }},
      {"n_contacts", [&a] { return static_cast<double>(a.n_contacts); }},
      {"coordination_number", [&a] { return a.coordination.mean; }},
      {"mechanical_coordination_number", [&a] { return a.coordination.mechanical; }},
      {"coordination_number_without_rattlers", [&a] { return a.coordination.without_rattlers; }},
      {"rattler_fraction", [&cell] { return cell.rattler_fraction; }},
      {"fabric_xx", [&a] { return a.fabric(0, 0); }},
      {"fabric_yy", [&a] { return a.fabric(1, 1); }},
      {"fabric_zz", [&a] { return a.fabric(2, 2); }},
      {"fabric_anisotropy", [&a] { return dem::fabric_anisotropy(a.fabric); }},
      {"sliding_fraction", [&a] { return a.sliding_fraction; }},
      {"mean_normal_force_N", [&a] { return a.mean_normal_force; }},
      {"max_overlap_over_radius", [&cell] { return cell.largest_overlap; }}};
  return joined(joined(state, energies_of_grains(cell.energy)),
                {{"energy_cell_work_J", [&cell] { return cell.energy.cell_work; }}});
}

std::vector<Column> columns_of(const coupling::ModelEnergy &energy)
{
  return {{"energy_kinetic_J", [&energy] { return energy.kinetic; }},
          {"energy_grains_elastic_J", [&energy] { return energy.grains_elastic; }},
          {"energy_continuum_elastic_J", [&energy] { return energy.continuum_elastic; }},
          {"energy_coupling_J", [&energy] { return energy.coupling; }},
          {"energy_friction_loss_J", [&energy] { return energy.friction_loss; }},
          {"energy_viscous_loss_J", [&energy] { return energy.viscous_loss; }},
          {"energy_plastic_loss_J", [&energy] { return energy.plastic_loss; }},
          {"energy_stiffness_loss_J", [&energy] { return energy.stiffness_loss; }},
          {"energy_slip_loss_J", [&energy] { return energy.slip_loss; }},
          {"energy_wall_work_J", [&energy] { return energy.wall_work; }},
          {"energy_gravity_work_J", [&energy] { return energy.gravity_work; }},
          {"energy_transfer_work_J", [&energy] { return energy.transfer_work; }},
          {"energy_weight_work_J", [&energy] { return energy.weight_work; }},
          {"energy_curvature_work_J", [&energy] { return energy.curvature_work; }},
          {"energy_search_work_J", [&energy] { return energy.search_work; }},
          {"energy_quadrature_work_J", [&energy] { return energy.quadrature_work; }}};
}

} // namespace bergamo::driver
