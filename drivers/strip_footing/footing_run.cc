#include "drivers/strip_footing/footing_run.h"

#include "dem/core/archive.h"
#include "dem/core/error.h"
#include "dem/core/pvd.h"
#include "dem/core/whole_file.h"
#include "drivers/common/interrupt.h"
#include "fe_dealii/output.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bergamo::driver
{
namespace
{

constexpr const char *kind = "strip footing";
constexpr double bearing_share = 0.1; // of the loading time, its end, over which the limit pressure is read

const std::vector<std::string> columns = {"time_s",
                                          "settlement_m",
                                          "footing_pressure_Pa",
                                          "energy_kinetic_J",
                                          "energy_elastic_J",
                                          "energy_plastic_loss_J",
                                          "energy_viscous_loss_J",
                                          "energy_footing_work_J",
                                          "energy_gravity_work_J",
                                          "energy_surcharge_work_J",
                                          "energy_residual_J"};

std::string picture_name(const std::size_t number)
{
  char name[64];
  std::snprintf(name, sizeof name, "continuum_%04zu.vtu", number);
  return name;
}

} // namespace

FootingRun::FootingRun(const FootingParameters &p, const CommandLine &command_line, std::string text, RunFolder &f)
    : parameters(p), parameter_text(std::move(text)), folder(f), is_restart(command_line.restart),
      progress(ProgressOptions::standard(command_line.quiet)), model(p), snapshot_timer(p.snapshot_interval)
{
  if (!is_restart)
    return;
  const ArchiveReader archive(folder.snapshot(), kind);
  if (archive.read_text("parameters") != parameter_text)
    throw ConfigError("the snapshot " + folder.snapshot().string() +
                      " belongs to other parameters; restart with those of the run (" + folder.parameters().string() +
                      "), or start anew in another folder");
  state.step = archive.read_integer("step");
  state.largest_residual = archive.read_double("largest_residual");
  state.bearing_sum = archive.read_double("bearing_sum");
  state.n_bearing = archive.read_double("n_bearing");
  state.picture_times = archive.read_doubles("picture_times");
  for (const auto &[name, values] : model.body().state())
    archive.read_into("continuum/" + name, values);
}

void FootingRun::write_snapshot()
{
  ArchiveWriter archive(folder.snapshot(), kind);
  archive.write("parameters", parameter_text);
  archive.write("step", state.step);
  archive.write("largest_residual", state.largest_residual);
  archive.write("bearing_sum", state.bearing_sum);
  archive.write("n_bearing", state.n_bearing);
  archive.write("picture_times", state.picture_times);
  for (const auto &[name, values] : model.body().state())
    archive.write("continuum/" + name, std::span<const double>(values));
  archive.commit();
}

bool FootingRun::run()
{
  folder.open();
  if (!is_restart)
    write_whole_file(folder.parameters(), parameter_text);
  const double dt = model.time_step();
  History history = state.step > 0 ? History::continued(folder.history(), columns, (state.step - 0.5) * dt)
                                   : History(folder.history(), columns);
  const auto n_steps = static_cast<std::int64_t>(std::ceil(parameters.loading_time / dt));
  const std::int64_t sample_interval = std::max<std::int64_t>(1, n_steps / parameters.n_samples);
  const std::int64_t picture_interval =
      parameters.n_pictures > 1 ? std::max<std::int64_t>(1, n_steps / (parameters.n_pictures - 1)) : n_steps;
  const auto here = [&] {
    return ProgressState{static_cast<double>(state.step) / n_steps, state.step * dt, state.step, 0};
  };

  progress.begin_stage("settlement", here());
  for (;; ++state.step, ++steps_here)
  {
    const bool is_last = state.step >= n_steps;
    if (state.step % 50 == 0)
    {
      progress.update(here());
      const bool stop = interrupted() && !is_last;
      if (stop || snapshot_timer.is_due())
        write_snapshot();
      if (stop)
        return false;
    }
    const double time = state.step * dt;
    model.compute_forces(time);
    model.kick();
    if (state.step % sample_interval == 0 || is_last)
      sample(time, history);
    if (state.step >= (1 - bearing_share) * n_steps)
    {
      state.bearing_sum += model.footing_pressure();
      state.n_bearing += 1;
    }
    if (state.step % picture_interval == 0 || is_last)
      write_picture(time);
    if (is_last)
      break;
    model.drift();
  }
  progress.end_stage();
  return true;
}

void FootingRun::sample(const double time, History &history)
{
  const fe::ExplicitBody &body = model.body();
  if (!body.is_finite())
    throw RunError("the run diverged: the ground is not finite at time " + std::to_string(time) +
                   " s; choose a smaller Output/step share");
  const fe::BodyEnergy e = body.energy();
  state.largest_residual = std::max(state.largest_residual, std::abs(e.residual()));
  const double row[] = {time,
                        parameters.settlement_at(time),
                        model.footing_pressure(),
                        e.kinetic,
                        e.elastic,
                        e.plastic_dissipation,
                        e.viscous_dissipation,
                        e.boundary_work,
                        e.gravity_work,
                        e.external_work,
                        e.residual()};
  history.append(row);
}

void FootingRun::write_picture(const double time)
{
  state.picture_times.push_back(time);
  std::vector<std::pair<double, std::string>> frames;
  for (std::size_t k = 0; k < state.picture_times.size(); ++k)
    frames.emplace_back(state.picture_times[k], picture_name(k));
  fe::write_vtu(model.body(), folder.file(frames.back().second));
  write_pvd(folder.file("continuum.pvd"), frames);
}

Summary FootingRun::summary() const
{
  const double wall_time = std::chrono::duration<double>(Clock::now() - start).count();
  const fe::BodyEnergy e = model.body().energy();
  const double limit = parameters.limit_pressure(), bearing = state.bearing_sum / state.n_bearing;
  Summary summary;
  summary.set("model", std::string("continuum"));
  RunFigures figures;
  figures.wall_time_s = wall_time;
  figures.steps = state.step;
  figures.threads = omp_get_max_threads();
  figures.time_step_s = model.time_step();
  figures.stable_time_step_s = model.stable_time_step();
  figures.energy_residual = state.largest_residual / std::max(std::abs(e.boundary_work), 1e-300);
  summary.set(figures);
  summary.set("elements", static_cast<std::int64_t>(model.body().n_elements()));
  summary.set("element_updates_per_second", model.body().n_elements() * steps_here / wall_time, "1/s");
  summary.set("start_out_of_balance", model.start().residual.back());
  summary.set("bearing_pressure_Pa", bearing, "Pa");
  summary.set("limit_pressure_Pa", limit, "Pa");
  summary.set("bearing_over_limit", bearing / limit);
  summary.set("kinetic_over_elastic_energy", e.kinetic / e.elastic);
  return summary;
}

} // namespace bergamo::driver
