#include "drivers/common/driver_main.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/rubber_block/figures.h"
#include "drivers/rubber_block/sand.h"
#include "drivers/rubber_block/tables.h"

#include <algorithm>

namespace
{

using namespace bergamo;
using namespace bergamo::driver;

constexpr double dissertation_core_hours = 8 * 5.9; // Wellmann, table 4.2

/// One run: sand that settles, and the block on it.
class BlockRun
{
public:
  BlockRun(const RubberBlockParameters &p, const CommandLine &command_line, const std::string &parameter_text)
      : parameters(p),
        run(command_line,
            {"rubber block on sand", parameter_text, p.output.snapshot_interval, {"pressure.csv"}}),
        pictures(run.folder().path())
  {
    run.keep([this](StateVisitor &v) { visit(v); });
  }

  int go();

private:
  void visit(StateVisitor &visit);
  bool settle();
  bool pull_block();
  void sample(History &history, History &pressures);
  double core_seconds() const
  {
    const RunFigures here = run.figures(1);
    return earlier_core_seconds + here.wall_time_s * static_cast<double>(here.threads);
  }
  Summary summary() const;

  const RubberBlockParameters &parameters;
  Run run;
  std::unique_ptr<dem::Simulation> sand; // until it has settled
  std::unique_ptr<Pull> pull;            // then
  SettledSand settled;
  BlockFigures figures;
  BlockSample now; // the last one
  PictureSeries pictures;
  EnergyResidual residual;
  StableStepWatch stable_step{"Pull/time step"};
  double earlier_core_seconds = 0.;
  const Table table = now.table(pull);
  const Table strips = pressure_table(now.time, pull, parameters.block.n_along);
};

void BlockRun::visit(StateVisitor &visit)
{
  double spent = core_seconds();
  visit("core_seconds", spent);
  if (visit.is_reading())
    earlier_core_seconds = spent;
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
}

int BlockRun::go()
{
  run.open();
  return settle() && pull_block() ? run.finish(summary(), {"rubber_block/plot.py"}) : run.stop();
}

bool BlockRun::settle()
{
  if (pull)
    return true;
  if (!sand)
    sand = pack_sand(parameters);
  const std::int64_t n_steps = parameters.n_settling_steps();
  Stage stage = run.even_stage("settling", n_steps, parameters.sand.settling_step);
  stage.n_particles = static_cast<std::int64_t>(sand->particles.size());
  stage.compute = [&] { sand->compute_forces(); };
  stage.move = [&] { sand->integrate(); };
  if (!run.advance(stage, {{every_steps(200), [&] { sand->check_finite(); }}}))
    return false;
  settled = end_settling(*sand, parameters);
  pull = std::make_unique<Pull>(parameters, std::move(sand), settled.height);
  return true;
}

bool BlockRun::pull_block()
{
  const bool begins = run.loop().begins_stage();
  const auto path = run.folder().file("pressure.csv");
  History history = run.history(table);
  History pressures = begins ? History(path, strips.names())
                             : History::continued(path, strips.names(), run.loop().last_time());
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
  const auto draw = [&] { pictures.add(stage.time(), pictures_of(&pull->sand(), &pull->body())); };
  return run.advance(stage, {{evenly(parameters.output.n_samples, n_steps), add_sample},
                             {every_steps(std::max<std::int64_t>(1, n_steps / 50)), look_at_step},
                             {evenly(std::max(1u, parameters.output.n_pictures - 1), n_steps), draw}});
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
  summary.set("core_hours", core_seconds() / 3600., "h");
  summary.set("dissertation_core_hours", dissertation_core_hours, "h");
  return summary;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(argc, argv,
                    {"rubber_block", "Presses a rubber block of elements on sand of superquadrics and pulls it over it."},
                    [](const CommandLine &command_line)
                    { return run_job<RubberBlockParameters, BlockRun>("A rubber block on sand", command_line); });
}
