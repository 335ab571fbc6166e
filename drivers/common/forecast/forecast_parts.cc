#include "drivers/common/forecast/forecast_parts.h"

#include "fe_dealii/moving_body.h"

#include <cmath>

namespace bergamo::driver
{

namespace
{

GradingParameters grading_of(const SandParameters &sand)
{
  GradingParameters sizes;
  sizes.kind = SizeKind::gaussian;
  sizes.gaussian = sand.distribution;
  return sizes;
}

} // namespace

void add_grains(Forecast &forecast, const GrainTrial &trial)
{
  forecast.n_grains = trial.n_grains();
  forecast.n_contacts = trial.n_contacts();
  forecast.bytes_of_memory += trial.n_grains() * bytes_of_grain;
}

void add_elements(Forecast &forecast, const fe::MovingBody &body)
{
  constexpr double bytes_of_node = 4000; // elements share their nodes: a plain one takes 3.6 kB, one of 27 nodes 30 kB
  forecast.n_elements = static_cast<double>(body.n_elements());
  forecast.n_nodes = static_cast<double>(body.n_nodes());
  forecast.bytes_of_memory += forecast.n_nodes * bytes_of_node;
}

FileForecast grain_pictures(const double n_pictures, const double n_grains, const int n_per_quarter)
{
  const double bytes_of_surface = n_per_quarter <= 4 ? 9.3e3 : 21.7e3;
  return {"pictures of the grains", n_pictures, n_grains * bytes_of_surface};
}

FileForecast body_pictures(const double n_pictures, const fe::MovingBody &body)
{
  constexpr double bytes_of_node = 75; // compressed; those at rest take less
  return {"pictures of the elements", n_pictures, static_cast<double>(body.n_nodes()) * bytes_of_node};
}

FileForecast contact_pictures(const double n_pictures, const double n_contacts)
{
  constexpr double bytes_of_contact = 180;
  return {"pictures of the contacts", n_pictures, n_contacts * bytes_of_contact};
}

FileForecast table(const std::string &name, const double n_rows, const double n_columns)
{
  return {name, 1, n_rows * bytes_of_row(n_columns)};
}

double usual_rest_time(const double length, const double pressure, const double density)
{
  return 0.7 * length / std::sqrt(pressure / density);
}

SandForecast::SandForecast(const SandParameters &sand, const dem::SimulationParameters &after)
    : sizes(grading_of(sand)), trial(sizes, sand.solid_fraction * sand.box.prod(), sand.seed),
      seconds_per_step(trial.seconds_of_step(after))
{
  const dem::Material &grain = after.grain();
  const double weight_above = 0.5 * sand.solid_fraction * grain.density * sand.settling_gravity * sand.box[2];
  stable_step = trial.stable_step(weight_above);
  settling = {"settling",  static_cast<double>(sand.n_settling_steps()),
              true,        sand.settling_step,
              stable_step, cost_of_flow * seconds_per_step};
}

} // namespace bergamo::driver
