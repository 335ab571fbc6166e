// Parallel efficiency over cores for a settled dense packing and for a flowing hourglass, beside the dissertation's,
// and the cost of a step over the number of grains. `scaling --help`.

#include "benchmarks/hourglass.h"
#include "benchmarks/packing_cache.h"
#include "benchmarks/program.h"
#include "benchmarks/resident_memory.h"
#include "benchmarks/step_timing.h"
#include "benchmarks/tiling.h"

#include <omp.h>

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>

namespace
{

using namespace bergamo;
using namespace bergamo::benchmark;

struct Options
{
  std::string study = "dense";
  int n_grains = 0; ///< 0: the study's own
  int n_steps = 0;
  int n_repeats = 0;
  int n_threads = omp_get_num_procs();
  std::filesystem::path cache = BERGAMO_PACKING_CACHE, json;
};

/// Wellmann, fig. 3.17: the hourglass of 1e5 superquadrics while it flows.
const std::map<int, double> dissertation{{2, 0.94}, {4, 0.84}, {8, 0.65}};

/// Time a step of each phase on each number of threads, and its efficiency, over all rounds: where threads wait.
/// @param phases of all rounds by number of threads
nlohmann::json compare_phases(const std::map<int, std::vector<Phase>> &phases, const int n_steps)
{
  const std::vector<Phase> &alone = phases.at(1);
  nlohmann::json rows = nlohmann::json::array();
  for (const auto &[n, of_n] : phases)
  {
    std::cout << "ms a step (efficiency) on " << n << " threads:" << std::fixed;
    for (std::size_t k = 0; k < of_n.size(); ++k)
    {
      const double ms = 1e3 * of_n[k].seconds / n_steps, efficiency = alone[k].seconds / (n * of_n[k].seconds);
      if (!(of_n[k].seconds > 0.))
        continue;
      std::cout << ' ' << of_n[k].name << ' ' << std::setprecision(3) << ms << " (" << std::setprecision(2)
                << efficiency << ')';
      rows.push_back({{"threads", n}, {"phase", of_n[k].name}, {"ms_per_step", ms}, {"efficiency", efficiency}});
    }
    std::cout << '\n';
  }
  return rows;
}

/// Steps on 1, 2, ... threads in turn, for a short while each, so that whatever else the machine does meets them alike;
/// an efficiency compares two of one round.
nlohmann::json measure_efficiency(dem::Simulation &simulation, Options options)
{
  if (options.n_steps == 0)
    options.n_steps = 20;
  if (options.n_repeats == 0)
    options.n_repeats = 31;
  std::map<int, std::vector<double>> speed, efficiency;
  std::map<int, std::vector<Phase>> phases;
  for (int round = 0; round < options.n_repeats; ++round)
    for (int n = 1; n <= options.n_threads; n = n < 4 ? n + 1 : 2 * n)
    {
      omp_set_num_threads(n);
      const FurtherSteps steps = time_further_steps(simulation, options.n_steps);
      speed[n].push_back(simulation.particles.size() * options.n_steps / steps.seconds);
      phases[n].resize(steps.phases.size());
      for (std::size_t k = 0; k < steps.phases.size(); ++k)
        phases[n][k] = {steps.phases[k].name, phases[n][k].seconds + steps.phases[k].seconds};
      efficiency[n].push_back(speed[n].back() / (n * speed[1].back()));
    }
  nlohmann::json rows = nlohmann::json::array();
  std::cout << "threads   million particle-steps/s   efficiency, least median most   dissertation (flowing)\n"
            << std::fixed;
  for (const auto &[n, values] : efficiency)
  {
    const Spread s = spread(values), v = spread(speed[n]);
    std::cout << std::setw(7) << n << std::setw(27) << std::setprecision(2) << 1e-6 * v.median << std::setw(20)
              << std::setprecision(3) << s.least << std::setw(7) << s.median << std::setw(6) << s.most;
    if (const auto known = dissertation.find(n); known != dissertation.end())
      std::cout << std::setw(17) << std::setprecision(2) << known->second;
    std::cout << '\n';
    rows.push_back({{"threads", n},
                    {"particle_steps_per_second", v.median},
                    {"efficiency", {{"least", s.least}, {"median", s.median}, {"most", s.most}}}});
  }
  return {{"rows", rows}, {"phases", compare_phases(phases, options.n_steps * options.n_repeats)}};
}

nlohmann::json dense(Options options)
{
  if (options.n_grains == 0)
    options.n_grains = 50000;
  omp_set_num_threads(options.n_threads);
  const auto packing = cached_packing(options.cache, {.n_grains = options.n_grains}, log_line);
  const PackingFigures f = packing_figures(*packing);
  std::cout << "dense packing: " << packing->particles.size() << " superquadrics, " << f.coordination_number
            << " contacts a grain\n";
  return measure_efficiency(*packing, options);
}

nlohmann::json flowing(Options options)
{
  HourglassRecipe recipe;
  if (options.n_grains != 0)
    recipe.n_grains = options.n_grains;
  omp_set_num_threads(options.n_threads);
  const auto hourglass = cached_hourglass(options.cache, recipe, log_line);
  const FlowFigures f = flow_figures(*hourglass);
  std::cout << "flowing hourglass: " << f.n_grains << " superquadrics and " << f.n_wall_spheres << " fixed spheres, "
            << f.coordination_number << " contacts a grain, mean speed " << f.mean_speed << " m/s\n";
  return measure_efficiency(*hourglass, options);
}

nlohmann::json size(Options options)
{
  const int n_most = options.n_grains ? options.n_grains : 1000000;
  omp_set_num_threads(1);
  const auto cell = cached_packing(options.cache, {.n_grains = 1000}, log_line);
  nlohmann::json rows = nlohmann::json::array();
  std::cout << "   grains   contacts a grain   ns a grain and step, least median most   bytes a grain\n" << std::fixed;
  for (int n = 1; n * n * n * static_cast<int>(cell->particles.size()) <= n_most; n = n < 2 ? 2 : (n < 5 ? 5 : 2 * n))
  {
    const double before = resident_memory();
    auto packing = tile(*cell, n);
    for (int i = 0; i < 3; ++i)
      packing->step();
    const double bytes = (resident_memory() - before) / packing->particles.size();
    const int steps =
        options.n_steps ? options.n_steps : std::max(5, static_cast<int>(5e6 / packing->particles.size()));
    std::vector<double> cost;
    for (int repeat = 0; repeat < (options.n_repeats ? options.n_repeats : 5); ++repeat)
      cost.push_back(1e9 * time_steps(*packing, steps).seconds / steps / packing->particles.size());
    const Spread s = spread(cost);
    const double contacts = 2. * packing->contacts.n_touching() / packing->particles.size();
    std::cout << std::setw(9) << packing->particles.size() << std::setw(19) << std::setprecision(2) << contacts
              << std::setw(28) << std::setprecision(0) << s.least << std::setw(7) << s.median << std::setw(6) << s.most
              << std::setw(16) << bytes << std::endl;
    rows.push_back({{"grains", packing->particles.size()},
                    {"ns_per_grain_and_step", {{"least", s.least}, {"median", s.median}, {"most", s.most}}},
                    {"bytes_per_grain", bytes}});
  }
  return {{"rows", rows}};
}

std::optional<Options> parse(const int argc, char **const argv)
{
  Options o;
  CLI::App app("Parallel efficiency of the steps over cores, or their cost over the number of grains.", "scaling");
  app.add_option("study", o.study,
                 "dense: settled packing; flowing: hourglass; size: one thread, 10^3 to 10^6 grains (default: dense)")
      ->check(CLI::IsMember({"dense", "flowing", "size"}));
  app.add_option("--grains", o.n_grains, "Grains (default: 50000 dense, 100000 flowing, at most 1000000 size)")
      ->check(CLI::PositiveNumber);
  app.add_option("--steps", o.n_steps, "Measured steps of each turn (default: 20; size: by the number of grains)")
      ->check(CLI::PositiveNumber);
  app.add_option("--repeats", o.n_repeats, "Rounds (default: 31; size: 5)")->check(CLI::PositiveNumber);
  app.add_option("--threads", o.n_threads, "Most threads (default: all cores)")->check(CLI::PositiveNumber);
  app.add_option("--cache", o.cache, "Folder of settled packings (default: " + o.cache.string() + ")");
  app.add_option("--json", o.json, "Write the figures to this file, too");
  app.footer("Keep the machine free of other work: threads wait for one another at every phase of a step.");
  if (!parse_arguments(app, argc, argv))
    return std::nullopt;
  make_cache(o.cache);
  return o;
}

nlohmann::json measure(const Options &options)
{
  nlohmann::json figures = options.study == "dense"     ? dense(options)
                           : options.study == "flowing" ? flowing(options)
                                                        : size(options);
  figures["study"] = options.study;
  return figures;
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program("scaling",
                     [&]
                     {
                       if (const auto options = parse(argc, argv))
                         write_figures(options->json, [&] { return measure(*options); });
                     });
}
