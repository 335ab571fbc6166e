#include "drivers/membrane_triaxial/triaxial_run.h"

#include "dem/core/error.h"
#include "dem/loading/compression.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/step_count.h"
#include "drivers/common/run/visit_models.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{
namespace
{

constexpr const char *sample_file = "sample.h5";
constexpr std::int64_t steps_between_looks = 50; // at whether all rests

} // namespace

MembraneTriaxialRun::MembraneTriaxialRun(const MembraneTriaxialParameters &p, const CommandLine &command_line,
                                         const std::string &parameter_text)
    : parameters(p), run(command_line, {"triaxial test in a membrane",
                                        parameter_text,
                                        p.output.snapshot_interval,
                                        {"mould.csv", sample_file, "loading.csv", "shape.csv"}}),
      mould(p), pictures(run.folder().path())
{
  run.keep([this](StateVisitor &v) { visit(v); });
}

void MembraneTriaxialRun::visit(StateVisitor &visit)
{
  visit("part", part);
  if (part == Part::filling)
    return;
  if (part == Part::shrinking)
    return mould.visit(visit);
  visit("prism/radius", prism.radius);
  visit("prism/height", prism.height);
  start.visit(visit, "start");
  if (auto read = visit_grains(visit, cell ? &cell->sample() : nullptr, parameters.testing()))
    cell = std::make_unique<TriaxialCell>(parameters, std::move(read), prism);
  cell->visit_membrane(visit);
  grain = dem::mean_grain(cell->sample().particles);
  visit("n_looks_passed", n_looks_passed);
  now.residual.visit(visit);
  figures.visit(visit);
  stable_step.visit(visit);
  pictures.visit(visit);
}

int MembraneTriaxialRun::go()
{
  if (part == Part::filling && !parameters.sample.empty())
    read_sample();
  run.open();
  return make_sample() && load() && compress()
             ? run.finish(summary(), {"membrane_triaxial/plot.py", "membrane_triaxial/plot_shape.py"})
             : run.stop();
}

void MembraneTriaxialRun::read_sample()
{
  std::unique_ptr<dem::Simulation> grains;
  sample_in(parameters.sample).read([&](StateVisitor &v) { visit_sample(v, grains); });
  begin_test(std::move(grains));
}

bool MembraneTriaxialRun::make_sample()
{
  if (part > Part::shrinking)
    return true;
  if (!fill_mould())
    return false;
  prism = mould.prism();
  std::unique_ptr<dem::Simulation> grains = mould.take();
  sample_in(run.folder().file(sample_file)).write([&](StateVisitor &v) { visit_sample(v, grains); });
  begin_test(std::move(grains));
  return true;
}

Snapshot MembraneTriaxialRun::sample_in(const std::filesystem::path &path) const
{
  return Snapshot(path, "sample in a mould", parameters.sample_text(),
                  "give those of the sample, or leave Mould/sample out");
}

void MembraneTriaxialRun::begin_test(std::unique_ptr<dem::Simulation> grains)
{
  cell = std::make_unique<TriaxialCell>(parameters, std::move(grains), prism);
  grain = dem::mean_grain(cell->sample().particles);
  begin(Part::loading);
}

/// What another test needs of it.
void MembraneTriaxialRun::visit_sample(StateVisitor &visit, std::unique_ptr<dem::Simulation> &grains)
{
  visit("prism/radius", prism.radius);
  visit("prism/height", prism.height);
  if (auto read = visit_grains(visit, grains.get(), parameters.testing()))
  {
    grains = std::move(read);
    grains->change(parameters.testing()); // friction, weight and step are those of the other test
  }
}

bool MembraneTriaxialRun::fill_mould()
{
  if (part == Part::filling)
  {
    run.write_snapshot(); // packing takes long, and may be interrupted
    if (!mould.fill())
      return false;
    part = Part::shrinking;
  }
  Stage stage;
  stage.name = "shrinking the mould";
  stage.n_particles = static_cast<std::int64_t>(mould.sample().particles.size());
  stage.time = [&] { return mould.time(); };
  stage.is_last = [&] { return mould.is_finished(); };
  stage.fraction = [&] { return std::min(0.99, mould.time() / parameters.mould.longest_time); };
  stage.compute = [&] { mould.compute(); };
  stage.move = [&] { mould.move(); };
  const Table table = mould.table();
  History rows = run.history(table, run.folder().file("mould.csv"));
  return run.advance(stage,
                     {{every_steps(steps_between_looks), [&] { mould.look(); }},
                      {either(every_steps(10 * steps_between_looks), at_the_end()), [&] { rows.append(table.row()); }},
                      {every_steps(200), [&] { mould.sample().check_finite(); }}});
}

void MembraneTriaxialRun::begin(const Part next)
{
  part = next;
  start = {cell->height(), cell->volume()};
}

