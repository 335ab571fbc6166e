#include "dem/measure/beverloo.h"
#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/number_text.h"
#include "drivers/hourglass/parameters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bergamo::driver
{

namespace
{

constexpr dem::BeverlooLaw usual_law{.c = 0.58, .k = 1.4}; // of circular orifices (Nedderman 1992)

/// Until the last share has passed the neck, by Beverloo's law; at most the longest time [s].
double usual_duration(const HourglassParameters &p, const double solid_volume, const double diameter)
{
  const double density = p.simulation.grain().density;
  const double flow = usual_law.flow(2. * p.glass.neck_radius, {p.solid_fraction * density, p.gravity, diameter, 0.});
  return flow > 0 ? std::min(p.longest_time, p.last_discharged * solid_volume * density / flow) : p.patience;
}

} // namespace

Forecast HourglassParameters::forecast() const
{
  const double solid_volume = solid_fraction * chamber_between(glass, fill_bottom, fill_height).volume();
  GrainTrial trial(sizes, solid_volume, seed);
  Forecast f;
  const double seconds = cost_of_flow * trial.seconds_of_step(simulation_parameters());
  add_grains(f, trial);
  const double diameter = std::cbrt(6. / std::numbers::pi * solid_volume / f.n_grains);
  const double duration = usual_duration(*this, solid_volume, diameter);
  const double weight_above = solid_fraction * simulation.grain().density * gravity * (fill_height - fill_bottom);
  f.stages = {{"flow", std::ceil(duration / simulation.time_step), false, simulation.time_step,
               trial.stable_step(weight_above), seconds}};
  const double share = duration / longest_time;
  f.files = {table("history", 1. + share * output.n_samples, 22),
             grain_pictures(2. + std::floor(share * (output.n_pictures - 1.)), f.n_grains, 4)};
  f.add_own_files(output.snapshot_interval, f.n_grains * bytes_of_grain);
  f.unknown.emplace_back("when the glass has run out: Beverloo's usual law says after " + short_text(duration, 2) +
                         " s, the run ends after " + short_text(longest_time) + " s at the latest");
  return f;
}

} // namespace bergamo::driver
