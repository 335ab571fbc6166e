#include "drivers/two_scale_triaxial/triaxial_run.h"

#include "drivers/common/run/model_pictures.h"

#include <algorithm>

namespace bergamo::driver
{
namespace
{

constexpr const char *sample_file = "sample.h5"; // of the packing, for other runs

} // namespace

TriaxialRun::TriaxialRun(const TriaxialParameters &p, const CommandLine &command_line,
                         const std::string &parameter_text)
    : parameters(p),
      run(command_line, {"two-scale triaxial test", parameter_text, p.output.snapshot_interval, {sample_file}}),
      pictures(run.folder().path())
{
  if (run.keep([this](StateVisitor &v) { visit(v); }))
    return;
  require_stable_continuum(p);
  if (p.has_grains())
    packing.emplace(p.sample.empty() ? begin_packing(p) : read_sample(p));
  start.box = {Vec3::Zero(), p.edges()};
  if (!p.has_grains())
    specimen = std::make_unique<Specimen>(p, nullptr, start);
}

int TriaxialRun::go()
{
  run.open();
  if ((packing && !pack()) || !load())
    return run.stop();
  specimen->write_tables(run.folder().path(), now.profile);
  return run.finish(summary(), {"two_scale_triaxial/plot.py", "energy.py", "picture.py"});
}

void TriaxialRun::visit(StateVisitor &visit)
{
  visit("packing_steps", packing_steps); // 0: the grains are still being packed
  if (parameters.has_grains() && packing_steps == 0)
    return visit_packing(visit, packing, parameters);
  visit_loading(visit, specimen, start, parameters);
  pictures.visit(visit);
  stable_step.visit(visit);
  residual.visit(visit);
  visit("largest_overlap", largest_overlap);
}

bool TriaxialRun::pack()
{
  dem::Simulation &grains = *packing->grains;
  if (parameters.sample.empty())
  {
    if (!run.advance(stage_of(*packing, parameters.expected_solid_fraction),
                     {{every_steps(200), [&] { grains.check_finite(); }}}))
      return false;
    grains.integrate();
    write_sample(run.folder().file(sample_file), grains, parameters);
  }
  packing_steps = grains.n_steps;
  start = end_packing(grains, parameters);
  specimen = std::make_unique<Specimen>(parameters, std::move(packing->grains), start);
  specimen->settle(run.progress());
  specimen->model.grains()->reset_accounts();
  packing.reset();
  return true;
}

bool TriaxialRun::load()
{
  History history = run.history(table);
  const dem::StrainProgram &program = parameters.program;
  const double dt = parameters.simulation.time_step;
  const std::int64_t n_steps = parameters.loading_steps();
  const auto sample = [&]
  {
    now = specimen->measure(time());
    now.residual = residual.add(now.energy.balance(), now.energy.wall_work);
    largest_overlap = std::max(largest_overlap, now.largest_overlap);
    history.append(table.row());
    specimen->look_at_rotation(run.progress());
  };
  const auto look_at_step = [&] { stable_step.look(dt, specimen->model.stable_steps().combined(), run.progress()); };
  const auto draw = [&] { pictures.add(time(), pictures_of(specimen->model.grains(), specimen->model.body())); };
  Stage stage = run.even_stage("loading", n_steps, dt);
  stage.n_particles = specimen->n_grains();
  stage.compute = [&] { specimen->compute(program.strain(stage.time()), program.strain(stage.time() + dt)); };
  stage.move = [&] { specimen->move(); };
  return run.advance(stage, {{evenly(parameters.output.n_samples, n_steps, parameters.cycle()), sample},
                             {every_steps(std::max<std::int64_t>(1, n_steps / 10)), look_at_step},
                             {evenly(parameters.output.n_pictures - 1, n_steps), draw}});
}

Summary TriaxialRun::summary() const
{
  RunFigures figures = run.figures(specimen->n_grains());
  figures.steps = packing_steps + run.loop().step();
  figures.time_step_s = parameters.simulation.time_step;
  figures.stable_time_step_s = stable_step.smallest();
  figures.energy_residual = residual.relative();
  figures.undecided_contacts = specimen->n_undecided();
  figures.max_overlap_over_radius = largest_overlap;
  Summary summary;
  summary.set("model", std::string(parameters.model_name()));
  summary.set(figures);
  if (parameters.has_grains())
  {
    summary.set("packing_solid_fraction", start.solid_fraction);
    summary.set("packing_coordination_number", start.coordination_number);
  }
  specimen->add_figures(summary);
  now.add_figures(summary);
  return summary;
}

} // namespace bergamo::driver
