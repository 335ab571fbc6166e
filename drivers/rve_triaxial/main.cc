#include "dem/core/error.h"
#include "drivers/common/driver_main.h"
#include "drivers/common/run/run.h"
#include "drivers/rve_triaxial/failure_report.h"

#include <algorithm>
#include <cstdio>
#include <mutex>

namespace
{

using namespace bergamo;
using namespace bergamo::driver;

/// All samples of a run, several at once, each in samples/NNNN of the run's folder.
class Ensemble
{
public:
  Ensemble(const RveParameters &parameters, const CommandLine &command_line, const std::string &parameter_text);

  /// A sample that fails is reported at the end, and the others go on; @throws RunError then
  int go();

private:
  void run_sample(Sample &sample);
  void write_table() const;
  Summary summary() const;

  const RveParameters &parameters;
  std::string parameter_text;
  Run run;
  std::vector<std::shared_ptr<Sample>> samples;
  std::mutex table;
};

Ensemble::Ensemble(const RveParameters &p, const CommandLine &command_line, const std::string &text)
    : parameters(p), parameter_text(text),
      run(command_line, {"triaxial ensemble", text, p.snapshot_interval, {"samples", "ensemble.csv"}})
{
  const bool goes_on = run.keep([](StateVisitor &) {}); // the samples have snapshots of their own
  for (const SampleSettings &settings : parameters.samples())
  {
    char name[32];
    std::snprintf(name, sizeof name, "%04lld", static_cast<long long>(settings.number));
    Sample &sample = *samples.emplace_back(std::make_shared<Sample>());
    sample.settings = settings;
    sample.folder = run.folder().path() / "samples" / name;
    sample.run = [this, &sample] { run_sample(sample); };
    if (!goes_on || !std::filesystem::exists(sample.figures_file()))
      continue;
    read_figures(sample.figures_file(), sample.figures.list());
    sample.is_finished = true;
    sample.fraction = 1.;
  }
}

int Ensemble::go()
{
  run.open();
  if (!run.is_restart())
    run.write_snapshot();
  write_table();
  const std::vector<std::shared_ptr<Job>> jobs(samples.begin(), samples.end());
  run_jobs(jobs, std::to_string(samples.size()) + " samples", run.progress());
  if (const std::string report = failure_report(parameters, samples); !report.empty())
    throw RunError(report);
  if (std::any_of(jobs.begin(), jobs.end(), [](const auto &job) { return !job->is_finished; }))
    return run.stop();
  return run.finish(summary(), {"rve_triaxial/plot.py"});
}

void Ensemble::run_sample(Sample &sample)
{
  SampleRun sample_run(parameters, sample.settings, sample.folder, parameter_text, sample);
  if (!sample_run.run())
    return;
  const std::lock_guard guard(table);
  sample.figures = sample_run.figures();
  write_csv(sample.figures_file(), names_of(sample.figures.list()), {values_of(sample.figures.list())});
  sample.is_finished = true;
  write_table();
  std::filesystem::remove(sample.folder / "snapshot.h5");
}

void Ensemble::write_table() const
{
  std::vector<std::string> names{"sample",  "seed", "edge_m", "generation_friction", "confining_pressure_Pa",
                                 "finished"};
  for (const std::string &name : names_of(SampleFigures().list()))
    names.push_back(name);
  std::vector<std::vector<double>> rows;
  for (const auto &sample : samples)
  {
    const SampleSettings &s = sample->settings;
    rows.push_back({static_cast<double>(s.number), static_cast<double>(s.seed), s.edge, s.generation_friction,
                    s.confining_pressure, sample->is_finished ? 1. : 0.});
    for (const double value : values_of(sample->figures.list()))
      rows.back().push_back(value);
  }
  write_csv(run.folder().file("ensemble.csv"), names, rows);
}

Summary Ensemble::summary() const
{
  RunFigures figures = run.figures(0);
  SampleFigures sum;
  figures.stable_time_step_s = std::numeric_limits<double>::infinity();
  for (const auto &sample : samples)
  {
    const SampleFigures &f = sample->figures;
    sum.generated_solid_fraction += f.generated_solid_fraction;
    sum.solid_fraction += f.solid_fraction;
    sum.final_solid_fraction += f.final_solid_fraction;
    sum.final_stress_ratio += f.final_stress_ratio;
    figures.steps += static_cast<std::int64_t>(f.n_steps);
    figures.particles += static_cast<std::int64_t>(f.n_particles);
    if (f.time_step / f.stable_step >= figures.time_step_s / figures.stable_time_step_s)
    {
      figures.time_step_s = f.time_step;
      figures.stable_time_step_s = f.stable_step;
    }
    figures.energy_residual = std::max(figures.energy_residual, f.energy_residual);
    figures.undecided_contacts += static_cast<std::int64_t>(f.n_undecided);
    figures.max_overlap_over_radius = std::max(figures.max_overlap_over_radius, f.largest_overlap);
  }
  figures.particle_steps_per_second = particle_steps_here({samples.begin(), samples.end()}) / figures.wall_time_s;
  const double n = samples.size();
  Summary summary;
  summary.set(figures);
  summary.set("samples", samples.size());
  summary.set("mean_generated_solid_fraction", sum.generated_solid_fraction / n);
  summary.set("mean_solid_fraction", sum.solid_fraction / n);
  summary.set("mean_final_solid_fraction", sum.final_solid_fraction / n);
  summary.set("mean_final_stress_ratio", sum.final_stress_ratio / n);
  return summary;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(
      argc, argv,
      {"rve_triaxial",
       "Triaxial and other tests on periodic cells of grains: packs, compresses and loads an ensemble of "
       "samples, several at once. fit_mohr_coulomb reads the result."},
      [](const CommandLine &command_line)
      { return run_job<RveParameters, Ensemble>("Triaxial tests on periodic cells of grains", command_line); });
}
