#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/forecast/step_trial.h"
#include "drivers/common/step_advice.h"
#include "drivers/two_scale_triaxial/continuum_body.h"
#include "drivers/two_scale_triaxial/packing_stage.h"
#include "drivers/two_scale_triaxial/parameters.h"
#include "fe_dealii/stable_step.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{

namespace
{

constexpr double cost_of_coupling = 4; // over that of a grain in the overlap

/// Until the walls, or the cell, have closed and the grains rest.
StageForecast packing(const TriaxialParameters &p, const double seconds_per_step)
{
  const double density = p.simulation.grain().density, pressure = p.compression.pressure,
               widening =
                   std::max(1., std::cbrt(p.expected_solid_fraction /
                                          (p.is_periodic() ? p.tightened_solid_fraction : p.initial_solid_fraction))),
               speed =
                   std::min(0.5 * p.compression.largest_rate * widening * p.edge, 0.5 * std::sqrt(pressure / density)),
               time = 0.5 * (widening - 1.) * p.edge / speed + usual_rest_time(p.edge, pressure, density);
  return {"packing", std::ceil(std::min(time, p.compression.longest_time) / p.packing_time_step),
          false,     p.packing_time_step,
          0,         seconds_per_step};
}

} // namespace

Forecast TriaxialParameters::forecast() const
{
  Forecast f;
  f.files = {table("history", output.n_samples + 2., 29)};
  StageForecast loading{"loading", static_cast<double>(loading_steps()), true, simulation.time_step, 0, 0};
  double share = 1; // of the grains that are loaded
  if (has_continuum())
  {
    const auto body = make_continuum(*this, {.box = {Vec3::Zero(), edges()}});
    add_elements(f, *body);
    loading.stable_step = fe::stable_step(*body).time_step;
    loading.seconds_per_step = seconds_of_step(*body) / cycle();
    f.files.push_back(body_pictures(output.n_pictures, *body));
  }
  if (has_grains())
  {
    GrainTrial trial(grading(), expected_solid_fraction * edges().prod(), seed);
    const double seconds = trial.seconds_of_step(loading_simulation());
    add_grains(f, trial);
    const double stable = trial.stable_step(compression.pressure);
    if (sample.empty())
    {
      f.stages.push_back(packing(*this, cost_of_packing * seconds));
      f.stages.back().stable_step = stable;
      f.files.push_back({"sample", 1, f.n_grains * bytes_of_grain});
      f.unknown.emplace_back("when the packing is at rest: the usual time is told");
    }
    loading.stable_step = loading.stable_step > 0 ? std::min(stable, loading.stable_step) : stable;
    double overlap = 0;
    if (kind == ModelKind::two_scale)
    {
      const unsigned int n_overlaps = is_periodic() ? 2 : 1;
      share = 1. - (layers.continuum - n_overlaps * layers.overlap) / static_cast<double>(layers.high());
      overlap = n_overlaps * layers.overlap / static_cast<double>(layers.high());
      f.unknown.emplace_back("grains that the continuum leaves, " + std::to_string(std::llround(share * f.n_grains)) +
                             " or so");
    }
    loading.seconds_per_step += seconds * (share + cost_of_coupling * overlap);
    f.files.push_back(grain_pictures(output.n_pictures, share * f.n_grains, 6));
  }
  f.stages.push_back(loading);
  f.add_own_files(output.snapshot_interval, share * f.n_grains * bytes_of_grain + f.n_nodes * 1e3);
  return f;
}

std::vector<std::string> TriaxialParameters::advice() const
{
  std::vector<std::string> advice;
  const auto add = [&](const std::vector<std::string> &lines)
  { advice.insert(advice.end(), lines.begin(), lines.end()); };
  const auto add_of_step = [&](const NamedTime &step)
  { add(advice_on_step(step, distribution.smallest_half_axis, simulation.grain())); };
  if (has_grains())
    add_of_step({"Packing/time step", packing_time_step});
  if (kind == ModelKind::grains)
    add_of_step({"Loading/time step", simulation.time_step});
  if (kind == ModelKind::two_scale && !continuum.is_sand())
    add(advice_on_penalty(coupling.penalty, 2. * distribution.mean_half_axes.mean(),
                          continuum.mohr_coulomb.young_modulus));
  return advice;
}

} // namespace bergamo::driver
