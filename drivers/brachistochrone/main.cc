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
      : parameters(p), run(command_line, {"slides on a brachistochrone", parameter_text, p.output.snapshot_interval,
                                          {"slides", "slides.csv"}}),
        all(p.slides()), figures(all.size())
  {
    run.keep([this](StateVisitor &v) { visit(v); });
  }

  int go();

private:
  void visit(StateVisitor &visit);
  void begin_slide();
  bool go_down();
  void write_table() const;
  Summary summary() const;

  const SlideParameters &parameters;
  Run run;
  std::vector<SlideSettings> all;
  std::vector<SlideFigures> figures; // of those that are done
  std::int64_t present = 0;          // the one that goes on
  std::unique_ptr<Slide> slide;
  std::unique_ptr<PictureSeries> pictures;
  StableStepWatch stable_step{"Output/time step"};
};

std::string name_of(const SlideSettings &settings)
{
  return (settings.curve == Curve::plane ? "plane_" : "cycloid_") + std::to_string(settings.n_facets);
}

void Slides::begin_slide()
{
  slide = std::make_unique<Slide>(parameters, all[present]);
  pictures = std::make_unique<PictureSeries>(run.folder().path() / "slides" / name_of(all[present]));
}

void Slides::visit(StateVisitor &visit)
{
  visit("present", present);
  for (std::int64_t k = 0; k < present; ++k)
    for (const auto &[name, value] : figures[k].list())
      visit("done/" + std::to_string(k) + "/" + name, *value);
  stable_step.visit(visit);
  if (visit.is_reading())
    begin_slide();
  slide->visit(visit);
  pictures->visit(visit);
}

int Slides::go()
{
  for (const SlideSettings &settings : all)
    steps_over({"the way down", Slide(parameters, settings).exact_travel_time()},
               {"Output/time step", parameters.simulation.time_step}); // or refused
  run.open();
  const auto n_slides = static_cast<std::int64_t>(all.size());
  for (; present < n_slides; ++present)
  {
    if (run.loop().begins_stage() || !slide)
      begin_slide();
    if (!go_down())
      return run.stop();
    figures[present] = slide->figures();
    write_table();
  }
  return run.finish(summary(), {"brachistochrone/plot.py"});
}

bool Slides::go_down()
{
  const std::filesystem::path folder = run.folder().path() / "slides" / name_of(all[present]);
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "history.csv";
  const Table table = slide->table();
  History history = run.loop().begins_stage() ? History(file, table.names())
                                              : History::continued(file, table.names(), run.loop().last_time());
  dem::Simulation &grains = slide->grains();
  const double expected = slide->exact_travel_time();
  Stage stage;
  stage.name = name_of(all[present]);
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
  const auto times = [&](const auto n) { return either(every_time(expected / n), at_the_end()); };
  return run.advance(stage, {{every_steps(steps_between_looks), [&] { slide->look(); }},
                             {times(parameters.output.n_samples), add_row},
                             {times(std::max(1u, parameters.output.n_pictures - 1)),
                              [&] { pictures->add(slide->time(), pictures_of(&grains, nullptr)); }}});
}

void Slides::write_table() const
{
  std::vector<std::string> names{"cycloid", "facets"};
  for (const std::string &name : names_of(SlideFigures().list()))
    names.push_back(name);
  std::vector<std::vector<double>> rows;
  for (std::int64_t k = 0; k <= present; ++k)
  {
    rows.push_back({all[k].curve == Curve::cycloid ? 1. : 0., static_cast<double>(all[k].n_facets)});
    SlideFigures f = figures[k];
    for (const double value : values_of(f.list()))
      rows.back().push_back(value);
  }
  write_csv(run.folder().file("slides.csv"), names, rows);
}

Summary Slides::summary() const
{
  RunFigures f = run.figures(1);
  f.time_step_s = parameters.simulation.time_step;
  f.stable_time_step_s = stable_step.smallest();
  for (const SlideFigures &slide : figures)
  {
    f.steps += static_cast<std::int64_t>(slide.n_steps);
    f.energy_residual = std::max(f.energy_residual, slide.energy_residual);
    f.undecided_contacts += static_cast<std::int64_t>(slide.n_undecided);
    f.max_overlap_over_radius = std::max(f.max_overlap_over_radius, slide.largest_overlap / parameters.radius);
  }
  Summary summary;
  summary.set("model", std::string(parameters.friction > 0. ? "rolling sphere" : "sliding sphere"));
  summary.set(f);
  add_slides(summary, all, figures);
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
