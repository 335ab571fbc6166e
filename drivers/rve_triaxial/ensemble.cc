#include "drivers/rve_triaxial/ensemble.h"

#include "dem/core/archive.h"
#include "dem/core/error.h"
#include "dem/core/whole_file.h"
#include "drivers/common/csv_table.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/number_text.h"
#include "drivers/common/progress.h"

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <omp.h>
#include <thread>

namespace bergamo::driver
{
namespace
{

constexpr const char *snapshot_kind = "triaxial ensemble";

/// One row of comma-separated numbers with their names.
std::string table(const std::vector<std::string> &names, const std::vector<std::vector<double>> &rows)
{
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k > 0 ? "," : "") + names[k];
  text += '\n';
  for (const std::vector<double> &row : rows)
  {
    for (std::size_t k = 0; k < row.size(); ++k)
      text += (k > 0 ? "," : "") + exact_text(row[k]);
    text += '\n';
  }
  return text;
}

double mean(const std::vector<double> &values)
{
  double sum = 0.;
  for (const double v : values)
    sum += v;
  return sum / static_cast<double>(values.size());
}

} // namespace

Ensemble::Ensemble(const RveParameters &p, std::string text, RunFolder &run_folder, const bool restart)
    : parameters(p), parameter_text(std::move(text)), folder(run_folder), is_restart(restart)
{
  for (const SampleSettings &settings : parameters.samples())
  {
    samples.push_back(std::make_unique<Sample>());
    samples.back()->settings = settings;
  }
  if (!is_restart)
    return;
  const ArchiveReader archive(folder.snapshot(), snapshot_kind);
  if (archive.read_text("parameters") != parameter_text)
    throw ConfigError("the run in " + folder.path().string() +
                      " has other parameters; restart with its parameters.prm, or start anew in another folder");
  for (const auto &sample : samples)
    sample->is_finished = read_figures(*sample);
}

std::filesystem::path Ensemble::folder_of(const Sample &sample) const
{
  char name[32];
  std::snprintf(name, sizeof name, "%04lld", static_cast<long long>(sample.settings.number));
  return folder.path() / "samples" / name;
}

bool Ensemble::read_figures(Sample &sample) const
{
  const std::filesystem::path path = folder_of(sample) / "figures.csv";
  if (!std::filesystem::exists(path))
    return false;
  const CsvTable figures = read_csv(path, SampleFigures::names());
  std::vector<double> values;
  for (const std::string &name : SampleFigures::names())
    values.push_back(figures[name].at(0));
  sample.figures = SampleFigures::from(values);
  sample.progress.fraction = 1.;
  return true;
}

void Ensemble::write_figures(const Sample &sample) const
{
  write_whole_file(folder_of(sample) / "figures.csv", table(SampleFigures::names(), {sample.figures.values()}));
}

void Ensemble::write_table() const
{
  std::vector<std::string> names{"sample",  "seed", "edge_m", "generation_friction", "confining_pressure_Pa",
                                 "finished"};
  for (const std::string &name : SampleFigures::names())
    names.push_back(name);
  std::vector<std::vector<double>> rows;
  for (const auto &sample : samples)
  {
    const SampleSettings &s = sample->settings;
    rows.push_back({static_cast<double>(s.number), static_cast<double>(s.seed), s.edge, s.generation_friction,
                    s.confining_pressure, sample->is_finished ? 1. : 0.});
    const std::vector<double> values = sample->figures.values();
    rows.back().insert(rows.back().end(), values.begin(), values.end());
  }
  write_whole_file(folder.file("ensemble.csv"), table(names, rows));
}

std::vector<Ensemble::Sample *> Ensemble::unfinished()
{
  std::vector<Sample *> left;
  for (const auto &sample : samples)
    if (!sample->is_finished)
      left.push_back(sample.get());
  return left;
}

void Ensemble::run_sample(Sample &sample)
{
  try
  {
    SampleRun run(parameters, sample.settings, folder_of(sample), parameter_text, sample.progress);
    if (!run.run())
      return;
    sample.figures = run.figures();
    sample.is_finished = true;
    write_figures(sample);
    std::filesystem::remove(folder_of(sample) / "snapshot.h5"); // the figures say that it is finished
  }
  catch (const std::exception &error)
  {
    sample.failure = error.what();
  }
}

