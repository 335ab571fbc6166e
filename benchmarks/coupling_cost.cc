// What an Arlequin overlap costs beside the grains and the elements that it joins: a slab of sand, all of which lies in
// elements, with penalty, transfer and held edge as in a two-scale run. `coupling_cost --help`.

#include "benchmarks/packing_cache.h"
#include "benchmarks/program.h"
#include "benchmarks/step_timing.h"
#include "benchmarks/tiling.h"
#include "coupling/adapter/two_scale_model.h"
#include "dem/core/state.h"
#include "dem/loading/compression.h"
#include "dem/state/positions_by_id.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <deal.II/grid/tria.h>

#include <omp.h>

#include <cmath>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

namespace
{

using namespace bergamo;
using namespace bergamo::benchmark;
using coupling::TwoScaleModel;

struct Options
{
  int n_grains = 120000;
  int n_steps = 20, n_runs = 5;
  int n_threads = 1;
  std::filesystem::path cache = BERGAMO_PACKING_CACHE, json;
};

constexpr double pressure = 25e3;             // of the packing [Pa]
constexpr std::array<int, 3> copies{4, 4, 1}; // of the settled cell
constexpr double grains_an_element = 107.;    // 120 000 in 15 x 15 x 5 elements, which have 1536 nodes
constexpr int longest_pressing = 1000;        // steps

/// Laps between the parts of a step. On one thread it counts the processor's time, of which other programs take none.
class Laps
{
public:
  void lap(double &part)
  {
    const double now = seconds();
    part += now - last;
    last = now;
  }

private:
  static double seconds()
  {
    return omp_get_max_threads() == 1 ? static_cast<double>(std::clock()) / CLOCKS_PER_SEC : omp_get_wtime();
  }
  double last = seconds();
};

/// As many elements as fit, about as high as wide.
std::array<unsigned int, 3> elements_for(const int n_grains)
{
  const double wide = std::cbrt(n_grains / grains_an_element * copies[0] / (1.2 * copies[2]));
  const auto n = [](const double value) { return std::max(1u, static_cast<unsigned>(std::lround(value))); };
  return {n(wide), n(wide), n(1.2 * wide * copies[2] / copies[0])};
}

/// A slab of copies of a settled cell, pressed until they bear the pressure together.
std::unique_ptr<dem::Simulation> sand(const Options &options)
{
  const int of_cell = options.n_grains / (copies[0] * copies[1] * copies[2]);
  const auto cell = cached_packing(options.cache, {.n_grains = of_cell, .pressure = pressure}, log_line);
  auto grains = tile(*cell, copies);
  dem::CompressionParameters pressing;
  pressing.pressure = pressure;
  pressing.pressure_tolerance = pressing.force_tolerance = 0.1;
  pressing.largest_rate = 100.;
  pressing.longest_time = 10.; // the steps are counted here
  dem::Compression compression(pressing);
  for (int n = 0; n < longest_pressing && !compression.is_finished(); ++n)
    compression.step(*grains);
  for (dem::PlaneWall &wall : grains->walls)
    wall.velocity.setZero();
  const PackingFigures f = packing_figures(*grains);
  std::ostringstream text;
  text << "pressed in " << grains->n_steps << " steps: " << f.pressure / 1e3 << " kPa, coordination "
       << f.coordination_number << ", unbalanced force " << f.unbalanced_force;
  log_line(text.str());
  return grains;
}

/// Grains of which all share the space of a continuum; their weights grow from floor to ceiling.
TwoScaleModel joined(const dem::Simulation &packing, const std::array<unsigned int, 3> &n_elements, double &set_up)
{
  const dem::Box box = dem::box_between(packing.walls);
  dealii::Triangulation<3> mesh;
  const Vec3 margin = 1e-3 * box.edges(); // no centre lies outside
  const Vec3 low = box.low - margin, high = box.high + margin;
  fe::make_box({{low[0], low[1], low[2]}, {high[0], high[1], high[2]}, n_elements}, mesh);
  fe::ExplicitBodyParameters body;
  body.material = fe::MohrCoulomb({.young_modulus = 5e8, .cohesion = 1e9});
  body.initial_stress = fe::uniform_pressure(pressure);
  TwoScaleModel model(std::make_unique<dem::Simulation>(packing), std::make_unique<fe::ExplicitBody>(mesh, body),
                      packing.parameters().time_step);
  for (unsigned int face = 0; face < 5; ++face)
    model.body()->prescribe_velocity(face, face / 2);
  std::vector<double> weight;
  for (const auto &x : model.body()->node_position())
    weight.push_back(0.999 * (x[2] - low[2]) / (high[2] - low[2]));
  Laps watch;
  model.join({}, weight, dem::positions_by_id(model.grains()->particles));
  watch.lap(set_up);
  return model;
}

/// Seconds a step of the parts.
struct Parts
{
  double grain_forces = 0., grain_motion = 0., element_forces = 0., element_motion = 0., coupling = 0.;

