#pragma once

#include "drivers/common/csv_table.h"

#include <algorithm>

namespace bergamo::driver
{

/// What is kept of a slide beside its history: one row of slides.csv.
struct SlideFigures
{
  double travel_time = 0, exact_travel_time = 0; ///< [s]
  double distance_above = 0;                     ///< largest from the exact path, on the sphere's side, [m]
  double distance_below = 0;                     ///< and on the track's [m]
  double x = 0, z = 0; ///< largest difference from where the centre is at the same time in closed form [m]
  double airborne = 0; ///< share of the steps in which the sphere touches nothing
  double n_steps = 0;
  double stable_step = 0; ///< shortest [s]
  double largest_overlap_over_radius = 0;
  double energy_residual = 0; ///< largest miss of the balance over the work of gravity
  double n_undecided = 0;

  /// From the exact path [m].
  double distance() const { return std::max(distance_above, distance_below); }

  /// All of them by name, in the order of the columns.
  FigureList list()
  {
    return {{"travel_time_s", &travel_time},
            {"exact_travel_time_s", &exact_travel_time},
            {"distance_above_path_m", &distance_above},
            {"distance_below_path_m", &distance_below},
            {"x_difference_m", &x},
            {"z_difference_m", &z},
            {"airborne_share", &airborne},
            {"steps", &n_steps},
            {"stable_time_step_s", &stable_step},
            {"max_overlap_over_radius", &largest_overlap_over_radius},
            {"energy_residual", &energy_residual},
            {"undecided_contacts", &n_undecided}};
  }
};

} // namespace bergamo::driver
