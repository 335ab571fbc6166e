#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/forecast/step_trial.h"
#include "drivers/rubber_block/block.h"
#include "drivers/rubber_block/parameters.h"

namespace bergamo::driver
{

Forecast RubberBlockParameters::forecast() const
{
  const SandForecast settled(sand, pulling());
  Forecast f;
  add_grains(f, settled.trial);
  const auto body = make_block(block, Vec3::Zero(), gravity);
  add_elements(f, *body);
  const double stable = settled.trial.stable_step(pressure);
  f.stages = {settled.settling,
              {"load and pull", static_cast<double>(n_steps()), true, simulation.time_step, stable,
               settled.seconds_per_step + seconds_of_step(*body)}};
  f.files = {table("history", output.n_samples, 25), body_pictures(output.n_pictures, *body),
             grain_pictures(n_grain_pictures, f.n_grains, 6)};
  f.add_own_files(output.snapshot_interval, f.n_grains * bytes_of_grain);
  f.unknown.emplace_back("how far grains sink into the block, which decides the stable step");
  return f;
}

} // namespace bergamo::driver
