#include "drivers/silo_discharge/silo_run.h"

#include "drivers/common/run/step_count.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/silo_discharge/report.h"

#include <algorithm>

namespace bergamo::driver
{
namespace
{

constexpr std::int64_t steps_between_looks = 100; // at whether the grains have settled
constexpr const char *filled_file = "filled.h5";

} // namespace

SiloRun::SiloRun(const SiloParameters &p, const CommandLine &command_line, const std::string &parameter_text)
    : parameters(p), run(command_line, {"silo discharge",
                                        parameter_text,
                                        p.output.snapshot_interval,
                                        {"filling.csv", filled_file, "discharges.csv", "discharges", "mass_flow.csv",
                                         "profiles.csv", "mean_velocity.vtu"}}),
      filled(run.folder().file(filled_file), "filled silo", parameter_text)
{
  run.keep([this](StateVisitor &v) { visit(v); });
}

/// Of the present discharge: a folder of its own where there are several.
std::filesystem::path SiloRun::folder() const
{
  const std::vector<double> &widths = parameters.orifice_widths;
  return widths.size() == 1 ? run.folder().path()
                            : run.folder().path() / "discharges" / SiloParameters::orifice_name(widths[done.size()]);
}

void SiloRun::visit(StateVisitor &visit)
{
  visit("is_filled", is_filled);
  stable_step.visit(visit);
  if (is_filled == 0)
    return visit_filling(visit);
  for (const auto &[name, value] : filling_figures.list())
    visit("filling/" + name, *value);
  visit_done(visit, done);
  if (visit.is_reading())
  {
    present = std::make_unique<Discharge>(parameters, done.size());
    pictures = std::make_unique<PictureSeries>(folder());
  }
  present->visit(visit);
  pictures->visit(visit);
}

/// Of a run that was stopped before its grains were packed there is none.
void SiloRun::visit_filling(StateVisitor &visit)
{
  std::int64_t is_packed = filling != nullptr;
  visit("is_packed", is_packed);
  if (is_packed == 0)
    return;
  if (visit.is_reading())
    filling = std::make_unique<Filling>(parameters);
  filling->visit(visit);
}

int SiloRun::go()
{
  for (const NamedTime &time : {NamedTime{"Filling/longest time", parameters.longest_filling},
                                NamedTime{"Discharge/time", parameters.discharge_time}})
    steps_over(time, {"Output/time step", parameters.simulation.time_step}); // or refused
  run.open();
  if (is_filled == 0 && !fill())
    return run.stop();
  while (done.size() < parameters.orifice_widths.size())
  {
    if (run.loop().begins_stage())
      open_next();
    if (!discharge())
      return run.stop();
    done.push_back(present->figures());
    write_discharges(run.folder().file("discharges.csv"), done);
  }
  RunFigures own = run.figures(static_cast<std::int64_t>(filling_figures.n_grains));
  own.time_step_s = parameters.simulation.time_step;
  Summary summary;
  summary.set("model", std::string("silo"));
  add_discharges(summary, own, filling_figures, done, parameters);
  return run.finish(summary, {"silo_discharge/plot.py"});
}

Stage SiloRun::stage_of(dem::Simulation &grains) const
{
  Stage stage;
  stage.n_particles = static_cast<std::int64_t>(grains.particles.size());
  stage.move = [&grains] { grains.drift(); };
  return stage;
}

bool SiloRun::fill()
{
  if (run.loop().begins_stage())
  {
    filling.reset();
    run.write_snapshot(); // packing takes long, and may be interrupted
    filling = std::make_unique<Filling>(parameters);
    if (!filling->begin())
      return false;
  }
  dem::Simulation &grains = filling->grains();
  const Table table = filling->table();
  History rows = run.history(table, run.folder().file("filling.csv"));
  Stage stage = stage_of(grains);
  stage.name = "filling";
  stage.time = [&] { return filling->time(); };
  stage.is_last = [&] { return filling->is_settled(); };
  stage.fraction = [&] { return filling->fraction(); };
  stage.compute = [&]
  {
    grains.compute_forces();
    grains.kick();
  };
  const auto add_row = [&]
  {
    filling->measure();
    rows.append(table.row());
  };
  if (!run.advance(stage, {{every_steps(steps_between_looks), [&] { filling->look(); }},
                           {either(every_steps(10 * steps_between_looks), at_the_end()), add_row}}))
    return false;
  filling_figures = filling->figures();
  auto settled = filling->take();
  filled.write([&](StateVisitor &v) { visit_grains(v, settled.get(), parameters.filling_simulation()); });
  is_filled = 1;
  return true;
}

void SiloRun::open_next()
{
  std::filesystem::create_directories(folder());
  std::unique_ptr<dem::Simulation> grains;
  filled.read([&](StateVisitor &v) { grains = visit_grains(v, nullptr, parameters.filling_simulation()); });
  present = std::make_unique<Discharge>(parameters, done.size());
  present->open(std::move(grains));
  pictures = std::make_unique<PictureSeries>(folder());
}

bool SiloRun::discharge()
{
  const Table table = present->table();
  History rows = run.history(table, folder() / "history.csv");
  Stage stage = stage_of(present->grains());
  stage.name = "discharge " + SiloParameters::orifice_name(parameters.orifice_widths[done.size()]);
  stage.time = [&] { return present->time(); };
  stage.is_last = [&] { return present->is_over(); };
  stage.fraction = [&] { return present->fraction(); };
  stage.compute = [&] { present->compute(); };
  const auto add_row = [&]
  {
    present->look();
    rows.append(table.row());
  };
  const auto look_at_step = [&]
  {
    present->look_at_step();
    stable_step.look(parameters.simulation.time_step, present->grains().stable_time_step(), run.progress());
  };
  const auto draw = [&]
  {
    pictures->add(present->time(), present->pictures());
    present->write(folder());
  };
  const double end = parameters.discharge_time;
  return run.advance(
      stage, {{every_time(end / parameters.output.n_samples), add_row}, // a discharge ends by what a sample says
              {every_time(end / 10.), look_at_step},
              {either(every_time(end / std::max(1u, parameters.output.n_pictures - 1)), at_the_end()), draw}});
}

} // namespace bergamo::driver
