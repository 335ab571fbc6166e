// What a clump costs against a plain grain: periodic cells of as many grains of equal volume, plain ones and clumps of
// two and of three overlapping parts, are compressed to one pressure and stepped in turn.
// `clump_cost [grains] [steps]`.

#include "benchmarks/program.h"
#include "benchmarks/step_timing.h"
#include "dem/motion/cell_control.h"
#include "dem/packing/pack_grains.h"

#include <omp.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <utility>
#include <vector>

namespace
{

using namespace bergamo;
using namespace bergamo::benchmark;
using dem::Superquadric;

constexpr double start_fraction = 0.2, pressure = 1e5;       // [Pa]
constexpr double compression_rate = 60., measured_rate = 6.; // [1/s]
constexpr int n_runs = 30;                                   // of the same steps: the least time is that of the work

/// Bodies of 1, 2 and 3 parts, alike in their outline: the halves of a rounded grain are moved apart by less than a
/// half-axis, so the parts overlap.
dem::Clump body_of(const int n_parts)
{
  const Superquadric part{Vec3(0.6, 0.5, 0.5), 0.8, 0.9};
  dem::ClumpShape shape;
  for (int k = 0; k < n_parts; ++k)
    shape.parts.push_back({part, Vec3(0.5 * k, k == 2 ? 0.3 : 0., 0.)});
  return dem::Clump(shape, 1e-4);
}

dem::Simulation dense_cell(const int n_parts, const int n_grains)
{
  dem::UniformSizes sizes;
  sizes.smallest_diameter = 0.9e-3;
  sizes.largest_diameter = 1.1e-3;
  const double edge = std::cbrt(n_grains * 0.5236e-9 * 1.01 / start_fraction); // mean of the cubes of the diameters
  dem::PackingParameters packing;
  packing.solid_fraction = start_fraction;
  dem::PackedGrains packed = dem::pack_clumps(
      {body_of(n_parts), sizes}, dem::PackingSpace::periodic({Vec3::Zero(), Vec3::Constant(edge)}), packing, 1);
  packed.particles.cell = dem::PeriodicCell(Vec3::Constant(edge));
  dem::SimulationParameters p;
  p.grain().young_modulus = p.wall().young_modulus = 1e8;
  p.between_grains().friction = 0.1;
  p.set_damping(0.9);
  p.time_step = 1e-6;
  p.contact.overlap_tolerance = 1e-3;
  dem::Simulation s(p, std::move(packed.particles), {});
  dem::CellControl control{dem::CellControlParameters()};
  const auto step = [&](const double rate)
  {
    const auto axis = dem::AxisControl::of_rate(-rate);
    s.compute_forces();
    control.act(s.particles.cell, {axis, axis, axis}, s.cell_stress(), p.time_step);
    s.integrate();
    return -s.cell_stress().mean();
  };
  while (step(compression_rate) < pressure)
    ;
  for (int n = 0; n < 4000; ++n) // comes to rest
    step(0.);
  for (int n = 0; n < 1000; ++n) // the flow that is measured
    step(measured_rate);
  return s;
}

void measure(const int n_grains, const int n_steps)
{
  omp_set_num_threads(1);
  std::cout << n_grains << " grains in a periodic cell, strained by " << measured_rate << " 1/s, " << n_steps
            << " steps, the least time of " << n_runs << " runs on one thread\n"
            << "parts   contacts a grain   pairs a grain   searches a contact and step   ns a grain   ns a contact\n";
  std::vector<dem::Simulation> cells;
  for (const int n_parts : {1, 2, 3})
    cells.push_back(dense_cell(n_parts, n_grains));
  std::vector<std::vector<StepTiming>> timings(cells.size());
  for (int run = 0; run < n_runs; ++run) // in turn, so that all see the same machine
    for (std::size_t k = 0; k < cells.size(); ++k)
      timings[k].push_back(time_steps(cells[k], n_steps));
  std::vector<double> of_grain, of_contact;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    std::vector<double> seconds;
    for (const StepTiming &t : timings[k])
      seconds.push_back(t.seconds);
    const StepTiming &t = timings[k][0];
    const double step = 1e9 * spread(seconds).least / n_steps, n = static_cast<double>(cells[k].particles.size()),
                 contacts = static_cast<double>(t.n_contacts);
    of_grain.push_back(step / n);
    of_contact.push_back(step / contacts);
    std::cout << std::setw(5) << k + 1 << std::setw(19) << contacts / n << std::setw(16)
              << static_cast<double>(t.n_pairs) / n << std::setw(30)
              << static_cast<double>(t.n_searches) / n_steps / contacts << std::setw(13) << of_grain[k] << std::setw(15)
              << of_contact[k] << '\n';
    for (const Phase &phase : t.phases)
    {
      std::vector<double> all;
      for (std::size_t run = 0; run < timings[k].size(); ++run)
        for (const Phase &other : timings[k][run].phases)
          if (other.name == phase.name)
            all.push_back(other.seconds);
      std::cout << "        " << std::setw(12) << phase.name << std::setw(12) << 1e9 * spread(all).least / n_steps / n
                << " ns a grain\n";
    }
  }
  for (std::size_t k = 1; k < cells.size(); ++k)
    std::cout << "a clump of " << k + 1 << " over a grain: " << of_grain[k] / of_grain[0] << " a body, "
              << of_contact[k] / of_contact[0] << " a contact\n";
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program("clump_cost",
                     [&]
                     {
                       int n_grains = 500, n_steps = 40;
                       CLI::App app("Cost of clumps against plain grains.", "clump_cost");
                       app.add_option("grains", n_grains, "Grains (default: 500)")->check(CLI::PositiveNumber);
                       app.add_option("steps", n_steps, "Steps (default: 40)")->check(CLI::PositiveNumber);
                       if (parse_arguments(app, argc, argv))
                         measure(n_grains, n_steps);
                     });
}
