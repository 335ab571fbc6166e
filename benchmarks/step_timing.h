#pragma once

#include "benchmarks/engine_figures.h"

#include <vector>

namespace bergamo::benchmark
{

/// One measured run of the engine.
struct StepTiming
{
  int n_steps = 0;
  double seconds = 0.;                     ///< wall clock
  std::size_t n_pairs = 0, n_contacts = 0; ///< Verlet pairs and touching ones, at the end
  std::int64_t n_searches = 0, n_rebuilds = 0;
  StepBytes bytes; ///< of one step
  std::vector<Phase> phases;
};

/// Steps a copy of a packing; the packing itself stays as it is.
StepTiming time_steps(const dem::Simulation &packing, int n_steps);

/// Further steps after some that bring the data to the cores that will work on it.
struct FurtherSteps
{
  double seconds = 0.; ///< wall clock
  std::vector<Phase> phases;
};
FurtherSteps time_further_steps(dem::Simulation &simulation, int n_steps);

/// Least, middle and largest of some values.
struct Spread
{
  double least = 0., median = 0., most = 0.;
};

/// @param values at least one
Spread spread(std::vector<double> values);

} // namespace bergamo::benchmark
