// Speed of the explicit elements against what their formulas need and what the core can do, their parallel efficiency,
// and their cost over the number of elements. `explicit_solid --help`.

#include "benchmarks/core_peak.h"
#include "benchmarks/membrane_speed.h"
#include "benchmarks/program.h"
#include "benchmarks/resident_memory.h"
#include "benchmarks/solid_case.h"
#include "benchmarks/solid_speed.h"
#include "benchmarks/step_timing.h"
#include "dem/core/error.h"

#include <malloc.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
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
  std::string study = "speed", only;
  int n_elements = 0; ///< 0: the study's own
  int n_steps = 10;
  int n_repeats = 0;
  int n_threads = omp_get_num_procs();
  std::filesystem::path json;
};

std::vector<SolidCase> chosen_cases(const Options &options)
{
  std::vector<SolidCase> cases = solid_cases();
  const auto is_left_out = [&](const SolidCase &c)
  {
    if (!options.only.empty())
      return (c.name + ' ' + std::to_string(c.nodes_per_element())).find(options.only) == std::string::npos;
    return options.study != "speed" && !(c.degree == 1 && (c.name == "elastic" || c.name == "Mohr-Coulomb flowing"));
  };
  std::erase_if(cases, is_left_out);
  if (cases.empty())
    throw ConfigError("--only '" + options.only + "' names no case; give a part of a name such as 'Ogden 27'");
  return cases;
}

nlohmann::json speed(const Options &options)
{
  omp_set_num_threads(1);
  CorePeak peak;
  std::vector<SolidSpeed> speeds;
  for (const SolidCase &what : chosen_cases(options))
  {
    log_line(name_of(what));
    raise_core_peak(peak); // beside every case, since other work on the machine lowers it for a while
    const int n_along = edges_of_cube(what, options.n_elements ? options.n_elements : 27000);
    speeds.push_back(measure_speed(what, n_along, options.n_repeats, options.n_steps));
  }
  std::cout << std::fixed << std::setprecision(1) << "one core: " << 1e-9 * peak.operations
            << " GFLOP/s in multiply-adds, reads " << 1e-9 * peak.reading << " GB/s; " << options.n_repeats << " x "
            << options.n_steps << " steps\n\n";
  print_rates(std::cout, speeds, peak);
  print_parts(std::cout, speeds);
  print_needs(std::cout, speeds);
  nlohmann::json rows = nlohmann::json::array();
  for (const SolidSpeed &of_case : speeds)
    rows.push_back(json_of(of_case));
  return {{"peak", {{"operations_per_second", peak.operations}, {"bytes_read_per_second", peak.reading}}},
          {"rows", rows}};
}

/// Steps on 1, 2, ... threads in turn, so that whatever else the machine does meets them alike; an efficiency compares
/// two of one round.
nlohmann::json scaling(const Options &options)
{
  nlohmann::json rows = nlohmann::json::array();
  std::cout << "                            nodes  threads   million elements/s   efficiency, least median   most\n"
            << std::fixed;
  for (const SolidCase &what : chosen_cases(options))
  {
    MovingSolid solid(what, edges_of_cube(what, options.n_elements ? options.n_elements : 27000));
    std::map<int, std::vector<double>> rate, efficiency;
    for (int round = 0; round < options.n_repeats; ++round)
      for (int n = 1; n <= options.n_threads; n = n < 4 ? n + 1 : 2 * n)
      {
        omp_set_num_threads(n);
        solid.step(2); // brings the data to the cores
        rate[n].push_back(double(options.n_steps) * solid.body.n_elements() / solid.step(options.n_steps).whole());
        efficiency[n].push_back(rate[n].back() / (n * rate[1].back()));
      }
    for (const auto &[n, values] : efficiency)
    {
      const Spread s = spread(values), v = spread(rate[n]);
      std::cout << name_of(what) << std::setw(9) << n << std::setprecision(3) << std::setw(21) << 1e-6 * v.median
                << std::setw(20) << s.least << std::setw(7) << s.median << std::setw(7) << s.most << std::endl;
      rows.push_back({{"case", what.name},
                      {"nodes_per_element", what.nodes_per_element()},
                      {"threads", n},
                      {"elements_per_second", json_of(v)},
                      {"efficiency", json_of(s)}});
    }
  }
  return {{"rows", rows}};
}

