#include "drivers/brachistochrone/report.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace bergamo::driver
{
namespace
{

std::vector<double> orders(const std::vector<double> &facets, const std::vector<double> &deviation)
{
  std::vector<double> orders;
  for (std::size_t k = 0; k + 1 < facets.size(); ++k)
    orders.push_back(std::log(deviation[k] / deviation[k + 1]) / std::log(facets[k + 1] / facets[k]));
  return orders;
}

void add_curve(Summary &summary, const std::vector<DoneSlide> &slides, const Curve curve)
{
  std::vector<double> facets, times, misses, distances, x, z;
  double exact = 0.;
  for (const auto &[settings, f] : slides)
    if (settings.curve == curve)
    {
      exact = f.exact_travel_time;
      facets.push_back(settings.n_facets);
      times.push_back(f.travel_time);
      misses.push_back(std::abs(f.travel_time - exact));
      distances.push_back(f.distance());
      x.push_back(f.x);
      z.push_back(f.z);
    }
  const std::string name = curve == Curve::plane ? "plane" : "cycloid";
  summary.set(name + "_exact_travel_time_s", exact, "s");
  summary.set(name + "_travel_times_s", times, "s");
  summary.set(name + "_distances_from_path_m", distances, "m");
  summary.set(name + "_x_differences_m", x, "m");
  summary.set(name + "_z_differences_m", z, "m");
  if (curve == Curve::plane) // what is left there does not come from the facets
    return;
  summary.set(name + "_distance_orders", orders(facets, distances));
  summary.set(name + "_z_difference_orders", orders(facets, z));
  summary.set(name + "_travel_time_orders", orders(facets, misses));
}

} // namespace

void write_slides(const std::filesystem::path &path, const std::vector<DoneSlide> &slides)
{
  std::vector<std::string> names{"cycloid", "facets"};
  for (const std::string &name : names_of(SlideFigures().list()))
    names.push_back(name);
  std::vector<std::vector<double>> rows;
  for (auto [settings, f] : slides)
  {
    rows.push_back({settings.curve == Curve::cycloid ? 1. : 0., static_cast<double>(settings.n_facets)});
    for (const double value : values_of(f.list()))
      rows.back().push_back(value);
  }
  write_csv(path, names, rows);
}

void visit_done(StateVisitor &visit, const std::vector<SlideSettings> &all, std::vector<DoneSlide> &done)
{
  auto n_done = static_cast<std::int64_t>(done.size());
  visit("n_done", n_done);
  if (visit.is_reading())
    for (std::int64_t k = 0; k < n_done; ++k)
      done.push_back({all.at(k), {}});
  for (DoneSlide &slide : done)
    for (const auto &[name, value] : slide.figures.list())
      visit("done/" + slide.settings.name() + "/" + name, *value);
}

void add_slides(Summary &summary, RunFigures run, const std::vector<DoneSlide> &slides)
{
  std::vector<double> facets;
  for (const auto &[settings, f] : slides)
  {
    run.steps += static_cast<std::int64_t>(f.n_steps);
    run.energy_residual = std::max(run.energy_residual, f.energy_residual);
    run.undecided_contacts += static_cast<std::int64_t>(f.n_undecided);
    run.max_overlap_over_radius = std::max(run.max_overlap_over_radius, f.largest_overlap_over_radius);
    if (settings.curve == Curve::plane)
      facets.push_back(settings.n_facets);
  }
  summary.set(run);
  summary.set("facets", facets);
  add_curve(summary, slides, Curve::plane);
  add_curve(summary, slides, Curve::cycloid);
}

} // namespace bergamo::driver
