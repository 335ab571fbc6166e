#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/forecast/step_trial.h"
#include "drivers/strip_footing/footing_model.h"
#include "fe_dealii/stable_step.h"

#include <cmath>

namespace bergamo::driver
{

Forecast FootingParameters::forecast() const
{
  fe::ExplicitBody ground = make_ground(*this);
  Forecast f;
  add_elements(f, ground);
  const double stable = fe::stable_step(ground).time_step, step = step_share * stable;
  f.files = {table("history", output.n_samples, 13), body_pictures(output.n_pictures, ground)};
  const bool follows = continuum.is_sand() || continuum.mohr_coulomb.reference_pressure > 0;
  f.stages = {{"settlement", std::ceil(loading_time / step), !follows, step, stable, seconds_of_step(ground)}};
  if (follows)
    f.unknown.emplace_back("the steps that follow the stiffness, which grows with the pressure under the footing");
  f.unknown.emplace_back(
      "the static start, some seconds for some thousand elements, and what flowing costs: up to one and "
      "a half times the steps tried, which are elastic");
  f.add_own_files(output.snapshot_interval, f.bytes_of_memory);
  return f;
}

} // namespace bergamo::driver