nlohmann::json size(const Options &options)
{
  omp_set_num_threads(1);
  const int n_most = options.n_elements ? options.n_elements : 1000000;
  nlohmann::json rows = nlohmann::json::array();
  std::cout << "                            nodes  elements   ns an element and step, least median   most   bytes an "
               "element\n"
            << std::fixed << std::setprecision(0);
  for (const SolidCase &what : chosen_cases(options))
    for (double n = 1000.; n < 1.01 * n_most; n *= 10.)
    {
      malloc_trim(0); // so that the memory of the last solid does not hide some of this one's
      const double before = resident_memory();
      MovingSolid solid(what, edges_of_cube(what, static_cast<int>(n)));
      const double n_elements = solid.body.n_elements(), bytes = (resident_memory() - before) / n_elements;
      const int n_steps = std::max(options.n_steps, static_cast<int>(3e4 / n_elements));
      std::vector<double> cost;
      for (int repeat = 0; repeat < options.n_repeats; ++repeat)
        cost.push_back(1e9 * solid.step(n_steps).whole() / (n_steps * n_elements));
      const Spread s = spread(cost);
      std::cout << name_of(what) << std::setw(10) << n_elements << std::setw(32) << s.least << std::setw(7) << s.median
                << std::setw(7) << s.most << std::setw(19) << bytes << std::endl;
      rows.push_back({{"case", what.name},
                      {"nodes_per_element", what.nodes_per_element()},
                      {"elements", n_elements},
                      {"ns_per_element_and_step", json_of(s)},
                      {"bytes_per_element", bytes}});
    }
  return {{"rows", rows}};
}

nlohmann::json membranes(const Options &options)
{
  omp_set_num_threads(1);
  CorePeak peak;
  raise_core_peak(peak);
  const double n_elements = options.n_elements ? options.n_elements : 27000;
  const MembraneSpeed speed =
      measure_membranes(static_cast<int>(std::sqrt(n_elements)), options.n_repeats, options.n_steps);
  const Spread rate{1e3 / speed.step.most, 1e3 / speed.step.median, 1e3 / speed.step.least};
  std::cout << std::fixed << std::setprecision(0) << "Neo-Hookean membranes of 4 nodes, " << speed.n_elements
            << ": an element needs " << speed.operations << " operations and moves " << speed.bytes << " bytes\n"
            << std::setprecision(2) << "million elements/s: least " << rate.least << ", median " << rate.median
            << ", most " << rate.most << "; GFLOP/s " << speed.operations / speed.step.median << " of "
            << 1e-9 * peak.operations << ", GB/s " << speed.bytes / speed.step.median << " of " << 1e-9 * peak.reading
            << std::endl;
  return {{"elements", speed.n_elements},
          {"million_elements_per_second", json_of(rate)},
          {"operations", speed.operations},
          {"bytes_moved_per_step", speed.bytes}};
}

std::optional<Options> parse(const int argc, char **const argv)
{
  Options o;
  CLI::App app(
      "Steps of explicit solids (forces, kick, drift): speed by element and material beside the operations and "
      "bytes that they need, efficiency over cores, cost over the number of elements.",
      "explicit_solid");
  app.add_option("--study", o.study,
                 "speed: one thread, all cases; scaling: 1 to all threads; size: one thread, 10^3 to 10^6 elements; "
                 "membranes: one thread, a sheet (default: speed)")
      ->check(CLI::IsMember({"speed", "scaling", "size", "membranes"}));
  app.add_option("--only", o.only,
                 "Only cases whose name and number of nodes, such as 'Ogden 27', hold this (default: all; scaling and "
                 "size: elastic and flowing Mohr-Coulomb of 8 nodes)");
  app.add_option("--elements", o.n_elements,
                 "About so many of 8 nodes, an eighth of it with 27 (default: 27000; at most 1000000 size)")
      ->check(CLI::PositiveNumber);
  app.add_option("--steps", o.n_steps, "Measured steps of each turn (default: 10)")->check(CLI::PositiveNumber);
  app.add_option("--repeats", o.n_repeats, "Turns (default: 7; scaling: 31)")->check(CLI::PositiveNumber);
  app.add_option("--threads", o.n_threads, "Most threads of scaling (default: all cores)")->check(CLI::PositiveNumber);
  app.add_option("--json", o.json, "Write the figures to this file, too");
  app.footer("The step is timed in a body; the law and the loop over the elements by themselves, on copies of the "
             "body's state and in turn with it. 'Strain, force' is the loop less the law, 'sums at nodes' the body's "
             "forces less the loop: differences of two times, so keep the machine free of other work. Operations are "
             "those that the formulas need (benchmarks/solid_cost.h), not those that run.");
  if (!parse_arguments(app, argc, argv))
    return std::nullopt;
  if (o.n_repeats == 0)
    o.n_repeats = o.study == "scaling" ? 31 : 7;
  return o;
}

nlohmann::json measure(const Options &options)
{
  nlohmann::json figures = options.study == "speed"       ? speed(options)
                           : options.study == "scaling"   ? scaling(options)
                           : options.study == "membranes" ? membranes(options)
                                                          : size(options);
  figures["study"] = options.study;
  return figures;
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program("explicit_solid",
                     [&]
                     {
                       if (const auto options = parse(argc, argv))
                         write_figures(options->json, [&] { return measure(*options); });
                     });
}
