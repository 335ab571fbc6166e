#pragma once

#include "dem/simulation/simulation.h"

#include <cstddef>
#include <string>
#include <vector>

namespace bergamo::benchmark
{

// All that the benchmarks read from the inside of the engine: the one place to follow when the engine changes.

/// Pairs of grains that touch.
std::size_t n_touching(const dem::Simulation &simulation);

/// Mean overlap over mean distance of the centres of touching pairs; 0 without contacts.
double mean_relative_overlap(const dem::Simulation &simulation);

/// One phase of the time step.
struct Phase
{
  std::string name;
  double seconds = 0.; ///< spent in it since the start
};

/// Time spent in each phase of the step; empty if the engine does not measure it.
std::vector<Phase> phase_times(const dem::Simulation &simulation);

} // namespace bergamo::benchmark
