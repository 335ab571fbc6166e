#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/step_advice.h"
#include "drivers/penetration/parameters.h"

namespace bergamo::driver
{

Forecast PenetrationParameters::forecast() const
{
  const SandForecast settled(sand, penetrating());
  Forecast f;
  add_grains(f, settled.trial);
  f.stages = {settled.settling,
              {"penetration", static_cast<double>(n_steps()), true, simulation.time_step, settled.stable_step,
               cost_of_flow * settled.seconds_per_step}};
  f.files = {table("history", output.n_samples, 40), grain_pictures(output.n_pictures, f.n_grains, 4),
             contact_pictures(output.n_pictures, f.n_contacts)};
  f.add_own_files(output.snapshot_interval, f.n_grains * bytes_of_grain);
  if (!sand.grains_file.empty())
    f.unknown.emplace_back("grains of Sand/grains file: those of the distribution are told");
  f.unknown.emplace_back("forces on the intruder, and with them how far below the stable step this one stays");
  return f;
}

std::vector<std::string> PenetrationParameters::advice() const
{
  return advice_on_step({"Penetration/time step", simulation.time_step}, sand.distribution.smallest_half_axis,
                        simulation.grain());
}

} // namespace bergamo::driver
