#include "drivers/rubber_block/block_run.h"

#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/visit_models.h"

#include <algorithm>
#include <utility>

namespace bergamo::driver
{
namespace
{

constexpr double dissertation_core_hours = 8 * 5.9; // Wellmann, table 4.2

} // namespace

BlockRun::BlockRun(const RubberBlockParameters &p, const CommandLine &command_line, const std::string &parameter_text)
    : parameters(p),
      run(command_line, {"rubber block on sand", parameter_text, p.output.snapshot_interval, {"pressure.csv"}}),
      pictures(run.folder().path()), grain_pictures(run.folder().path())
{
  run.keep([this](StateVisitor &v) { visit(v); });
}

void BlockRun::visit(StateVisitor &visit)
{
  settled.visit(visit); // no height: the sand still settles
  const bool is_settling = settled.height == 0.;
  const dem::Simulation *grains = pull ? &pull->sand() : sand.get();
  auto read = visit_grains(visit, grains, is_settling ? parameters.settling() : parameters.pulling());
  if (is_settling)
  {
    if (read)
      sand = std::move(read);
    return;
  }
  if (read)
    pull = std::make_unique<Pull>(parameters, std::move(read), settled.height);
  pull->visit_block(visit);
  figures.visit(visit);
  residual.visit(visit);
  stable_step.visit(visit);
  pictures.visit(visit);
  grain_pictures.visit(visit, "grain_picture_times");
}

int BlockRun::go()
{
  run.open();
  return settle() && pull_block() ? run.finish(summary(), {"rubber_block/plot.py", "rubber_block/plot_pressure.py"})
                                  : run.stop();
}

bool BlockRun::settle()
{
  if (pull)
    return true;
  if (!sand)
    sand = pack_sand(run.progress(), parameters.sand, parameters.box(), parameters.settling());
  if (!sand || !settle_sand(run, *sand, parameters.sand))
    return false;
  settled = end_settling(*sand, parameters.sand, parameters.pulling());
  pull = std::make_unique<Pull>(parameters, std::move(sand), settled.height);
  return true;
}

bool BlockRun::pull_block()
{
  const bool begins = run.loop().begins_stage();
  const auto path = run.folder().file("pressure.csv");
  History history = run.history(table);
  History pressures =
      begins ? History(path, strips.names()) : History::continued(path, strips.names(), run.loop().last_time());
  const std::int64_t n_steps = parameters.n_steps();
  Stage stage = run.even_stage("pressing and pulling", n_steps, parameters.simulation.time_step);
  stage.n_particles = static_cast<std::int64_t>(pull->sand().particles.size());
  stage.compute = [&] { pull->compute(stage.time()); };
  stage.move = [&] { pull->move(); };
  const auto look_at_step = [&]
  { stable_step.look(parameters.simulation.time_step, pull->stable_step(), run.progress()); };
  const auto add_sample = [&]
  {
    now.time = stage.time();
    sample(history, pressures);
  };
  const auto times = [&](const unsigned n) { return evenly(std::max(1u, n - 1), n_steps); };
  return run.advance(stage, {{evenly(parameters.output.n_samples, n_steps), add_sample},
                             {every_steps(std::max<std::int64_t>(1, n_steps / 20)), look_at_step},
                             {times(parameters.output.n_pictures), [&] { draw(pictures, false); }},
                             {times(parameters.n_grain_pictures), [&] { draw(grain_pictures, true); }}});
}

/// Grains take much room, and the others are wanted more often.
void BlockRun::draw(PictureSeries &series, const bool of_grains)
{
  std::vector<Picture> wanted = pictures_of(&pull->sand(), &pull->body());
  std::erase_if(wanted, [&](const Picture &picture) { return (picture.first == "grains") != of_grains; });
  series.add(run.loop().step() * parameters.simulation.time_step, wanted);
}

void BlockRun::sample(History &history, History &pressures)
{
  now.force = pull->contact_force();
  now.grains = pull->sand().energy();
  now.block = pull->body().energy();
  now.residual = residual.add(pull->energy_balance(), pull->work());
  pull->measure_pressure();
  figures.look(*pull, parameters, now.time);
  history.append(table.row());
  pressures.append(strips.row());
}

Summary BlockRun::summary() const
{
  const dem::Simulation &grains = pull->sand();
  RunFigures own = run.figures(static_cast<std::int64_t>(grains.particles.size()));
  own.steps = grains.n_steps;
  own.time_step_s = parameters.simulation.time_step;
  own.stable_time_step_s = stable_step.smallest();
  own.energy_residual = residual.relative();
  own.undecided_contacts = grains.contacts.n_undecided();
  own.max_overlap_over_radius = figures.largest_overlap();
  Summary summary;
  summary.set("model", std::string("rubber block on sand"));
  summary.set(own);
  summary.set("elements", static_cast<std::int64_t>(pull->body().n_elements()));
  summary.set("nodes", static_cast<std::int64_t>(pull->body().n_nodes()));
  settled.add_to(summary);
  summary.set("relaxation_time_s", parameters.pulling().between_grains().relaxation_time, "s");
  figures.add_to(summary, parameters.pressure);
  const StepShares shares = pull->shares();
  summary.set("share_of_grains", shares.grains);
  summary.set("share_of_elements", shares.elements);
  summary.set("share_of_coupling", shares.coupling);
  summary.set("dissertation_core_hours", dissertation_core_hours, "h");
  return summary;
}

} // namespace bergamo::driver
