#include "drivers/silo_discharge/report.h"

#include "dem/measure/beverloo.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace bergamo::driver
{
namespace
{

constexpr dem::BeverlooLaw usual_law{.c = 1.03, .k = 1.4};       // of slots and spheres (Nedderman 1992)
constexpr double choi_flow = 0.1411, dissertation_flow = 0.1326; // kg/s, Wellmann 3.5
constexpr std::size_t least_flows = 3;                           // for a fit of two constants

double mean_diameter(const SiloParameters &p)
{
  const dem::UniformSizes &sizes = p.sizes.uniform;
  return 0.5 * (sizes.smallest_diameter + sizes.largest_diameter);
}

void add_beverloo(Summary &summary, const std::vector<DischargeFigures> &discharges, const dem::BeverlooScale &scale)
{
  std::vector<double> widths, flows, usual;
  for (const DischargeFigures &f : discharges)
  {
    usual.push_back(usual_law.flow(f.width, scale));
    if (f.mass_flow <= 0.) // clogged at once
      continue;
    widths.push_back(f.width);
    flows.push_back(f.mass_flow);
  }
  summary.set("usual_beverloo_flows_kg_s", usual, "kg/s");
  if (widths.size() < least_flows)
    return;
  const dem::BeverlooLaw law = dem::fit_beverloo(widths, flows, scale);
  double miss = 0.;
  for (std::size_t k = 0; k < widths.size(); ++k)
    miss = std::max(miss, std::abs(law.flow(widths[k], scale) / flows[k] - 1.));
  summary.set("beverloo_c", law.c);
  summary.set("beverloo_k", law.k);
  summary.set("beverloo_largest_relative_miss", miss);
}

} // namespace

void write_discharges(const std::filesystem::path &path, std::vector<DischargeFigures> discharges)
{
  std::vector<std::vector<double>> rows;
  for (DischargeFigures &f : discharges)
    rows.push_back(values_of(f.list()));
  write_csv(path, names_of(DischargeFigures().list()), rows);
}

void visit_done(StateVisitor &visit, std::vector<DischargeFigures> &done)
{
  auto n_done = static_cast<std::int64_t>(done.size());
  visit("n_done", n_done);
  done.resize(n_done);
  for (std::int64_t k = 0; k < n_done; ++k)
    for (const auto &[name, value] : done[k].list())
      visit("done/" + std::to_string(k) + "/" + name, *value);
}

void add_discharges(Summary &summary, RunFigures run, FillingFigures filling,
                    const std::vector<DischargeFigures> &discharges, const SiloParameters &parameters)
{
  run.steps = static_cast<std::int64_t>(filling.n_steps);
  run.stable_time_step_s = std::numeric_limits<double>::infinity();
  std::vector<double> widths, flows, deviations, masses, times;
  for (const DischargeFigures &f : discharges)
  {
    run.steps += static_cast<std::int64_t>(f.n_steps);
    run.energy_residual = std::max(run.energy_residual, f.energy_residual);
    run.undecided_contacts += static_cast<std::int64_t>(f.n_undecided);
    run.max_overlap_over_radius = std::max(run.max_overlap_over_radius, f.largest_overlap_over_radius);
    run.stable_time_step_s = std::min(run.stable_time_step_s, f.stable_step);
    widths.push_back(f.width);
    flows.push_back(f.mass_flow);
    deviations.push_back(f.mass_flow_deviation);
    masses.push_back(f.discharged_mass);
    times.push_back(f.duration);
  }
  summary.set(run);
  for (const auto &[name, value] : filling.list())
    summary.set(name, *value);
  summary.set("orifice_widths_m", widths, "m");
  summary.set("mass_flows_kg_s", flows, "kg/s");
  summary.set("mass_flow_deviations_kg_s", deviations, "kg/s");
  summary.set("discharged_masses_kg", masses, "kg");
  summary.set("discharge_times_s", times, "s");
  if (parameters.has_choi_orifice())
  {
    summary.set("choi_mass_flow_kg_s", choi_flow, "kg/s");
    summary.set("dissertation_mass_flow_kg_s", dissertation_flow, "kg/s");
  }
  add_beverloo(summary, discharges,
               {filling.bulk_density, parameters.gravity, mean_diameter(parameters), parameters.depth});
}

} // namespace bergamo::driver
