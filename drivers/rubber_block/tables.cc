#include "drivers/rubber_block/tables.h"

#include <string>

namespace bergamo::driver
{

Table BlockSample::table(const std::unique_ptr<Pull> &pull) const
{
  return {{{"time_s", [&] { return time; }},
           {"position_m", [&] { return pull->position(); }},
           {"sinking_m", [&] { return pull->top().sinking(); }},
           {"top_pressure_Pa", [&] { return pull->top().pressure(); }},
           {"pulling_force_N", [&] { return pull->pulling_force(); }},
           {"contact_force_x_N", [&] { return force[0]; }},
           {"contact_force_y_N", [&] { return force[1]; }},
           {"contact_force_z_N", [&] { return force[2]; }},
           {"friction_coefficient", [&] { return force[2] > 0. ? -force[0] / force[2] : 0.; }},
           {"mobilized_friction", [&] { return pull->contact_pressure().mobilized_friction(); }},
           {"front_pressure_Pa", [&] { return pull->contact_pressure().strips().back(); }},
           {"largest_face_pressure_Pa", [&] { return pull->contact_pressure().largest(); }},
           {"energy_grains_kinetic_J", [&] { return grains.kinetic; }},
           {"energy_contacts_J", [&] { return grains.normal + grains.tangential; }},
           {"energy_block_kinetic_J", [&] { return block.kinetic; }},
           {"energy_block_elastic_J", [&] { return block.elastic; }},
           {"energy_friction_loss_J", [&] { return grains.friction_loss; }},
           {"energy_viscous_loss_J", [&] { return grains.viscous_loss; }},
           {"work_pressure_J", [&] { return pull->top().work(); }},
           {"work_pull_J", [&] { return block.boundary_work; }},
           {"work_gravity_J", [&] { return grains.gravity_work + block.gravity_work; }},
           {"work_curvature_J", [&] { return grains.curvature_work; }},
           {"work_search_J", [&] { return grains.search_work; }},
           {"work_quadrature_J", [&] { return grains.quadrature_work; }},
           {"energy_residual_J", [&] { return residual; }}}};
}

Table pressure_table(const double &time, const std::unique_ptr<Pull> &pull, const std::size_t n_strips)
{
  Table table{{{"time_s", [&time] { return time; }}}};
  for (std::size_t strip = 0; strip < n_strips; ++strip)
    table.add({{"strip_" + std::to_string(strip + 1) + "_Pa",
                [&pull, strip] { return pull->contact_pressure().strips()[strip]; }}});
  return table;
}

} // namespace bergamo::driver
