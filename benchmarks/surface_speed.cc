// What walls of triangles cost beside plane ones: a settled packing in a box of six planes, in a box of twelve
// triangles and in one of many, at rest and while it flows out of the box, step by step in turns. `surface_speed
// --help`.

#include "benchmarks/packing_cache.h"
#include "benchmarks/program.h"
#include "benchmarks/step_timing.h"

#include <omp.h>

#include <cmath>
#include <iomanip>
#include <iostream>

namespace
{

using namespace bergamo;
using namespace bergamo::benchmark;

struct Options
{
  int n_grains = 4000, n_triangles = 20000, n_steps = 100, n_repeats = 9;
  std::string kind = "superquadrics";
  bool flows = false;
  std::filesystem::path cache = BERGAMO_PACKING_CACHE, json;
};

/// A rectangle of 2 n^2 triangles.
dem::Surface rectangle(const Vec3 &corner, const Vec3 &first, const Vec3 &second, const int n)
{
  std::vector<Vec3> nodes;
  std::vector<dem::Triangle> triangles;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      nodes.push_back(corner + first * (double(i) / n) + second * (double(j) / n));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      const std::int32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    }
  return {nodes, triangles};
}

/// The packing with walls of 2 n^2 triangles each in place of its planes, which are -x, x, -y, y, -z, z; n = 0 keeps
/// planes. @param is_open leaves out the floor
dem::Simulation in_box(const dem::Simulation &packing, const int n, const bool is_open)
{
  dem::Simulation simulation = packing;
  if (is_open)
  {
    dem::SimulationParameters p = simulation.parameters();
    p.gravity = Vec3(0., 0., -9.81);
    simulation.change(p);
  }
  const std::vector<dem::PlaneWall> walls = simulation.walls;
  Vec3 low, high;
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = walls[2 * axis].point[axis];
    high[axis] = walls[2 * axis + 1].point[axis];
  }
  if (is_open) // the walls go on below
    low[2] -= high[2] - low[2];
  const Vec3 size = high - low;
  for (int w = 5; w >= 0; --w)
  {
    if (n > 0 || (is_open && w == 4))
      simulation.remove_wall(w);
    if (n == 0 || (is_open && w == 4))
      continue;
    const int axis = w / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
    const Vec3 first = size[a] * Vec3::Unit(a), second = size[b] * Vec3::Unit(b);
    const bool is_far = w % 2;
    Vec3 corner = low;
    if (is_far)
      corner[axis] = high[axis];
    simulation.add_surface(is_far ? rectangle(corner, second, first, n) : rectangle(corner, first, second, n));
  }
  return simulation;
}

nlohmann::json measure(const Options &options)
{
  omp_set_num_threads(1);
  const GrainKind kind = options.kind == "spheres" ? GrainKind::spheres : GrainKind::superquadrics;
  const auto packing = cached_packing(options.cache, {.kind = kind, .n_grains = options.n_grains}, log_line);
  const int n_fine = std::max(1, static_cast<int>(std::lround(std::sqrt(options.n_triangles / 12.))));
  const std::vector<int> boxes{0, 1, n_fine};
  std::vector<dem::Simulation> simulations;
  for (const int n : boxes)
    simulations.push_back(in_box(*packing, n, options.flows));
  std::vector<std::vector<double>> seconds(boxes.size()), ratio(boxes.size());
  std::vector<std::vector<Phase>> phases(boxes.size());
  for (int repeat = 0; repeat < options.n_repeats; ++repeat)
    for (std::size_t k = 0; k < boxes.size(); ++k)
    {
      const FurtherSteps steps = time_further_steps(simulations[k], options.n_steps);
      seconds[k].push_back(steps.seconds);
      ratio[k].push_back(seconds[0].back() / steps.seconds);
      phases[k].resize(steps.phases.size());
      for (std::size_t j = 0; j < steps.phases.size(); ++j)
        phases[k][j] = {steps.phases[j].name, phases[k][j].seconds + steps.phases[j].seconds};
    }
  std::cout << packing->particles.size() << ' ' << options.kind << (options.flows ? " falling" : " at rest") << ", "
            << options.n_repeats << " times " << options.n_steps << " steps in turns\n"
            << "triangles   wall contacts   million particle-steps/s   over planes, least median most\n";
  nlohmann::json rows = nlohmann::json::array();
  for (std::size_t k = 0; k < boxes.size(); ++k)
  {
    const Spread speed = spread(seconds[k]), over = spread(ratio[k]);
    const double rate = packing->particles.size() * options.n_steps / speed.median;
    const int triangles = 2 * boxes[k] * boxes[k] * (options.flows ? 5 : 6);
    std::cout << std::setw(9) << triangles << std::setw(16) << simulations[k].contacts.n_touching_walls() << std::fixed
              << std::setprecision(2) << std::setw(27) << 1e-6 * rate << std::setprecision(3) << std::setw(14)
              << over.least << std::setw(8) << over.median << std::setw(7) << over.most << '\n'
              << "          ms a step:";
    for (const Phase &p : phases[k])
      std::cout << ' ' << p.name << ' ' << 1e3 * p.seconds / options.n_steps / options.n_repeats;
    std::cout << '\n' << std::defaultfloat;
    rows.push_back({{"triangles", triangles},
                    {"particle_steps_per_second", rate},
                    {"over_planes", {{"least", over.least}, {"median", over.median}, {"most", over.most}}}});
  }
  return rows;
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program(
      "surface_speed",
      [&]
      {
        Options options;
        CLI::App app("Speed of a packing between walls of triangles over that between planes.", "surface_speed");
        app.add_option("--grains", options.n_grains, "Grains (default: 4000)")->check(CLI::PositiveNumber);
        app.add_option("--triangles", options.n_triangles, "Of the fine box, about (default: 20000)")
            ->check(CLI::PositiveNumber);
        app.add_option("--kind", options.kind, "superquadrics or spheres")
            ->check(CLI::IsMember({"superquadrics", "spheres"}));
        app.add_flag("--flow", options.flows, "Takes away the floor, under gravity");
        app.add_option("--steps", options.n_steps, "Steps a turn (default: 100)")->check(CLI::PositiveNumber);
        app.add_option("--repeats", options.n_repeats, "Turns (default: 9)")->check(CLI::PositiveNumber);
        app.add_option("--cache", options.cache, "Folder of packings");
        app.add_option("--json", options.json, "File for the figures");
        if (!parse_arguments(app, argc, argv))
          return;
        make_cache(options.cache);
        write_figures(options.json, [&] { return measure(options); });
      });
}
