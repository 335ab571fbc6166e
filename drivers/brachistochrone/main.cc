#include "drivers/brachistochrone/report.h"
#include "drivers/brachistochrone/slide.h"
#include "drivers/common/csv_table.h"
#include "drivers/common/driver_main.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/common/run/step_count.h"

#include <algorithm>

namespace
{

using namespace bergamo;
using namespace bergamo::driver;

constexpr std::int64_t steps_between_looks = 5; // at where the sphere is

/// All slides of a run, one after the other, each with a folder of its own for what is written of it.
class Slides
{
public:
  Slides(const SlideParameters &p, const CommandLine &command_line, const std::string &parameter_text)
      : parameters(p),
        run(command_line,
            {"slides on a brachistochrone", parameter_text, p.output.snapshot_interval, {"slides", "slides.csv"}}),
        all(p.slides())
  {
    run.keep([this](StateVisitor &v) { visit(v); });
  }

  int go();

private:
  std::filesystem::path folder() const { return run.folder().path() / "slides" / all[done.size()].name(); }
  void visit(StateVisitor &visit);
  void begin_slide();
  bool go_down();
  Summary summary() const;

  const SlideParameters &parameters;
  Run run;
  std::vector<SlideSettings> all;
  std::vector<DoneSlide> done;
  std::unique_ptr<Slide> slide;
  std::unique_ptr<PictureSeries> pictures;
  StableStepWatch stable_step{"Output/time step"};
};

void Slides::begin_slide()
{
  slide = std::make_unique<Slide>(parameters, all[done.size()]);
  pictures = std::make_unique<PictureSeries>(folder());
}

void Slides::visit(StateVisitor &visit)
{
  visit_done(visit, all, done);
  stable_step.visit(visit);
  if (visit.is_reading())
    begin_slide();
  slide->visit(visit);
  pictures->visit(visit);
}

int Slides::go()
{
  for (const Curve curve : {Curve::plane, Curve::cycloid})
    steps_over({"the way down", make_path(curve, parameters.end())->travel_time(parameters.effective_gravity())},
               {"Output/time step", parameters.simulation.time_step}); // or refused
  run.open();
  while (done.size() < all.size())
  {
    if (run.loop().begins_stage())
      begin_slide();
    if (!go_down())
      return run.stop();
    done.push_back({all[done.size()], slide->figures()});
    write_slides(run.folder().file("slides.csv"), done);
  }
  return run.finish(summary(), {"brachistochrone/plot.py"});
}

bool Slides::go_down()
{
  std::filesystem::create_directories(folder());
  const std::filesystem::path file = folder() / "history.csv";
  const Table table = slide->table();
  History history = run.history(table, file);
  dem::Simulation &grains = slide->grains();
  const double expected = slide->exact_travel_time();
  Stage stage;
  stage.name = all[done.size()].name();
  stage.n_particles = 1;
  stage.time = [&] { return slide->time(); };
  stage.is_last = [&] { return slide->has_arrived(); };
  stage.fraction = [&] { return std::min(1., slide->time() / expected); };
  stage.compute = [&]
  {
    grains.compute_forces();
    grains.kick();
  };
  stage.move = [&] { grains.drift(); };
  const auto add_row = [&]
  {
    slide->look_at_energy();
    history.append(table.row());
    stable_step.look(parameters.simulation.time_step, grains.stable_time_step(), run.progress());
  };
  const auto times = [&](const unsigned n) // the last of them when it has arrived, which is about then
  {
    return [every = every_time(expected / n), last = (1. - 0.5 / n) * expected](const Moment &now)
    { return now.is_last || (every(now) && now.time < last); };
  };
  const auto draw = [&] { pictures->add(slide->time(), pictures_of(&grains, nullptr)); };
  return run.advance(stage, {{every_steps(steps_between_looks), [&] { slide->look(); }},
                             {times(parameters.output.n_samples), add_row},
                             {times(std::max(1u, parameters.output.n_pictures - 1)), draw}});
}

Summary Slides::summary() const
{
  RunFigures own = run.figures(1);
  own.time_step_s = parameters.simulation.time_step;
  own.stable_time_step_s = stable_step.smallest();
  Summary summary;
  summary.set("model", std::string(parameters.friction > 0. ? "rolling sphere" : "sliding sphere"));
  add_slides(summary, own, done);
  return summary;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(
      argc, argv,
      {"brachistochrone",
       "Lets a sphere slide or roll down a plane and a brachistochrone made of flat facets: closed forms beside it."},
      [](const CommandLine &command_line)
      { return run_job<SlideParameters, Slides>("Spheres on a plane and on a brachistochrone", command_line); });
}