  double sum() const { return grain_forces + grain_motion + element_forces + element_motion + coupling; }
};

void step(TwoScaleModel &model, Parts &parts)
{
  const double dt = model.grains()->parameters().time_step;
  auto &grains = *model.parts().movers()[0], &body = *model.parts().movers()[1];
  auto &overlap = *model.parts().couplings()[0];
  Laps watch;
  grains.compute_forces();
  watch.lap(parts.grain_forces);
  body.compute_forces();
  watch.lap(parts.element_forces);
  overlap.apply();
  watch.lap(parts.coupling);
  grains.kick(dt);
  grains.drift(dt);
  watch.lap(parts.grain_motion);
  body.kick(dt);
  body.drift(dt);
  watch.lap(parts.element_motion);
  overlap.follow(dt);
  watch.lap(parts.coupling);
}

std::uint64_t hash_of(const TwoScaleModel &model)
{
  StateHash hash;
  dem::Simulation::visit_state(*model.grains(), hash);
  std::vector<double> u(model.body()->displacement().begin(), model.body()->displacement().end());
  hash("displacement", u);
  return hash.value();
}

nlohmann::json measure(const Options &options)
{
  omp_set_num_threads(options.n_threads);
  const auto packing = sand(options);
  double set_up = 0.;
  TwoScaleModel model = joined(*packing, elements_for(options.n_grains), set_up);
  dem::Simulation alone = *packing;
  const double n = static_cast<double>(alone.particles.size());
  const std::size_t n_coupled = model.coupling()->overlap().n_particles(), n_nodes = model.body()->n_nodes();
  std::cout << n << " grains, " << n_coupled << " of them coupled, " << 2. * n_touching(alone) / n
            << " contacts a grain; " << model.body()->n_elements() << " elements, " << n_nodes << " nodes, "
            << model.coupling()->edge().size() << " grains held; " << options.n_threads << " threads; set up in "
            << set_up << " s\n";

  Parts first;
  for (int k = 0; k < 3; ++k)
  {
    step(model, first);
    alone.step();
  }
  std::array<std::vector<double>, 6> times;      // of the parts and of the grains alone, a run each
  for (int run = 0; run < options.n_runs; ++run) // in turns, so that other work meets all alike
  {
    Parts parts;
    double of_alone = 0.;
    for (int k = 0; k < options.n_steps; ++k)
      step(model, parts);
    Laps watch;
    for (int k = 0; k < options.n_steps; ++k)
      alone.step();
    watch.lap(of_alone);
    const std::array all{parts.grain_forces,   parts.grain_motion, parts.element_forces,
                         parts.element_motion, parts.coupling,     of_alone};
    for (std::size_t k = 0; k < all.size(); ++k)
      times[k].push_back(all[k] / options.n_steps);
  }
  const auto least = [&](const std::size_t k) { return spread(times[k]).least; };
  const Parts of_step{least(0), least(1), least(2), least(3), least(4)};
  const double of_alone = least(5);
  nlohmann::json rows;
  const auto row = [&](const std::string &name, const double seconds)
  {
    std::cout << std::left << std::setw(34) << name << std::right << std::setw(10) << 1e3 * seconds << " ms"
              << std::setw(12) << 1e9 * seconds / n << " ns a grain" << std::setw(10) << 100. * seconds / of_step.sum()
              << " %\n";
    rows[name] = {{"ms", 1e3 * seconds}, {"ns_a_grain", 1e9 * seconds / n}, {"share", seconds / of_step.sum()}};
  };
  std::cout << std::fixed << std::setprecision(2);
  row("grains: forces", of_step.grain_forces);
  row("grains: motion", of_step.grain_motion);
  row("continuum: forces of the elements", of_step.element_forces);
  row("continuum: motion of the nodes", of_step.element_motion);
  row("coupling: apply, follow", of_step.coupling);
  row("a step", of_step.sum());
  row("grains alone, without weights", of_alone);
  row("weights of the grains", of_step.grain_forces + of_step.grain_motion - of_alone);
  std::cout << "hash " << std::hex << hash_of(model) << std::dec << '\n';
  return {{"grains", n},        {"coupled", n_coupled},         {"nodes", n_nodes},
          {"set_up_s", set_up}, {"threads", options.n_threads}, {"parts", rows}};
}

std::optional<Options> parse(const int argc, char **const argv)
{
  Options o;
  CLI::App app("Time of a step of grains that all share the space of a continuum, part by part.", "coupling_cost");
  app.add_option("--grains", o.n_grains, "About as many (default: 120000)")->check(CLI::Range(2000, 10000000));
  app.add_option("--steps", o.n_steps, "Of a run (default: 20)")->check(CLI::PositiveNumber);
  app.add_option("--runs", o.n_runs, "In turns with grains alone; the least time counts (default: 5)")
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", o.n_threads, "Threads (default: 1)")->check(CLI::PositiveNumber);
  app.add_option("--cache", o.cache, "Folder of settled packings");
  app.add_option("--json", o.json, "Write the figures to this file, too");
  if (!parse_arguments(app, argc, argv))
    return std::nullopt;
  return o;
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program("coupling_cost",
                     [&]
                     {
                       if (const auto options = parse(argc, argv))
                       {
                         make_cache(options->cache);
                         write_figures(options->json, [&] { return measure(*options); });
                       }
                     });
}
