// Time to make a packing geometrically: grains in a periodic box, placed at random to a solid fraction of 0.26 and
// tightened to 0.55, beside the figures of the dissertation (3.4.4). `packing --help`.

#include "benchmarks/program.h"
#include "dem/core/whole_file.h"
#include "dem/measure/histogram.h"
#include "dem/packing/grading.h"
#include "dem/packing/tightening.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace
{

using namespace bergamo;
using namespace bergamo::benchmark;

struct Options
{
  int n_grains = 278056; ///< the dissertation's example
  double solid_fraction = 0.55, start_solid_fraction = 0.26, size_step = dem::TighteningParameters().size_step;
  std::uint64_t seed = 1;
  std::filesystem::path json, curves, sizes;
};

double seconds_since(const std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Share of the grains in each class of the radius of the sphere of equal volume, as drawn and as packed.
std::string size_table(const std::vector<dem::Superquadric> &grains, const std::vector<double> &size)
{
  std::ostringstream file;
  std::vector<double> drawn, packed;
  for (std::size_t i = 0; i < grains.size(); ++i)
  {
    drawn.push_back(std::cbrt(0.75 * dem::volume(grains[i]) / std::numbers::pi));
    packed.push_back(drawn.back() * size[i]);
  }
  const dem::Bins bins{.n = 100, .highest = 1.0001 * std::ranges::max(drawn)};
  const dem::Histogram before = dem::histogram(drawn, bins), after = dem::histogram(packed, bins);
  file << "radius_m,density_drawn_per_m,density_packed_per_m\n";
  for (int k = 0; k < bins.n; ++k)
    file << (k + 0.5) * before.width << ',' << before.density[k] << ',' << after.density[k] << '\n';
  return file.str();
}

/// One row a round of the addition and an iteration of the tightening.
std::string curve_table(const std::vector<dem::AdditionRound> &rounds, const std::vector<dem::TighteningStep> &steps,
                        const int n_grains)
{
  std::ostringstream file;
  file << "stage,iteration,remaining_share,trials_per_placed_grain,solid_fraction,mean_size,smallest_size\n";
  double remaining = n_grains;
  constexpr double row_growth = 1.02; // the last rounds try few grains each
  std::size_t next_row = 1;
  double n_tried = 0., n_placed = 0.;
  for (std::size_t k = 0; k < rounds.size(); ++k)
  {
    n_tried += rounds[k].n_tried;
    n_placed += rounds[k].n_placed;
    remaining -= rounds[k].n_placed;
    if (k + 1 < next_row && k + 1 != rounds.size())
      continue;
    next_row = std::max(k + 2, static_cast<std::size_t>(row_growth * (k + 1)));
    file << "addition," << k + 1 << ',' << remaining / n_grains << ',';
    if (n_placed > 0.)
      file << n_tried / n_placed;
    file << ",,,\n";
    n_tried = n_placed = 0.;
  }
  for (std::size_t k = 0; k < steps.size(); ++k)
    file << "tightening," << k + 1 << ",,," << steps[k].solid_fraction << ',' << steps[k].mean_size << ','
         << steps[k].smallest_size << '\n';
  return file.str();
}

void commit(WholeFile &file, const std::string &text)
{
  file.write(text);
  file.commit();
}

nlohmann::json measure(const Options &options)
{
  std::optional<WholeFile> curves, sizes; // opened now, so that a wrong path is known before any work
  if (!options.curves.empty())
    curves.emplace(options.curves);
  if (!options.sizes.empty())
    sizes.emplace(options.sizes);
  std::mt19937_64 generator(options.seed);
  std::vector<dem::Superquadric> grains;
  double solid_volume = 0.;
  for (int i = 0; i < options.n_grains; ++i)
  {
    grains.push_back(dem::draw_grain(dem::GrainDistribution(), generator));
    solid_volume += dem::volume(grains.back());
  }
  const double edge = std::cbrt(solid_volume / options.solid_fraction);
  const auto space = dem::PackingSpace::periodic({Vec3::Zero(), Vec3::Constant(edge)});
  dem::LoosePacking loose;
  loose.size = std::min(1., std::cbrt(options.start_solid_fraction / options.solid_fraction));
  std::vector<dem::Superquadric> small = grains;
  for (dem::Superquadric &grain : small)
    grain.half_axes *= loose.size;

  auto start = std::chrono::steady_clock::now();
  dem::RandomAddition addition = dem::place_at_random(small, space, generator());
  const double addition_time = seconds_since(start);
  loose.places = std::move(addition.places);
  log_line("placed after " + std::to_string(addition_time) + " s");
  dem::TighteningParameters parameters;
  parameters.size_step = options.size_step;
  start = std::chrono::steady_clock::now();
  const dem::Tightening tight = dem::tighten(grains, space, loose, parameters, generator());
  const double tightening_time = seconds_since(start);

  double n_trials = 0.;
  for (const dem::AdditionRound &round : addition.rounds)
    n_trials += round.n_tried;
  const double reached = tight.steps.empty() ? options.start_solid_fraction : tight.steps.back().solid_fraction,
               smallest = tight.steps.empty() ? 1. : tight.steps.back().smallest_size;
  std::cout << options.n_grains << " superquadrics in a periodic cube of " << 1000. * edge << " mm, "
            << omp_get_max_threads() << " threads; beside: Wellmann 3.4.4, 278 056 superquadrics, 6 cores\n"
            << "random addition to " << options.start_solid_fraction << ": " << addition_time << " s (943 s to 0.26), "
            << n_trials / options.n_grains << " trials a grain, " << addition.rounds.size() << " rounds (2200)\n"
            << "tightening to " << reached << ": " << tightening_time << " s (about 3 h to 0.55), "
            << tight.steps.size() << " iterations (250), smallest size " << smallest << " of the one drawn\n"
            << "core seconds a grain: " << (addition_time + tightening_time) * omp_get_max_threads() / options.n_grains
            << " (" << (943. + 3. * 3600.) * 6. / 278056. << ")\n";
  if (curves)
    commit(*curves, curve_table(addition.rounds, tight.steps, options.n_grains));
  if (sizes)
    commit(*sizes, size_table(grains, tight.size));
  return {{"grains", options.n_grains},
          {"threads", omp_get_max_threads()},
          {"edge_m", edge},
          {"addition_s", addition_time},
          {"addition_rounds", addition.rounds.size()},
          {"trials_per_grain", n_trials / options.n_grains},
          {"tightening_s", tightening_time},
          {"tightening_iterations", tight.steps.size()},
          {"solid_fraction", reached},
          {"smallest_size", smallest}};
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program(
      "packing",
      [&]
      {
        Options options;
        CLI::App app("Time to place grains at random and to tighten their packing.", "packing");
        app.add_option("--grains", options.n_grains, "Grains (default: 278056)")->check(CLI::Range(100, 10000000));
        app.add_option("--solid-fraction", options.solid_fraction, "Aim (default: 0.55)")->check(CLI::Range(0.05, 0.7));
        app.add_option("--start", options.start_solid_fraction, "Solid fraction of the random addition (default: 0.26)")
            ->check(CLI::Range(0.01, 0.35));
        app.add_option("--size-step", options.size_step, "Growth in an iteration (default: 0.0015)")
            ->check(CLI::Range(1e-4, 0.1));
        app.add_option("--seed", options.seed, "Seed (default: 1)");
        app.add_option("--json", options.json, "File for the figures");
        app.add_option("--curves", options.curves, "CSV file for trials and solid fraction over the iterations");
        app.add_option("--sizes", options.sizes, "CSV file for the distribution of sizes, as drawn and as packed");
        if (parse_arguments(app, argc, argv))
          write_figures(options.json, [&] { return measure(options); });
      });
}
