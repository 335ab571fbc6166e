#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/forecast/step_trial.h"
#include "drivers/common/step_advice.h"
#include "drivers/pile_installation/ground_body.h"
#include "drivers/pile_installation/parameters.h"

namespace bergamo::driver
{

namespace
{

constexpr double settled_fraction = 0.6; // solid, that sand usually comes to
constexpr double cost_of_coupling = 2;   // over that of a grain in the overlap

/// Ground as it will be if the sand settles to what is usual.
std::unique_ptr<fe::ExplicitBody> usual_ground(const InstallationParameters &p, GroundPlan &plan)
{
  InstallationStart start;
  start.sand.level = start.sand.height = p.sand.box[2] * p.sand.solid_fraction / settled_fraction;
  start.sand.solid_fraction = settled_fraction;
  start.bulk_density = settled_fraction * p.simulation.grain().density;
  start.at_rest = Vec3(0.5, 0.5, 1.);
  plan = p.plan(start.sand.level);
  return make_ground(p, start, plan);
}

} // namespace

Forecast InstallationParameters::forecast() const
{
  SandParameters packed = sand; // all of it, or one tile
  const double n_tiles = std::max(1u, tiles);
  packed.box[0] /= n_tiles;
  const SandForecast settled(packed, installing());
  Forecast f;
  add_grains(f, settled.trial);
  for (double *of_all : {&f.n_grains, &f.n_contacts, &f.bytes_of_memory})
    *of_all *= n_tiles;
  StageForecast installation{"installation",      static_cast<double>(n_steps()),    true, simulation.time_step,
                             settled.stable_step, n_tiles * settled.seconds_per_step};
  double share = 1; // of the grains that stay
  if (is_two_scale())
  {
    GroundPlan plan;
    const auto ground = usual_ground(*this, plan);
    add_elements(f, *ground);
    const double of_all = 1. / (sand.box[0] * (plan.top - 0.)), depth = plan.top - plan.outer_bottom;
    const double block = 2. * plan.outer_half_width * depth * of_all,
                 inner = 2. * plan.inner_half_width * (plan.top - plan.inner_bottom) * of_all;
    share = block;
    installation.seconds_per_step *= block + cost_of_coupling * (block - inner);
    installation.seconds_per_step += seconds_of_step(*ground);
    f.files.push_back(body_pictures(output.n_pictures, *ground));
    f.unknown.emplace_back(
        "the level that the sand settles to: elements and block are those of a solid fraction of 0.6");
    f.unknown.emplace_back("grains of the block, " + std::to_string(std::llround(block * f.n_grains)) +
                           " or so of those that settle");
  }
  f.stages = {settled.settling, installation};
  f.files.push_back(table("history", output.n_samples, 38));
  f.files.push_back(grain_pictures(output.n_pictures, share * f.n_grains, 4));
  f.files.push_back(contact_pictures(output.n_pictures, share * f.n_contacts));
  f.add_own_files(output.snapshot_interval, f.n_grains * bytes_of_grain);
  return f;
}

std::vector<std::string> InstallationParameters::advice() const
{
  if (!is_two_scale())
    return advice_on_step({"Pile/time step", simulation.time_step}, sand.distribution.smallest_half_axis,
                          simulation.grain());
  if (continuum.is_sand())
    return {};
  return advice_on_penalty(coupling.penalty, 2. * sand.distribution.mean_half_axes.mean(),
                           continuum.mohr_coulomb.young_modulus);
}

} // namespace bergamo::driver