bool MembraneTriaxialRun::load()
{
  if (part > Part::loading)
    return true;
  Stage stage = stage_of("loading", whole_steps(parameters.longest_loading / parameters.simulation.time_step));
  stage.is_last = [&] { return n_looks_passed >= 5.; };
  stage.compute = [&] { cell->load(parameters.pressure_at(stage.time())); };
  const Table table = now.table();
  History rows = run.history(table, run.folder().file("loading.csv"));
  const auto add_row = [&]
  {
    now.measure(*cell, start, stage.time(), 0.);
    rows.append(table.row());
    figures.end_loading(now);
  };
  if (!run.advance(stage, {{every_steps(steps_between_looks), [&] { look_at_load(stage.time()); }},
                           {either(every_time(parameters.loading_time / 50.), at_the_end()), add_row}}))
    return false;
  cell->move();
  begin(Part::compressing);
  return true;
}

/// The pressure is there, the plates have it, and the grains rest.
void MembraneTriaxialRun::look_at_load(const double time)
{
  const double of_plates = cell->axial_force() / cell->section(), wanted = parameters.pressure;
  const bool holds =
      time > parameters.loading_time && std::abs(of_plates - wanted) < parameters.pressure_tolerance * wanted;
  const double unbalance = holds ? dem::unbalanced_force(cell->sample()) : 1.;
  n_looks_passed = unbalance < parameters.force_tolerance ? n_looks_passed + 1. : 0.;
  if (time > parameters.longest_loading)
    throw RunError("the sample did not come to rest under its pressure within Test/longest loading: the plates bear " +
                   std::to_string(of_plates) + " Pa, the unbalanced force is " + std::to_string(unbalance) +
                   "; allow more time or larger tolerances");
}

bool MembraneTriaxialRun::compress()
{
  const std::int64_t n_steps = parameters.n_steps(grain);
  const double dt = parameters.simulation.time_step;
  Stage stage = stage_of("compressing", n_steps);
  const auto rate_at = [&](const double time) { return parameters.rate_at(time, grain); };
  stage.compute = [&] { cell->compress(parameters.pressure, start.height * rate_at(stage.time() + 0.5 * dt)); };
  const Table table = now.table(), shapes = now.shape_table(parameters.membrane.n_high + 1);
  History rows = run.history(table), rings = run.history(shapes, run.folder().file("shape.csv"));
  const auto add_row = [&]
  {
    now.measure(*cell, start, stage.time(), rate_at(stage.time()));
    figures.look(now);
    rows.append(table.row());
    rings.append(shapes.row());
  };
  const auto look_at_step = [&] { stable_step.look(dt, cell->stable_step(), run.progress()); };
  const auto draw = [&] { pictures.add(stage.time(), pictures_of(&cell->sample(), nullptr)); };
  return run.advance(stage, {{evenly(parameters.output.n_samples, n_steps), add_row},
                             {every_steps(std::max<std::int64_t>(1, n_steps / 20)), look_at_step},
                             {evenly(std::max(1u, parameters.output.n_pictures - 1), n_steps), draw}});
}

Stage MembraneTriaxialRun::stage_of(const std::string &name, const std::int64_t n_steps)
{
  Stage stage = run.even_stage(name, n_steps, parameters.simulation.time_step);
  stage.n_particles = static_cast<std::int64_t>(cell->sample().particles.size());
  stage.move = [&] { cell->move(); };
  return stage;
}

Summary MembraneTriaxialRun::summary() const
{
  const dem::Simulation &grains = cell->sample();
  RunFigures own = run.figures(static_cast<std::int64_t>(grains.particles.size()));
  own.steps = grains.n_steps;
  own.time_step_s = parameters.simulation.time_step;
  own.stable_time_step_s = stable_step.smallest();
  own.energy_residual = now.residual.relative();
  own.undecided_contacts = grains.contacts.n_undecided();
  own.max_overlap_over_radius = figures.largest_overlap;
  Summary summary;
  summary.set("model", std::string("triaxial test in a membrane"));
  summary.set(own);
  summary.set("elements", static_cast<std::int64_t>(cell->membrane().n_elements()));
  summary.set("nodes", static_cast<std::int64_t>(cell->membrane().n_nodes()));
  summary.set("mould_diameter_m", 2. * prism.radius, "m");
  summary.set("mould_height_m", prism.height, "m");
  summary.set("strain_rate_1_s", parameters.strain_rate(grain), "1/s");
  figures.add_to(summary);
  const CellShares shares = cell->shares();
  summary.set("share_of_grains", shares.grains);
  summary.set("share_of_searches", shares.searches);
  summary.set("share_of_elements", shares.elements);
  summary.set("share_of_coupling", shares.coupling);
  return summary;
}

} // namespace bergamo::driver
