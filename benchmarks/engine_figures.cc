#include "benchmarks/engine_figures.h"

#include <algorithm>

namespace bergamo::benchmark
{
namespace
{

/// A template, so that an engine without `times` compiles, too.
template <class Simulation>
std::vector<Phase> phases_of(const Simulation &simulation)
{
  if constexpr (requires { simulation.times; })
  {
    const auto &t = simulation.times;
    return {{"neighbours", t.neighbours}, {"screening", t.screening}, {"contacts", t.contacts},
            {"searches", t.searches},     {"walls", t.walls},         {"summation", t.summation},
            {"motion", t.motion}};
  }
  else
    return {};
}

} // namespace

std::size_t n_touching(const dem::Simulation &simulation)
{
  const auto &states = simulation.pairs.state;
  return std::count_if(states.begin(), states.end(), [](const dem::ContactState &s) { return s.touching != 0.; });
}

double mean_relative_overlap(const dem::Simulation &simulation)
{
  const dem::PairContacts &pairs = simulation.pairs;
  const auto &position = simulation.particles.position;
  double overlaps = 0., distances = 0.;
  for (std::size_t k = 0; k < pairs.list.size(); ++k)
    if (pairs.state[k].touching != 0.)
    {
      overlaps += pairs.state[k].overlap;
      distances += (position[pairs.list.first[k]] - position[pairs.list.second[k]]).norm();
    }
  return distances > 0. ? overlaps / distances : 0.;
}

std::vector<Phase> phase_times(const dem::Simulation &simulation)
{
  return phases_of(simulation);
}

} // namespace bergamo::benchmark
