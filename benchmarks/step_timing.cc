#include "benchmarks/step_timing.h"

#include <algorithm>
#include <chrono>

namespace bergamo::benchmark
{

StepTiming time_steps(const dem::Simulation &packing, const int n_steps)
{
  dem::Simulation simulation = packing;
  simulation.step(); // brings the copy into the caches
  const std::vector<Phase> before = phase_times(simulation);
  const auto n_searches = simulation.contacts.n_searches(), n_rebuilds = simulation.n_rebuilds();

  const auto start = std::chrono::steady_clock::now();
  for (int n = 0; n < n_steps; ++n)
    simulation.step();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  simulation.check_finite();
  StepTiming timing{n_steps,
                    seconds,
                    static_cast<std::size_t>(simulation.contacts.n_candidates()),
                    n_touching(simulation),
                    simulation.contacts.n_searches() - n_searches,
                    simulation.n_rebuilds() - n_rebuilds,
                    step_bytes(simulation),
                    phase_times(simulation)};
  for (std::size_t k = 0; k < before.size(); ++k)
    timing.phases[k].seconds -= before[k].seconds;
  return timing;
}

FurtherSteps time_further_steps(dem::Simulation &simulation, const int n_steps)
{
  constexpr int n_first = 3;
  for (int n = 0; n < n_first; ++n)
    simulation.step();
  const std::vector<Phase> before = phase_times(simulation);
  const auto start = std::chrono::steady_clock::now();
  for (int n = 0; n < n_steps; ++n)
    simulation.step();
  FurtherSteps steps{std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                     phase_times(simulation)};
  for (std::size_t k = 0; k < before.size(); ++k)
    steps.phases[k].seconds -= before[k].seconds;
  return steps;
}

Spread spread(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values.front(), 0.5 * (values[(n - 1) / 2] + values[n / 2]), values.back()};
}

} // namespace bergamo::benchmark
