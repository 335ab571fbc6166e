#include "drivers/common/driver_main.h"
#include "drivers/common/processor_name.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/penetration/measures.h"
#include "drivers/penetration/pictures.h"

#include <algorithm>

namespace
{

using namespace bergamo;
using namespace bergamo::driver;

/// One run: sand that settles, and a rigid body that is pressed into it.
class PenetrationRun
{
public:
  PenetrationRun(const PenetrationParameters &p, const CommandLine &command_line, const std::string &parameter_text)
      : parameters(p), run(command_line, {"penetration", parameter_text, p.output.snapshot_interval}),
        measures(p, settled), pictures(run.folder().path())
  {
    run.keep([this](StateVisitor &v) { visit(v); });
  }

  int go();

private:
  void visit(StateVisitor &visit);
  bool settle();
  bool penetrate();
  Summary summary() const;

  const PenetrationParameters &parameters;
  Run run;
  std::unique_ptr<dem::Simulation> sand; // until it has settled
  SettledSand settled;
  std::unique_ptr<Intrusion> intrusion; // then
  PenetrationMeasures measures;
  PictureSeries pictures;
  StableStepWatch stable_step{"Penetration/time step"};
};

void PenetrationRun::visit(StateVisitor &visit)
{
  settled.visit(visit); // no height: the sand still settles
  const bool is_settling = settled.height == 0.;
  auto read = visit_grains(visit, intrusion ? &intrusion->sand() : sand.get(),
                           is_settling ? parameters.settling() : parameters.penetrating());
  if (is_settling)
  {
    if (read)
      sand = std::move(read);
    return;
  }
  if (read)
    intrusion = std::make_unique<Intrusion>(parameters, std::move(read), settled.height);
  intrusion->visit(visit);
  measures.visit(visit);
  stable_step.visit(visit);
  pictures.visit(visit);
}

int PenetrationRun::go()
{
  run.open();
  return settle() && penetrate() ? run.finish(summary(), {"penetration/plot.py", "energy.py"}) : run.stop();
}

bool PenetrationRun::settle()
{
  if (intrusion)
    return true;
  if (!sand)
    sand = pack_sand(run.progress(), parameters.sand, parameters.box(), parameters.settling());
  if (!sand || !settle_sand(run, *sand, parameters.sand))
    return false;
  settled = end_settling(*sand, parameters.sand, parameters.penetrating());
  intrusion = std::make_unique<Intrusion>(parameters, std::move(sand), settled.height);
  return true;
}

bool PenetrationRun::penetrate()
{
  const Table table = measures.table();
  History history = run.history(table);
  const std::int64_t n_steps = parameters.n_steps();
  Stage stage = run.even_stage("penetration", n_steps, parameters.simulation.time_step);
  stage.n_particles = static_cast<std::int64_t>(intrusion->sand().particles.size());
  stage.compute = [&] { intrusion->compute(stage.time()); };
  stage.move = [&] { intrusion->move(); };
  const auto add_row = [&]
  {
    measures.look(*intrusion, stage.time());
    history.append(table.row());
  };
  const auto look_at_step = [&]
  { stable_step.look(parameters.simulation.time_step, intrusion->stable_step(), run.progress()); };
  const auto draw = [&] { pictures.add(stage.time(), pictures_of(*intrusion)); };
  return run.advance(stage, {{evenly(parameters.output.n_samples, n_steps), add_row},
                             {every_steps(1), [&] { measures.look_at_step(*intrusion); }},
                             {every_steps(std::max<std::int64_t>(1, n_steps / 20)), look_at_step},
                             {evenly(std::max(1u, parameters.output.n_pictures - 1), n_steps), draw}});
}

Summary PenetrationRun::summary() const
{
  const dem::Simulation &grains = intrusion->sand();
  RunFigures own = run.figures(static_cast<std::int64_t>(grains.particles.size()));
  own.steps = grains.n_steps;
  own.time_step_s = parameters.simulation.time_step;
  own.stable_time_step_s = stable_step.smallest();
  own.energy_residual = measures.energy_residual();
  own.undecided_contacts = grains.contacts.n_undecided();
  own.max_overlap_over_radius = measures.largest_overlap();
  Summary summary;
  summary.set("model", std::string("penetration"));
  summary.set(own);
  summary.set("processor", processor_name());
  measures.add_to(summary);
  return summary;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(
      argc, argv,
      {"penetration",
       "Presses a rigid plate, cone or pile into sand of grains: resistance of tip and shaft over depth."},
      [](const CommandLine &command_line)
      { return run_job<PenetrationParameters, PenetrationRun>("Penetration of sand", command_line); });
}
