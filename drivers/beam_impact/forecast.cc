#include "drivers/beam_impact/impact.h"
#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/forecast/step_trial.h"
#include "drivers/common/run/step_count.h"

namespace bergamo::driver
{

Forecast ImpactParameters::forecast() const
{
  Impact impact(*this);
  Forecast f;
  f.n_grains = 1;
  add_elements(f, impact.body());
  const double n_steps =
      static_cast<double>(steps_over({"Output/duration", duration}, {"Output/step share", impact.time_step()}));
  const double stable = impact.stable_step(), step = impact.time_step();
  const double n_pictures = output.n_pictures + 1.; // the first and the last state, too
  constexpr double bytes_of_faces = 700;            // an element, of the triangles that the sphere may touch
  f.files = {table("history", output.n_samples, 15),
             body_pictures(n_pictures, impact.body()),
             grain_pictures(n_pictures, 1, 6),
             {"pictures of the beam's faces", n_pictures, bytes_of_faces * f.n_elements}};
  f.stages = {{"impact", n_steps, true, step, stable,
               seconds_of(
                   [&]
                   {
                     impact.compute();
                     impact.look();
                     impact.move();
                   })}};
  f.add_own_files(output.snapshot_interval, f.bytes_of_memory);
  return f;
}

} // namespace bergamo::driver
