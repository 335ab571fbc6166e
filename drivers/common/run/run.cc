#include "drivers/common/run/run.h"

#include "dem/core/whole_file.h"
#include "drivers/common/driver_main.h"
#include "drivers/common/report_run.h"

#include <omp.h>

#include <algorithm>
#include <utility>

namespace bergamo::driver
{

namespace
{

constexpr double display_interval = 0.2; // s between two looks at where the run is

} // namespace

Run::Run(const CommandLine &command_line, const RunDescription &description)
    : command_line_(command_line), parameters_(description.parameters), folder_(command_line, description.own_files),
      snapshot_(folder_.snapshot(), description.kind, description.parameters),
      progress_(ProgressOptions::standard(command_line.quiet)),
      loop_({description.snapshot_interval, [this] { snapshot_.write_behind(state_); }})
{
}

bool Run::keep(Visit state)
{
  state_ = [this, state = std::move(state)](StateVisitor &visit)
  {
    loop_.visit(visit);
    state(visit);
  };
  if (command_line_.restart)
    snapshot_.read(state_);
  return command_line_.restart;
}

void Run::open()
{
  watch_.emplace();
  folder_.open();
  if (!command_line_.restart)
    write_whole_file(folder_.parameters(), parameters_);
}

History Run::history(const Table &table, const std::filesystem::path &file) const
{
  return loop_.begins_stage() ? History(file, table.names())
                              : History::continued(file, table.names(), loop_.last_time());
}

Stage Run::even_stage(const std::string &name, const std::int64_t n_steps, const double time_step) const
{
  Stage stage;
  stage.name = name;
  stage.time = [this, time_step] { return static_cast<double>(loop_.step()) * time_step; };
  stage.is_last = [this, n_steps] { return loop_.step() >= n_steps; };
  stage.fraction = [this, n_steps]
  {
    const std::int64_t done = loop_.begins_stage() ? 0 : loop_.step(); // of this stage, not of the one before
    return static_cast<double>(done) / static_cast<double>(n_steps);
  };
  return stage;
}

bool Run::advance(const Stage &stage, std::vector<Action> actions)
{
  const auto here = [&] {
    return ProgressState{stage.fraction(), stage.time(), loop_.steps_here(), stage.n_particles};
  };
  actions.push_back({either(every_wall_time(display_interval), at_the_end()), [&] { progress_.update(here()); }});
  progress_.begin_stage(stage.name, here());
  if (!loop_.run(stage, actions))
    return false;
  progress_.end_stage();
  return true;
}

RunFigures Run::figures(const std::int64_t n_particles) const
{
  RunFigures figures;
  figures.wall_time_s = wall_clock() - start_;
  figures.core_hours = loop_.cost().core_seconds() / 3600.;
  figures.core_time_per_step_s =
      loop_.cost().stepping_seconds() / static_cast<double>(std::max<std::int64_t>(1, loop_.step()));
  figures.threads = omp_get_max_threads();
  figures.particles = n_particles;
  figures.particle_steps_per_second = static_cast<double>(n_particles * loop_.steps_here()) / figures.wall_time_s;
  return figures;
}

int Run::finish(const Summary &summary, const std::vector<std::string> &scripts) const
{
  snapshot_.wait();
  std::vector<PlotJob> pictures;
  for (const std::string &script : scripts)
    pictures.push_back({script, {folder_.path().string()}});
  report_run(summary, folder_, command_line_, pictures);
  return done;
}

int Run::stop() const
{
  snapshot_.wait();
  return report_stop(folder_);
}

} // namespace bergamo::driver
