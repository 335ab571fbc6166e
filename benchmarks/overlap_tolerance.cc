// What the search of a contact only when its motion asks for it costs in accuracy, and gains in speed: a settled
// packing is compressed with several overlap tolerances, and its contact forces are compared with those of a search at
// every step. `overlap_tolerance [grains] [steps]`.

#include "benchmarks/packing_cache.h"
#include "benchmarks/program.h"
#include "benchmarks/step_timing.h"

#include <omp.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <utility>

namespace
{

using namespace bergamo;
using namespace bergamo::benchmark;

constexpr double strain_rate = 10.; // of the packing's height [1/s]

struct Outcome
{
  std::map<std::pair<int, int>, Vec3> force; ///< by grains [N]
  double seconds = 0., searches = 0.;        ///< searches a contact and step
};

Outcome compress(const dem::Simulation &packing, const double tolerance, const int n_steps)
{
  dem::Simulation simulation = packing;
  dem::SimulationParameters parameters = simulation.parameters();
  parameters.contact.overlap_tolerance = tolerance;
  simulation.change(parameters);
  const double height = simulation.walls[5].point[2] - simulation.walls[4].point[2];
  simulation.walls[5].velocity = Vec3(0., 0., -strain_rate * height);
  const auto n_searches = simulation.contacts.n_searches();
  const auto start = std::chrono::steady_clock::now();
  for (int n = 0; n < n_steps; ++n)
    simulation.step();
  Outcome outcome;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.searches =
      static_cast<double>(simulation.contacts.n_searches() - n_searches) / n_steps / simulation.contacts.n_touching();
  for (const dem::TouchingContact &c : simulation.contacts.touching(simulation.particles))
    outcome.force[{c.first, c.second}] = c.state.force();
  return outcome;
}

/// Sum of the differences of all contact forces over the sum of the forces.
double relative_error(const Outcome &outcome, const Outcome &reference)
{
  double error = 0., sum = 0.;
  const Vec3 none = Vec3::Zero();
  for (const auto &[grains, force] : reference.force)
  {
    const auto found = outcome.force.find(grains);
    error += (force - (found == outcome.force.end() ? none : found->second)).norm();
    sum += force.norm();
  }
  for (const auto &[grains, force] : outcome.force)
    if (!reference.force.contains(grains))
      error += force.norm();
  return error / sum;
}

void measure(const int n_grains, const int n_steps)
{
  omp_set_num_threads(1);
  const std::filesystem::path cache = BERGAMO_PACKING_CACHE;
  make_cache(cache);
  const auto packing = cached_packing(cache, {.n_grains = n_grains}, log_line);
  const Outcome every_step = compress(*packing, 0., n_steps);
  std::cout << n_grains << " superquadrics, " << n_steps << " steps of " << packing->parameters().time_step
            << " s at a strain rate of " << strain_rate << " 1/s\n"
            << "tolerance   searches a contact and step   error of the contact forces   time over that of 0\n";
  for (const double tolerance : {0., 1e-6, 1e-5, 1e-4, 1e-3, 1e-2})
  {
    const Outcome o = tolerance == 0. ? every_step : compress(*packing, tolerance, n_steps);
    std::cout << std::setw(9) << tolerance << std::setw(30) << o.searches << std::setw(30)
              << relative_error(o, every_step) << std::setw(22) << o.seconds / every_step.seconds << '\n';
  }
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program("overlap_tolerance",
                     [&]
                     {
                       int n_grains = 1000, n_steps = 2000;
                       CLI::App app("Error of the contact forces and time over the tolerance of the overlap.",
                                    "overlap_tolerance");
                       app.add_option("grains", n_grains, "Grains (default: 1000)")->check(CLI::PositiveNumber);
                       app.add_option("steps", n_steps, "Steps (default: 2000)")->check(CLI::PositiveNumber);
                       if (parse_arguments(app, argc, argv))
                         measure(n_grains, n_steps);
                     });
}
