#pragma once

#include "benchmarks/step_timing.h"

namespace bergamo::benchmark
{

/// Steps of a stretched sheet of Neo-Hookean membranes on one thread, beside what they need.
struct MembraneSpeed
{
  double n_elements = 0.;
  Spread step;            ///< [ns] an element
  double operations = 0.; ///< that the formulas of an element and its nodes need, counted as in solid_cost.h
  double bytes = 0.;      ///< that they move at least, see ElementMemory::moved
};

/// @param n_along edges of the sheet
MembraneSpeed measure_membranes(int n_along, int n_repeats, int n_steps);

} // namespace bergamo::benchmark
