#include "dem/measure/inertial_number.h"
#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/forecast/step_trial.h"
#include "drivers/common/step_advice.h"
#include "drivers/membrane_triaxial/membrane.h"
#include "drivers/membrane_triaxial/parameters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bergamo::driver
{

namespace
{

constexpr double cost_of_membrane = 2; // of its contacts and what they are asked for, in samples of some hundred beads
constexpr double settled_fraction = 0.56; // solid, that beads usually come to in the mould

/// Until the mould has closed and the grains rest.
double usual_shrinking_time(const MouldParameters &p, const double density)
{
  const double speed = std::min(0.5 * p.diameter * p.largest_rate, 0.5 * std::sqrt(p.pressure / density)),
               way = 0.5 * p.diameter * (1. - std::cbrt(std::min(1., p.solid_fraction / settled_fraction)));
  return way / speed + usual_rest_time(std::max(p.height, p.diameter), p.pressure, density);
}

} // namespace

Forecast MembraneTriaxialParameters::forecast() const
{
  const double volume = std::numbers::pi / 4. * mould.diameter * mould.diameter * mould.height,
               density = simulation.grain().density;
  GrainTrial trial(sizes, mould.solid_fraction * volume, mould.seed);
  Forecast f;
  const double seconds = cost_of_membrane * trial.seconds_of_step(testing());
  add_grains(f, trial);
  const auto body = make_membrane(membrane, {0.5 * mould.diameter, mould.height});
  add_elements(f, *body);
  f.elements = "quadrilaterals of the membrane";
  const double of_both = seconds + seconds_of_step(*body), step = simulation.time_step,
               stable = trial.stable_step(pressure), v = mould.solid_fraction * volume / f.n_grains;
  const dem::MeanGrain grain{v * density, std::cbrt(6. / std::numbers::pi * v)};
  if (sample.empty())
    f.stages.push_back({"shrinking the mould",
                        std::ceil(std::min(usual_shrinking_time(mould, density), mould.longest_time) / mould.time_step),
                        false, mould.time_step, trial.stable_step(mould.pressure), cost_of_packing * seconds});
  f.stages.push_back({"loading", std::ceil(1.1 * loading_time / step), false, step, stable, of_both});
  f.stages.push_back({"compression", static_cast<double>(n_steps(grain)), false, step, stable, of_both});
  f.files = {table("history, loading and mould", output.n_samples + 110., 34),
             grain_pictures(output.n_pictures, f.n_grains, 6),
             {"sample", 1, f.n_grains * bytes_of_grain}};
  f.add_own_files(output.snapshot_interval, f.n_grains * bytes_of_grain);
  f.unknown.emplace_back("when the sample is at rest in the mould and under the pressure: usual times are told");
  return f;
}

std::vector<std::string> MembraneTriaxialParameters::advice() const
{
  return advice_on_step({"Mould/time step", mould.time_step}, smallest_radius(), simulation.grain());
}

} // namespace bergamo::driver
