#include "dem/measure/contact_list.h"
#include "drivers/beam_impact/beam_theory.h"
#include "drivers/beam_impact/impact.h"
#include "drivers/beam_impact/report.h"
#include "drivers/common/driver_main.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/common/run/step_count.h"

#include <algorithm>

namespace
{

using namespace bergamo;
using namespace bergamo::driver;

/// One run: impact beside both closed forms.
class ImpactRun
{
public:
  ImpactRun(const ImpactParameters &p, const CommandLine &command_line, const std::string &parameter_text)
      : parameters(p), run(command_line, {"beam impact", parameter_text, p.output.snapshot_interval}), impact(p),
        n_steps(steps_over({"Output/duration", p.duration}, {"Output/step share", impact.time_step()})),
        slender(solve_impact(p, BeamTheory::slender, impact.time_step(), n_steps)),
        thick(solve_impact(p, BeamTheory::thick, impact.time_step(), n_steps)), pictures(run.folder().path())
  {
    run.keep([this](StateVisitor &v) { visit(v); });
  }

  int go();

private:
  void visit(StateVisitor &visit);
  void sample(History &history);
  Summary summary() const;
  double now(const std::vector<double> &values) const { return values[impact.n_steps()]; }

  const ImpactParameters &parameters;
  Run run;
  Impact impact;
  std::int64_t n_steps;
  Trajectory slender, thick;
  PictureSeries pictures;
  coupling::MoverEnergy of_sphere, of_beam; // of the last sample
  EnergyResidual residual;
  double largest_overlap = 0.; // over the radius, of all samples
  StableStepWatch stable_step{"Output/step share"};
  const Table table{{{"time_s", [&] { return impact.time(); }},
                     {"sphere_displacement_m", [&] { return now(impact.way().sphere); }},
                     {"beam_displacement_m", [&] { return now(impact.way().beam); }},
                     {"contact_force_N", [&] { return now(impact.way().force); }},
                     {"slender_sphere_displacement_m", [&] { return now(slender.sphere); }},
                     {"slender_beam_displacement_m", [&] { return now(slender.beam); }},
                     {"slender_contact_force_N", [&] { return now(slender.force); }},
                     {"thick_sphere_displacement_m", [&] { return now(thick.sphere); }},
                     {"thick_beam_displacement_m", [&] { return now(thick.beam); }},
                     {"thick_contact_force_N", [&] { return now(thick.force); }},
                     {"energy_sphere_kinetic_J", [&] { return of_sphere.kinetic; }},
                     {"energy_contact_J", [&] { return of_sphere.stored; }},
                     {"energy_beam_kinetic_J", [&] { return of_beam.kinetic; }},
                     {"energy_beam_elastic_J", [&] { return of_beam.stored; }},
                     {"energy_residual_J", [&] { return residual.present(); }}}};
};

void ImpactRun::visit(StateVisitor &visit)
{
  impact.visit(visit);
  residual.visit(visit);
  stable_step.visit(visit);
  visit("largest_overlap", largest_overlap);
  pictures.visit(visit);
}

int ImpactRun::go()
{
  run.open();
  History history = run.history(table);
  Stage stage = run.even_stage("impact", n_steps, impact.time_step());
  stage.n_particles = 1;
  stage.time = [&] { return impact.time(); }; // that of the rows
  stage.compute = [&] { impact.compute(); };
  stage.move = [&] { impact.move(); };
  const auto add_picture = [&] { pictures.add(impact.time(), pictures_of(&impact.simulation(), &impact.body())); };
  const bool is_done = run.advance(stage, {{every_steps(1), [&] { impact.look(); }},
                                           {evenly(parameters.output.n_samples, n_steps), [&] { sample(history); }},
                                           {evenly(parameters.output.n_pictures, n_steps), add_picture}});
  return is_done ? run.finish(summary(), {"beam_impact/plot.py"}) : run.stop();
}

void ImpactRun::sample(History &history)
{
  of_sphere = impact.energy_of_sphere();
  of_beam = impact.energy_of_beam();
  largest_overlap = std::max(
      largest_overlap, dem::largest_relative_overlap(impact.simulation().contacts, impact.simulation().particles));
  residual.add(of_sphere.balance() + of_beam.balance(),
               0.5 * parameters.sphere_mass() * parameters.velocity * parameters.velocity);
  stable_step.look(impact.time_step(), impact.stable_step(), run.progress());
  history.append(table.row());
}

Summary ImpactRun::summary() const
{
  RunFigures figures = run.figures(1);
  figures.steps = n_steps;
  figures.time_step_s = impact.time_step();
  figures.stable_time_step_s = stable_step.smallest();
  figures.energy_residual = residual.relative();
  figures.undecided_contacts = impact.simulation().contacts.n_undecided();
  figures.max_overlap_over_radius = largest_overlap;
  Summary summary;
  summary.set("model", std::string("sphere on a beam"));
  summary.set(figures);
  summary.set("elements", static_cast<std::int64_t>(impact.body().n_elements()));
  add_impacts(summary, "", impact.way(), impact.time_step());
  add_impacts(summary, "slender_", slender, impact.time_step());
  add_impacts(summary, "thick_", thick, impact.time_step());
  add_deviations(summary, "slender_", impact.way(), slender);
  add_deviations(summary, "thick_", impact.way(), thick);
  return summary;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(
      argc, argv,
      {"beam_impact", "Lets a steel sphere hit a steel beam across its axis: Timoshenko's solution beside it."},
      [](const CommandLine &command_line)
      { return run_job<ImpactParameters, ImpactRun>("A sphere on a beam", command_line); });
}
