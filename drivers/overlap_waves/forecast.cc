#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/forecast/step_trial.h"
#include "drivers/overlap_waves/wave_column.h"

namespace bergamo::driver
{

Forecast WaveParameters::forecast() const
{
  WaveColumn column(*this, nullptr);
  const dem::Simulation &grains = *column.model.grains();
  Forecast f;
  f.n_grains = static_cast<double>(grains.particles.size());
  f.n_contacts = 3. * f.n_grains; // of a cubic lattice
  f.bytes_of_memory = f.n_grains * bytes_of_grain;
  f.files = {table("history", output.n_samples, 23), grain_pictures(output.n_pictures + 1., f.n_grains, 6)};
  if (const fe::ExplicitBody *body = column.model.body())
  {
    add_elements(f, *body);
    f.files.push_back(body_pictures(output.n_pictures + 1., *body));
  }
  f.stages = {{"pulse", static_cast<double>(n_steps()), true, simulation.time_step, 0,
               seconds_of(
                   [&]
                   {
                     column.compute();
                     column.move();
                   })}};
  f.stages[0].stable_step = column.stable_step();
  f.add_own_files(output.snapshot_interval, f.n_grains * bytes_of_grain);
  return f;
}

} // namespace bergamo::driver
