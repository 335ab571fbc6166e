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

/// Bytes of memory that a step without searches moves, if the cache holds what a pass over the contacts or the grains
/// uses twice, and nothing from one pass to the next.
struct StepBytes
{
  std::size_t contacts = 0;   ///< followed: states, bodies, what they add to
  std::size_t candidates = 0; ///< screened
  std::size_t grains = 0;     ///< their motion, seen by the contacts and screening, their sums and the leapfrog

  std::size_t sum() const { return contacts + candidates + grains; }
};
StepBytes step_bytes(const dem::Simulation &simulation);

} // namespace bergamo::benchmark
