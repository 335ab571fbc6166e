#include "dem/measure/contact_list.h"
#include "drivers/common/driver_main.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/measured_columns.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/overlap_waves/report.h"
#include "drivers/overlap_waves/wave_column.h"

#include <algorithm>

namespace
{

using namespace bergamo;
using namespace bergamo::driver;

/// One run: a pulse that goes through a column.
class WaveRun
{
public:
  WaveRun(const WaveParameters &p, const CommandLine &command_line, const std::string &parameter_text)
      : parameters(p), run(command_line, {"waves through an overlap", parameter_text, p.output.snapshot_interval}),
        pictures(run.folder().path())
  {
    if (!run.keep([this](StateVisitor &v) { visit(v); }))
      column = std::make_unique<WaveColumn>(p, nullptr);
    table.add(columns_of(energy));
  }

  int go();

private:
  void visit(StateVisitor &visit);
  void sample(History &history);
  Summary summary() const;

  const WaveParameters &parameters;
  Run run;
  std::unique_ptr<WaveColumn> column;
  PulseReport report;
  PictureSeries pictures;
  StableStepWatch stable_step{"Output/time step"};
  EnergyResidual residual;
  double largest_overlap = 0.;  // over the radius
  coupling::ModelEnergy energy; // of the last sample
  std::array<double, 3> kinetic{};
  Table table{{{"time_s", [&] { return column->time(); }},
               {"kinetic_continuum_part_J", [&] { return kinetic[continuum_part]; }},
               {"kinetic_overlap_J", [&] { return kinetic[overlap_part]; }},
               {"kinetic_grain_part_J", [&] { return kinetic[grain_part]; }},
               {"coupling_difference_m", [&] { return column->model.penalty_state().largest_difference; }},
               {"pulse_work_J", [&] { return column->pulse_work(); }},
               {"energy_residual_J", [&] { return residual.present(); }}}};
};

void WaveRun::visit(StateVisitor &visit)
{
  auto grains = visit_grains(visit, column ? column->model.grains() : nullptr, parameters.simulation);
  if (visit.is_reading())
    column = std::make_unique<WaveColumn>(parameters, std::move(grains));
  column->visit(visit);
  report.visit(visit);
  pictures.visit(visit);
  stable_step.visit(visit);
  residual.visit(visit);
  visit("largest_overlap", largest_overlap);
}

int WaveRun::go()
{
  run.open();
  History history = run.history(table);
  const std::int64_t n_steps = parameters.n_steps();
  Stage stage = run.even_stage("pulse", n_steps, parameters.simulation.time_step);
  stage.n_particles = static_cast<std::int64_t>(column->model.grains()->particles.size());
  stage.time = [&] { return column->time(); }; // that of the rows
  stage.compute = [&] { column->compute(); };
  stage.move = [&] { column->move(); };
  const auto look = [&]
  {
    report.look(*column);
    pictures.add(column->time(), pictures_of(column->model.grains(), column->model.body()));
  };
  const auto take_sent = [&] { report.take_sent(*column); };
  const auto take_arrived = [&] { report.take_arrived(*column); };
  const auto look_at_step = [&]
  { stable_step.look(parameters.simulation.time_step, column->stable_step(), run.progress()); };
  const bool is_done = run.advance(stage, {{evenly(parameters.output.n_samples, n_steps), [&] { sample(history); }},
                                           {every_steps(std::max<std::int64_t>(1, n_steps / 4)), look_at_step},
                                           {at_times({parameters.pulse().duration}), take_sent},
                                           {at_the_end(), take_arrived},
                                           {evenly(parameters.output.n_pictures, n_steps), look}});
  if (!is_done)
    return run.stop();
  write_waves(run.folder().file("waves.csv"), report, *column);
  return run.finish(summary(), {"overlap_waves/plot.py", "energy.py"});
}

void WaveRun::sample(History &history)
{
  const dem::Simulation &grains = *column->model.grains();
  grains.check_finite();
  kinetic = column->kinetic_energy();
  energy = coupling::energy_of(column->model);
  residual.add(column->balance(), column->pulse_work());
  largest_overlap = std::max(largest_overlap, dem::largest_relative_overlap(grains.contacts, grains.particles));
  dem::check_overlap(largest_overlap, column->time(), "a smaller Output/time step");
  history.append(table.row());
}

Summary WaveRun::summary() const
{
  const dem::Simulation &grains = *column->model.grains();
  RunFigures figures = run.figures(static_cast<std::int64_t>(grains.particles.size()));
  figures.steps = run.loop().step();
  figures.time_step_s = parameters.simulation.time_step;
  figures.stable_time_step_s = stable_step.smallest();
  figures.energy_residual = residual.relative();
  figures.undecided_contacts = grains.contacts.n_undecided();
  figures.max_overlap_over_radius = largest_overlap;
  Summary summary;
  summary.set("model", std::string(parameters.model_name()));
  summary.set(figures);
  report.add_figures(summary, parameters);
  return summary;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(
      argc, argv,
      {"overlap_waves",
       "Sends a pulse through a column of grains and continuum that share an overlap: how much of it comes back?"},
      [](const CommandLine &command_line)
      { return run_job<WaveParameters, WaveRun>("Waves through an overlap", command_line); });
}
