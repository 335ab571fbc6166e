#pragma once

#include "drivers/common/csv_table.h"

#include <limits>

namespace bergamo::driver
{

/// What is kept of a sample beside its history: one row of ensemble.csv.
struct SampleFigures
{
  double n_particles = 0, n_steps = 0;
  double generated_solid_fraction = 0;                ///< after the generation
  double solid_fraction = 0, coordination_number = 0; ///< when the last stage began
  double final_solid_fraction = 0;
  double final_stress_ratio = 0; ///< sigma_zz over the mean of the others, at the end
  double energy_residual = 0;    ///< largest miss of the balance over the work done by the cell
  double largest_overlap = 0;    ///< over the smaller bounding radius
  double stable_step = std::numeric_limits<double>::infinity(); ///< [s], and the step used then,
  double time_step = 0;                                         ///< where they came nearest to one another
  double n_undecided = 0;
  double wall_time = 0; ///< [s]

  /// All of them by name, in the order of the columns.
  FigureList list()
  {
    return {{"n_particles", &n_particles},
            {"n_steps", &n_steps},
            {"generated_solid_fraction", &generated_solid_fraction},
            {"solid_fraction", &solid_fraction},
            {"coordination_number", &coordination_number},
            {"final_solid_fraction", &final_solid_fraction},
            {"final_stress_ratio", &final_stress_ratio},
            {"energy_residual", &energy_residual},
            {"max_overlap_over_radius", &largest_overlap},
            {"stable_time_step_s", &stable_step},
            {"time_step_s", &time_step},
            {"undecided_contacts", &n_undecided},
            {"wall_time_s", &wall_time}};
  }
};

} // namespace bergamo::driver
