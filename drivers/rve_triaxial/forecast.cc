#include "dem/measure/inertial_number.h"
#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/rve_triaxial/parameters.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace bergamo::driver
{

namespace
{

constexpr double compressed_fraction = 0.64; // solid, that grains usually come to
constexpr double steps_to_look_at_rest = 250;

/// What samples of one edge have in common.
struct Cell
{
  std::unique_ptr<GrainTrial> trial;
  double seconds_per_step = 0;
  dem::MeanGrain grain;
};

/// Samples run on a thread each; gives the threads back.
struct OneThread
{
  OneThread() { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(before); }
  OneThread(const OneThread &) = delete;
  OneThread &operator=(const OneThread &) = delete;

  int before = omp_get_max_threads();
};

Cell cell_of(const RveParameters &p, const SampleSettings &sample)
{
  const double solid_volume = p.packing_solid_fraction * std::pow(sample.edge, 3),
               density = p.simulation.grain().density;
  Cell cell{std::make_unique<GrainTrial>(p.sizes, solid_volume, sample.seed), 0, {}};
  const OneThread alone;
  dem::SimulationParameters generation = p.simulation;
  generation.contact.overlap_tolerance = p.generation.overlap_tolerance;
  cell.seconds_per_step = cell.trial->seconds_of_step(generation);
  const double volume = solid_volume / cell.trial->n_grains();
  cell.grain = {volume * density, std::cbrt(6. / std::numbers::pi * volume)};
  return cell;
}

/// How long a stage lasts [s]. @param is_first from the loose packing
double duration(const RveParameters &p, const dem::LoadingStage &stage, const Cell &cell, const SampleSettings &sample,
                const bool is_first)
{
  const double rate = dem::strain_rate_of(cell.grain, stage.inertial_number, stage.pressure);
  if (stage.is_strained())
    return dem::strain_path(stage) / rate;
  if (!is_first)
    return 0;
  const double closing = std::log(std::max(1., compressed_fraction / p.packing_solid_fraction)) / 3.;
  return closing / rate + usual_rest_time(sample.edge, stage.pressure, p.simulation.grain().density);
}

StageForecast forecast_of(const RveParameters &p, const dem::LoadingStage &stage, const Cell &cell,
                          const SampleSettings &sample, const bool is_first)
{
  constexpr double margin = 0.8; // of CellLoading
  StageForecast result;
  result.stable_step = cell.trial->stable_step(stage.pressure);
  result.time_step = std::min(stage.time_step, margin * result.stable_step);
  result.n_steps = std::ceil(duration(p, stage, cell, sample, is_first) / result.time_step);
  if (!stage.is_strained())
    result.n_steps += steps_to_look_at_rest;
  result.is_exact = false;
  result.seconds_per_step = cost_of_packing * cell.seconds_per_step;
  return result;
}

/// Puts a sample's stage to those of the others.
void add_to(StageForecast &sum, const StageForecast &one)
{
  const double steps = sum.n_steps + one.n_steps;
  sum.seconds_per_step = (sum.n_steps * sum.seconds_per_step + one.n_steps * one.seconds_per_step) / steps;
  sum.time_step = sum.n_steps > 0 ? std::min(sum.time_step, one.time_step) : one.time_step;
  sum.stable_step = sum.n_steps > 0 ? std::min(sum.stable_step, one.stable_step) : one.stable_step;
  sum.n_steps = steps;
  sum.is_exact = false;
}

} // namespace

Forecast RveParameters::forecast() const
{
  Forecast f;
  std::map<double, Cell> cells;
  const std::vector<SampleSettings> all = samples();
  double rows = 0, n_pictured = 0;
  for (const SampleSettings &sample : all)
  {
    if (!cells.contains(sample.edge))
      cells.emplace(sample.edge, cell_of(*this, sample));
    const Cell &cell = cells.at(sample.edge);
    f.n_grains += cell.trial->n_grains();
    f.n_contacts += cell.trial->n_contacts();
    const std::vector<dem::LoadingStage> stages = program(sample);
    f.stages.resize(stages.size());
    for (std::size_t k = 0; k < stages.size(); ++k)
    {
      const StageForecast stage = forecast_of(*this, stages[k], cell, sample, k == 0);
      f.stages[k].name = k == 0 ? "compression of the packings" : "stage " + std::to_string(k);
      add_to(f.stages[k], stage);
      constexpr double early_rows = 100; // closer to one another where the strain begins
      rows += stages[k].is_strained() ? n_rows + early_rows : 2. + stage.n_steps / static_cast<double>(row_interval);
      n_pictured += pictures ? cell.trial->n_grains() : 0;
    }
  }
  f.n_runs = static_cast<double>(all.size());
  f.n_side_by_side = std::min<double>(f.n_runs, omp_get_max_threads());
  f.grains_are_exact = cells.size() == all.size();
  f.bytes_of_memory = f.n_grains / f.n_runs * f.n_side_by_side * bytes_of_grain;
  f.files = {table("histories", rows, 35), {"distributions", f.n_runs, 11e3}};
  if (pictures)
    f.files.push_back(grain_pictures(1, n_pictured, 6));
  f.add_own_files(snapshot_interval, f.n_grains / f.n_runs * bytes_of_grain);
  f.unknown.emplace_back(
      "when a packing is at rest under its pressure, which takes most of the steps: the usual time is "
      "told, within a third");
  return f;
}

} // namespace bergamo::driver