bool Ensemble::run(const bool quiet)
{
  folder.open();
  if (!is_restart)
  {
    write_whole_file(folder.parameters(), parameter_text);
    ArchiveWriter archive(folder.snapshot(), snapshot_kind);
    archive.write("parameters", parameter_text);
    archive.commit();
  }
  write_table();

  const auto begin = std::chrono::steady_clock::now();
  const std::vector<Sample *> left = unfinished();
  const int n_threads = omp_get_max_threads();
  const int n_workers = std::min<int>(n_threads, static_cast<int>(left.size()));
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::condition_variable changed;
  int n_working = n_workers;
  std::vector<std::jthread> workers;
  for (int w = 0; w < n_workers; ++w)
    workers.emplace_back(
        [&, w]
        {
          omp_set_num_threads(std::max(1, (n_threads + n_workers - 1 - w) / n_workers));
          for (std::size_t k; !interrupted() && (k = next++) < left.size();)
          {
            run_sample(*left[k]);
            const std::lock_guard guard(mutex);
            if (left[k]->is_finished)
              write_table();
          }
          const std::lock_guard guard(mutex);
          --n_working;
          changed.notify_all();
        });

  Progress progress(ProgressOptions::standard(quiet));
  const auto here = [&]
  {
    double fraction = 0.;
    std::int64_t steps = 0, particles = 1;
    particle_steps_here = 0;
    for (const auto &sample : samples)
    {
      fraction += sample->progress.fraction / static_cast<double>(samples.size());
      steps += sample->progress.steps_here;
      particles = std::max<std::int64_t>(particles, sample->progress.particles);
      particle_steps_here += sample->progress.steps_here * sample->progress.particles;
    }
    return ProgressState{fraction, 0., steps, particles};
  };
  progress.begin_stage(std::to_string(samples.size()) + " samples", here());
  {
    std::unique_lock lock(mutex);
    while (n_working > 0)
    {
      changed.wait_for(lock, std::chrono::milliseconds(200));
      progress.update(here());
    }
  }
  workers.clear();
  progress.update(here());
  progress.end_stage();
  wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  std::string failures;
  for (const auto &sample : samples)
    if (!sample->failure.empty())
      failures += "\n  sample " + std::to_string(sample->settings.number) + ": " + sample->failure;
  if (!failures.empty())
    throw RunError("some samples failed; the others are kept, and --restart tries these again:" + failures);
  return unfinished().empty();
}

Summary Ensemble::summary() const
{
  std::vector<double> generated, begun, ended, ratio;
  RunFigures run;
  run.wall_time_s = wall_time;
  run.threads = omp_get_max_threads();
  run.stable_time_step_s = std::numeric_limits<double>::infinity();
  for (const auto &sample : samples)
  {
    const SampleFigures &f = sample->figures;
    generated.push_back(f.generated_solid_fraction);
    begun.push_back(f.solid_fraction);
    ended.push_back(f.final_solid_fraction);
    ratio.push_back(f.final_stress_ratio);
    run.steps += f.n_steps;
    run.particles += f.n_particles;
    if (f.time_step / f.stable_step >= run.time_step_s / run.stable_time_step_s)
    {
      run.time_step_s = f.time_step;
      run.stable_time_step_s = f.stable_step;
    }
    run.energy_residual = std::max(run.energy_residual, f.energy_residual);
    run.undecided_contacts += f.n_undecided;
    run.max_overlap_over_radius = std::max(run.max_overlap_over_radius, f.largest_overlap);
  }
  run.particle_steps_per_second = wall_time > 0. ? static_cast<double>(particle_steps_here) / wall_time : 0.;
  Summary summary;
  summary.set(run);
  summary.set("samples", samples.size());
  summary.set("mean_generated_solid_fraction", mean(generated));
  summary.set("mean_solid_fraction", mean(begun));
  summary.set("mean_final_solid_fraction", mean(ended));
  summary.set("mean_final_stress_ratio", mean(ratio));
  return summary;
}

} // namespace bergamo::driver
