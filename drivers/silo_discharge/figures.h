#pragma once

#include "drivers/common/csv_table.h"

namespace bergamo::driver
{

/// What is kept of the filling.
struct FillingFigures
{
  double n_grains = 0;
  double mass = 0;         ///< [kg]
  double bulk_density = 0; ///< of the lower three quarters of the mass [kg/m^3]
  double floor_share = 0;  ///< of the weight that floor and plugs bear, the rest hangs on the walls
  double duration = 0;     ///< simulated [s]
  double n_steps = 0;

  FigureList list()
  {
    return {{"grains", &n_grains},
            {"filled_mass_kg", &mass},
            {"bulk_density_kg_m3", &bulk_density},
            {"floor_share_of_weight", &floor_share},
            {"filling_time_s", &duration},
            {"filling_steps", &n_steps}};
  }
};

/// What is kept of a discharge beside its history: one row of discharges.csv.
struct DischargeFigures
{
  double width = 0;                              ///< of the orifice [m]
  double mass_flow = 0, mass_flow_deviation = 0; ///< steady, and of its windows [kg/s]
  double steady_begin = 0, steady_end = 0;       ///< [s]
  double duration = 0;                           ///< [s]
  double discharged_mass = 0;                    ///< [kg]
  double discharged_grains = 0, grains_left = 0; ///< left inside or on their way to the outlet
  double stopped_by_itself = 0;                  ///< 1 where nothing passed any more: empty or clogged
  double n_steps = 0;
  double stable_step = 0; ///< shortest [s]
  double largest_overlap_over_radius = 0;
  double energy_residual = 0; ///< largest miss of the balance over the work of gravity
  double n_undecided = 0;

  /// All of them by name, in the order of the columns.
  FigureList list()
  {
    return {{"orifice_width_m", &width},
            {"mass_flow_kg_s", &mass_flow},
            {"mass_flow_deviation_kg_s", &mass_flow_deviation},
            {"steady_begin_s", &steady_begin},
            {"steady_end_s", &steady_end},
            {"duration_s", &duration},
            {"discharged_mass_kg", &discharged_mass},
            {"discharged_grains", &discharged_grains},
            {"grains_left", &grains_left},
            {"stopped_by_itself", &stopped_by_itself},
            {"steps", &n_steps},
            {"stable_time_step_s", &stable_step},
            {"max_overlap_over_radius", &largest_overlap_over_radius},
            {"energy_residual", &energy_residual},
            {"undecided_contacts", &n_undecided}};
  }
};

} // namespace bergamo::driver
