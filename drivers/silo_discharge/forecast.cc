#include "dem/measure/beverloo.h"
#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/number_text.h"
#include "drivers/silo_discharge/parameters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bergamo::driver
{

namespace
{

constexpr dem::BeverlooLaw usual_law{.c = 1.03, .k = 1.4}; // of slots and spheres (Nedderman 1992)

} // namespace

Forecast SiloParameters::forecast() const
{
  const double solid_volume = expected_solid_fraction * width * depth * fill_height;
  GrainTrial trial(sizes, solid_volume, seed);
  Forecast f;
  const double seconds = cost_of_flow * trial.seconds_of_step(discharge_simulation()), step = simulation.time_step;
  add_grains(f, trial);
  const double density = simulation.grain().density,
               diameter = std::cbrt(6. / std::numbers::pi * solid_volume / f.n_grains);
  const double stable = trial.stable_step(expected_solid_fraction * density * gravity * fill_height);
  // The packing falls by about its own height: what it takes to come to rest goes on while it falls.
  const double filling = std::min(longest_filling, std::sqrt(2. * packing_height() / gravity));
  f.stages = {{"filling", std::ceil(filling / step), false, step, stable, seconds}};
  for (const double orifice : orifice_widths)
  {
    const double flow = usual_law.flow(orifice, {expected_solid_fraction * density, gravity, diameter, depth});
    const double duration =
        flow > 0 ? std::min(discharge_time, last_discharged * solid_volume * density / flow) : patience;
    constexpr double share_left = 0.6; // of the grains, on the average: those that are out cost nothing
    f.stages.push_back(
        {"discharge " + orifice_name(orifice), std::ceil(duration / step), false, step, stable, share_left * seconds});
    f.files.push_back(table("history " + orifice_name(orifice), duration / discharge_time * output.n_samples, 45));
  }
  constexpr double bytes_of_point = 100; // grains are drawn as points
  f.files.push_back({"pictures of the grains", static_cast<double>(orifice_widths.size() * output.n_pictures),
                     f.n_grains * bytes_of_point});
  f.files.push_back({"filled silo", 1, f.n_grains * bytes_of_grain});
  f.add_own_files(output.snapshot_interval, f.n_grains * bytes_of_grain);
  f.unknown.emplace_back(
      "when the silo is at rest, and when it has run out: free fall and Beverloo's usual law are told");
  return f;
}

} // namespace bergamo::driver
