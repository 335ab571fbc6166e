#include "benchmarks/engine_figures.h"

namespace bergamo::benchmark
{

std::size_t n_touching(const dem::Simulation &simulation)
{
  return simulation.contacts.n_touching();
}

double mean_relative_overlap(const dem::Simulation &simulation)
{
  double overlaps = 0., distances = 0.;
  for (const dem::TouchingContact &contact : simulation.contacts.touching(simulation.particles))
  {
    overlaps += contact.state.overlap;
    distances += contact.branch.norm();
  }
  return distances > 0. ? overlaps / distances : 0.;
}

std::vector<Phase> phase_times(const dem::Simulation &simulation)
{
  const PhaseTimes &t = simulation.times;
  return {{"neighbours", t.neighbours}, {"contacts", t.contacts},   {"screening", t.screening},
          {"searches", t.searches},     {"summation", t.summation}, {"motion", t.motion}};
}

} // namespace bergamo::benchmark
