#include "drivers/common/run/flow_sample.h"

#include "dem/measure/contact_list.h"
#include "drivers/common/csv_table.h"
#include "drivers/common/run/measured_columns.h"

#include <algorithm>

namespace bergamo::driver
{

void FlowSample::look(const dem::Simulation &grains, const double time, const dem::Throughput &removed)
{
  energy = grains.energy();
  residual.add(energy.balance(), energy.gravity_work);
  loads_ = grains.surface_loads();
  record_.look(time, grains.particles, removed);
  const double overlap = dem::largest_relative_overlap(grains.contacts, grains.particles);
  dem::check_overlap(overlap, time, "a smaller Output/time step");
  largest_overlap_ = std::max(largest_overlap_, overlap);
}

void FlowSample::look_at_step(const dem::Simulation &grains)
{
  stable_step_ = std::min(stable_step_, grains.stable_time_step());
}

std::vector<Column> FlowSample::columns(const std::vector<std::string> &names) const
{
  Table table(record_.columns());
  table.add(columns_of(energy));
  table.add({{"energy_residual_J", [this] { return residual.present(); }}});
  table.add(columns_of(loads_, names));
  return table.columns();
}

void FlowSample::visit(StateVisitor &visit)
{
  visit("flow/stable_step", stable_step_);
  visit("flow/largest_overlap", largest_overlap_);
  record_.visit(visit);
  residual.visit(visit);
}

void write_windows(const std::filesystem::path &path, const dem::MassFlow &flow)
{
  std::vector<std::vector<double>> rows;
  const double length = flow.windows.empty() ? 0. : (flow.end - flow.begin) / static_cast<double>(flow.windows.size());
  for (const double of_window : flow.windows)
  {
    const double begin = flow.begin + length * static_cast<double>(rows.size());
    rows.push_back({begin, begin + length, of_window});
  }
  write_csv(path, {"begin_s", "end_s", "mass_flow_kg_s"}, rows);
}

} // namespace bergamo::driver
