#include "drivers/common/driver_main.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/common/run/step_count.h"
#include "drivers/hourglass/sand_flow.h"

#include <algorithm>

namespace
{

using namespace bergamo;
using namespace bergamo::driver;

constexpr std::int64_t steps_between_looks = 500; // at the stable step

class HourglassRun
{
public:
  HourglassRun(const HourglassParameters &p, const CommandLine &command_line, const std::string &parameter_text)
      : parameters(p), run(command_line, {"hourglass", parameter_text, p.output.snapshot_interval, {"mass_flow.csv"}}),
        sand(p), pictures(run.folder().path())
  {
    run.keep([this](StateVisitor &v) { visit(v); });
  }

  int go();

private:
  void visit(StateVisitor &visit);
  Summary summary() const;

  const HourglassParameters &parameters;
  Run run;
  SandFlow sand;
  PictureSeries pictures;
  StableStepWatch stable_step{"Output/time step"};
};

void HourglassRun::visit(StateVisitor &visit)
{
  sand.visit(visit);
  pictures.visit(visit);
  stable_step.visit(visit);
}

int HourglassRun::go()
{
  steps_over({"Discharge/longest time", parameters.longest_time},
             {"Output/time step", parameters.simulation.time_step}); // or refused
  run.open();
  if (run.loop().begins_stage())
  {
    run.write_snapshot(); // packing takes long, and may be interrupted
    if (!sand.begin())
      return run.stop();
  }
  const Table table = sand.table();
  History history = run.history(table);
  dem::Simulation &grains = sand.grains();
  Stage stage;
  stage.name = "flow";
  stage.n_particles = sand.n_grains();
  stage.time = [&] { return sand.time(); };
  stage.is_last = [&] { return sand.is_over(); };
  stage.fraction = [&] { return sand.fraction(); };
  stage.compute = [&]
  {
    grains.compute_forces();
    grains.kick();
  };
  stage.move = [&] { grains.drift(); };
  const auto add_row = [&]
  {
    sand.look();
    history.append(table.row());
  };
  const auto look_at_step = [&]
  {
    sand.look_at_step();
    stable_step.look(parameters.simulation.time_step, grains.stable_time_step(), run.progress());
  };
  const auto draw = [&]
  {
    pictures.add(sand.time(), sand.pictures());
    sand.write_windows(run.folder().file("mass_flow.csv"));
  };
  const double end = parameters.longest_time;
  if (!run.advance(stage,
                   {{every_time(end / parameters.output.n_samples), add_row}, // the flow ends by what a sample says
                    {every_steps(steps_between_looks), look_at_step},
                    {either(every_time(end / std::max(1u, parameters.output.n_pictures - 1)), at_the_end()), draw}}))
    return run.stop();
  return run.finish(summary(), {"hourglass/plot.py", "energy.py"});
}

Summary HourglassRun::summary() const
{
  RunFigures own = run.figures(sand.n_grains());
  own.time_step_s = parameters.simulation.time_step;
  Summary summary;
  summary.set("model", std::string("hourglass"));
  sand.add_figures(summary, own);
  return summary;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(argc, argv,
                    {"hourglass",
                     "Lets sand run through an hourglass of triangles: mass flow, Beverloo's law beside it, "
                     "and what the glass weighs while it runs."},
                    [](const CommandLine &command_line)
                    { return run_job<HourglassParameters, HourglassRun>("Sand in an hourglass", command_line); });
}
