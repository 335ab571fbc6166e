#include "drivers/common/driver_main.h"
#include "drivers/common/processor_name.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/pile_installation/ground_body.h"
#include "drivers/pile_installation/measures.h"
#include "drivers/pile_installation/pictures.h"

#include <algorithm>

namespace
{

using namespace bergamo;
using namespace bergamo::driver;

/// One run: sand that settles, of which a block stays, and a pile that is pressed into it.
class InstallationRun
{
public:
  InstallationRun(const InstallationParameters &p, const CommandLine &command_line, const std::string &parameter_text)
      : parameters(p), run(command_line, {"pile installation", parameter_text, p.output.snapshot_interval}),
        measures(p), pictures(run.folder().path())
  {
    if (!run.keep([this](StateVisitor &v) { visit(v); }))
      require_stable_ground(p);
  }

  int go();

private:
  void visit(StateVisitor &visit);
  bool settle();
  bool install();
  Summary summary() const;

  const InstallationParameters &parameters;
  Run run;
  std::unique_ptr<dem::Simulation> sand; // until it has settled
  InstallationStart start;
  std::unique_ptr<Installation> installation; // then
  InstallationMeasures measures;
  PictureSeries pictures;
  StableStepWatch stable_step{"Pile/time step"};
};

void InstallationRun::visit(StateVisitor &visit)
{
  if (installation && installation->reference_by_id() && !visit.is_reading())
    start.reference_by_id = *installation->reference_by_id();
  start.visit(visit);
  auto read = visit_grains(visit, installation ? &installation->sand() : sand.get(),
                           start.is_known() ? parameters.installing() : parameters.settling());
  if (!start.is_known())
  {
    if (read)
      sand = std::move(read);
    return;
  }
  if (read)
    installation = std::make_unique<Installation>(parameters, std::move(read), start);
  installation->visit(visit);
  measures.visit(visit);
  stable_step.visit(visit);
  pictures.visit(visit);
}

int InstallationRun::go()
{
  run.open();
  return settle() && install() ? run.finish(summary(), {"pile_installation/plot.py", "energy.py", "picture.py"})
                               : run.stop();
}

bool InstallationRun::settle()
{
  if (installation)
    return true;
  if (!sand)
    sand = pack_ground(run.progress(), parameters);
  if (!sand || !settle_sand(run, *sand, parameters.sand))
    return false;
  start = prepare_ground(sand, parameters);
  installation = std::make_unique<Installation>(parameters, std::move(sand), start);
  installation->settle(run.progress());
  return true;
}

bool InstallationRun::install()
{
  const Table table = measures.table();
  History history = run.history(table);
  const std::int64_t n_steps = parameters.n_steps();
  Stage stage = run.even_stage("installation", n_steps, parameters.simulation.time_step);
  stage.n_particles = static_cast<std::int64_t>(installation->sand().particles.size());
  stage.compute = [&] { installation->compute(stage.time()); };
  stage.move = [&] { installation->move(); };
  const auto add_row = [&]
  {
    measures.look(*installation, stage.time());
    history.append(table.row());
    installation->look_at_rotation(run.progress());
  };
  const auto look_at_step = [&]
  { stable_step.look(parameters.simulation.time_step, installation->stable_step(), run.progress()); };
  const auto draw = [&] { pictures.add(stage.time(), pictures_of(*installation, parameters)); };
  return run.advance(stage, {{evenly(parameters.output.n_samples, n_steps), add_row},
                             {every_steps(std::max<std::int64_t>(1, n_steps / 20)), look_at_step},
                             {evenly(std::max(1u, parameters.output.n_pictures - 1), n_steps), draw}});
}

Summary InstallationRun::summary() const
{
  const dem::Simulation &grains = installation->sand();
  RunFigures own = run.figures(static_cast<std::int64_t>(grains.particles.size()));
  own.steps = grains.n_steps;
  own.time_step_s = parameters.simulation.time_step;
  own.stable_time_step_s = stable_step.smallest();
  own.energy_residual = measures.energy_residual();
  own.undecided_contacts = grains.contacts.n_undecided();
  own.max_overlap_over_radius = measures.largest_overlap();
  Summary summary;
  summary.set("model", std::string(parameters.model_name()));
  summary.set(own);
  summary.set("processor", processor_name());
  if (const fe::ExplicitBody *body = installation->body())
  {
    summary.set("elements", body->n_elements());
    summary.set("overlap_renewals", installation->n_renewals());
    summary.set("block_growths", start.n_growths);
    summary.set("greatest_rotation_degrees", installation->greatest_rotation(), "degrees");
  }
  start.add_to(summary);
  measures.add_to(summary);
  return summary;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(
      argc, argv,
      {"pile_installation",
       "Presses a pile into sand: grains about the pile, a continuum beyond, joined in an overlap (Arlequin method)."},
      [](const CommandLine &command_line)
      { return run_job<InstallationParameters, InstallationRun>("Pile installation", command_line); });
}
