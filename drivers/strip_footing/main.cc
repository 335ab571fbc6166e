#include "drivers/common/driver_main.h"
#include "drivers/common/run/bending_warning.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/rotation_watch.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/step_count.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/strip_footing/bearing_mean.h"
#include "drivers/strip_footing/footing_model.h"

#include <algorithm>
#include <cmath>

namespace
{

using namespace bergamo;
using namespace bergamo::driver;

constexpr double bearing_share = 0.1; // of the loading time, its end, over which the limit pressure is read

/// One run of the footing: static start, settlement, files.
class FootingRun
{
public:
  FootingRun(const FootingParameters &p, const CommandLine &command_line, const std::string &parameter_text)
      : parameters(p), run(command_line, {"strip footing", parameter_text, p.output.snapshot_interval}), model(p),
        pictures(run.folder().path())
  {
    run.keep([this](StateVisitor &v) { visit(v); });
  }

  int go();

private:
  double time() const { return model.time(); }
  void visit(StateVisitor &visit);
  void sample(History &history);
  Summary summary() const;

  const FootingParameters &parameters;
  Run run;
  FootingModel model;
  PictureSeries pictures;
  fe::BodyEnergy energy; // of the last sample
  EnergyResidual residual;
  RotationWatch rotation;
  BearingMean bearing; // over the last part of the settlement
  const Table table{{{"time_s", [&] { return time(); }},
                     {"settlement_m", [&] { return parameters.settlement_at(time()); }},
                     {"footing_pressure_Pa", [&] { return model.footing_pressure(); }},
                     {"energy_kinetic_J", [&] { return energy.kinetic; }},
                     {"energy_elastic_J", [&] { return energy.elastic; }},
                     {"energy_plastic_loss_J", [&] { return energy.plastic_dissipation; }},
                     {"energy_viscous_loss_J", [&] { return energy.viscous_dissipation; }},
                     {"energy_stiffness_loss_J", [&] { return energy.stiffness_loss; }},
                     {"energy_radiated_J", [&] { return energy.radiated; }},
                     {"energy_footing_work_J", [&] { return energy.boundary_work; }},
                     {"energy_gravity_work_J", [&] { return energy.gravity_work; }},
                     {"energy_surcharge_work_J", [&] { return energy.external_work; }},
                     {"energy_residual_J", [&] { return residual.present(); }}}};
};

void FootingRun::visit(StateVisitor &visit)
{
  residual.visit(visit);
  rotation.visit(visit);
  bearing.visit(visit);
  pictures.visit(visit);
  visit_body(visit, model.body());
  visit_steps(visit, model.steps());
}

int FootingRun::go()
{
  const double first_step = parameters.step_share * model.steps().stable().time_step;
  steps_over({"Footing/loading time", parameters.loading_time}, {"Output/step share", first_step}); // or refused
  run.open();
  warn_of_thin_layers(model.body(), "set Ground/bending elements = true", run.progress());
  History history = run.history(table);
  const double end = parameters.loading_time;
  Stage stage;
  stage.name = "settlement";
  stage.time = [&] { return time(); };
  stage.is_last = [&] { return time() >= end; };
  stage.fraction = [&] { return time() / end; };
  stage.compute = [&]
  {
    model.compute_forces();
    model.kick();
  };
  stage.move = [&] { model.drift(); };
  const auto at_the_limit = [&](const Moment &now) { return now.time >= (1 - bearing_share) * end; };
  const auto see = [&] { bearing.see(model.footing_pressure(), parameters.settlement_at(time())); };
  const auto add_bearing = [&] { bearing.add(model.footing_pressure(), model.time_step()); };
  const auto times = [&](const auto n) { return either(every_time(end / std::max<double>(1, n)), at_the_end()); };
  const auto add_picture = [&] { pictures.add(time(), pictures_of(nullptr, &model.body())); };
  const bool is_done = run.advance(stage, {{times(parameters.output.n_samples), [&] { sample(history); }},
                                           {every_steps(1), see},
                                           {at_the_limit, add_bearing},
                                           {times(parameters.output.n_pictures - 1), add_picture}});
  return is_done ? run.finish(summary(), {"strip_footing/plot.py", "energy.py"}) : run.stop();
}

void FootingRun::sample(History &history)
{
  energy = model.body().energy();
  fe::require_bounded(energy, "the ground at time " + std::to_string(time()) + " s", "a smaller Output/step share");
  residual.add(energy.residual(), energy.boundary_work);
  history.append(table.row());
  rotation.look(model.body(), run.progress());
}

Summary FootingRun::summary() const
{
  RunFigures figures = run.figures(0);
  figures.steps = run.loop().step();
  figures.time_step_s = model.steps().smallest_step();
  figures.stable_time_step_s = model.steps().smallest_stable();
  figures.energy_residual = residual.relative();
  const double updates = static_cast<double>(model.body().n_elements()) * run.loop().steps_here();
  Summary summary;
  summary.set("model", std::string("continuum"));
  summary.set(figures);
  summary.set("elements", static_cast<std::int64_t>(model.body().n_elements()));
  summary.set("element_updates_per_second", updates / figures.wall_time_s, "1/s");
  summary.set("start_out_of_balance", model.start().residual.back());
  bearing.add_figures(summary);
  if (parameters.layer_depths.empty()) // the closed form is of one layer
    parameters.limit_pressure().add_figures(summary, bearing.mean());
  if (!parameters.continuum.is_sand()) // which stores no energy
    summary.set("kinetic_over_elastic_energy", energy.kinetic / energy.elastic);
  summary.set("kinetic_energy_over_footing_work", energy.kinetic / energy.boundary_work);
  summary.set("greatest_rotation_degrees", rotation.greatest(), "degrees");
  summary.set("stiffness_loss_over_footing_work", energy.stiffness_loss / energy.boundary_work);
  return summary;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(
      argc, argv,
      {"strip_footing",
       "Presses a strip footing into the ground in plane strain, from rest to the limit load: closed form beside it."},
      [](const CommandLine &command_line)
      { return run_job<FootingParameters, FootingRun>("Strip footing on elastoplastic ground", command_line); });
}
