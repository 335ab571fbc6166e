#include "drivers/silo_discharge/discharge.h"

#include "dem/io/grain_points_vtu.h"
#include "dem/io/grid_vtu.h"
#include "dem/measure/contact_list.h"
#include "drivers/common/run/measured_columns.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/silo_discharge/filling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bergamo::driver
{
namespace
{

constexpr std::size_t floor_surface = 4; // of the silo's surfaces

dem::OutletParameters outlet_of(const SiloParameters &p)
{
  dem::OutletParameters outlet;
  outlet.region = dem::HalfSpace{Vec3::UnitZ(), -p.outlet_depth};
  outlet.step_interval = static_cast<int>(std::max(1., std::round(p.outlet_interval / p.simulation.time_step)));
  return outlet;
}

void write_field(const dem::HexahedronGrid &grid, const std::vector<Vec3> &velocity,
                 const std::vector<double> &solid_fraction, const std::filesystem::path &path)
{
  const dem::NodeField fields[] = {{"velocity", std::span<const Vec3>(velocity)},
                                   {"solid_fraction", std::span<const double>(solid_fraction)}};
  dem::write_grid_vtu(grid, fields, path);
}

} // namespace

Discharge::Discharge(const SiloParameters &p, const std::size_t number)
    : parameters(p), orifice(number), outlet(outlet_of(p)), record(dem::HalfSpace{Vec3::UnitZ(), 0.}),
      velocity(p.field_grid())
{
  f.width = p.orifice_widths.at(orifice);
  f.stable_step = std::numeric_limits<double>::infinity();
}

void Discharge::open(std::unique_ptr<dem::Simulation> filled)
{
  simulation = std::move(filled);
  simulation->change(parameters.discharge_simulation());
  for (std::size_t k = 0; k <= orifice; ++k)
    simulation->remove_surface(floor_surface + 1);
  simulation->reset_accounts();
  start_time = simulation->time;
  const dem::Particles &grains = simulation->particles;
  start_mass = std::accumulate(grains.mass.begin(), grains.mass.end(), 0.);
  start_heights.resize(grains.size());
  for (std::size_t i = 0; i < grains.size(); ++i)
    start_heights[grains.id[i]] = grains.position[i].z();
}

double Discharge::fraction() const
{
  return std::min(1., std::max(time() / parameters.discharge_time, discharged_share() / parameters.last_discharged));
}

bool Discharge::is_over() const
{
  return time() >= parameters.discharge_time || discharged_share() >= parameters.last_discharged ||
         record.quiet_time() >= parameters.patience;
}

void Discharge::compute()
{
  outlet.act(*simulation);
  simulation->compute_forces();
  simulation->kick();
}

void Discharge::look()
{
  energy = simulation->energy();
  residual.add(energy.balance(), energy.gravity_work);
  loads = simulation->surface_loads();
  for (; loads.size() > floor_surface + 1; loads.pop_back()) // of wider orifices, which are floor now
  {
    loads[floor_surface].force += loads.back().force;
    loads[floor_surface].moment += loads.back().moment;
  }
  record.look(time(), simulation->particles, outlet.passed());
  const double share = discharged_share();
  if (share >= parameters.steady_from && share <= parameters.steady_until)
    velocity.add_velocities(simulation->particles);
  const double overlap = dem::largest_relative_overlap(simulation->contacts, simulation->particles);
  dem::check_overlap(overlap, time(), "a smaller Output/time step");
  f.largest_overlap_over_radius = std::max(f.largest_overlap_over_radius, overlap);
}

void Discharge::look_at_step()
{
  f.stable_step = std::min(f.stable_step, simulation->stable_time_step());
}

std::vector<Picture> Discharge::pictures() const
{
  const auto draw_grains = [this](const std::filesystem::path &path)
  {
    std::vector<double> heights;
    for (const std::int64_t id : simulation->particles.id)
      heights.push_back(start_heights[id]);
    const dem::GrainField fields[] = {{"start_height", heights}};
    dem::write_grain_points_vtu(simulation->particles, fields, path);
  };
  const auto draw_field = [this](const std::filesystem::path &path)
  {
    dem::GridFit now(velocity.grid());
    now.add_velocities(simulation->particles);
    write_field(now.grid(), now.solve().value_or(std::vector<Vec3>(now.grid().n_nodes(), Vec3::Zero())),
                now.solid_fraction(), path);
  };
  return {{"grains", draw_grains}, picture_of_surfaces(*simulation), {"velocity", draw_field}};
}

Table Discharge::table() const
{
  Table table{{{"time_s", [this] { return time(); }}}};
  table.add(record.columns());
  table.add(columns_of(energy));
  table.add({{"energy_residual_J", [this] { return residual.present(); }}});
  table.add(columns_of(loads, open_surface_names(parameters)));
  return table;
}

dem::MassFlow Discharge::steady_flow() const
{
  return dem::mass_flow(record.times(), record.masses(),
                        {parameters.steady_from * start_mass, parameters.steady_until * start_mass},
                        parameters.n_windows);
}

const DischargeFigures &Discharge::figures()
{
  const dem::MassFlow flow = steady_flow();
  f.mass_flow = flow.mean;
  f.mass_flow_deviation = flow.deviation;
  f.steady_begin = flow.begin;
  f.steady_end = flow.end;
  f.duration = time();
  f.discharged_mass = record.mass();
  f.discharged_grains = static_cast<double>(record.n_grains());
  f.grains_left = static_cast<double>(start_heights.size()) - f.discharged_grains;
  f.stopped_by_itself = record.quiet_time() >= parameters.patience;
  f.n_steps = std::round(time() / parameters.simulation.time_step);
  f.energy_residual = residual.relative();
  f.n_undecided = static_cast<double>(simulation->contacts.n_undecided());
  return f;
}

void Discharge::write(const std::filesystem::path &folder) const
{
  const dem::MassFlow flow = steady_flow();
  std::vector<std::vector<double>> windows;
  const double length = (flow.end - flow.begin) / parameters.n_windows;
  for (const double of_window : flow.windows)
  {
    const double begin = flow.begin + length * static_cast<double>(windows.size());
    windows.push_back({begin, begin + length, of_window});
  }
  write_csv(folder / "mass_flow.csv", {"begin_s", "end_s", "mass_flow_kg_s"}, windows);
  if (const auto mean = velocity.solve())
  {
    write_field(velocity.grid(), *mean, velocity.solid_fraction(), folder / "mean_velocity.vtu");
    write_profiles(*mean, folder / "profiles.csv");
  }
}

/// In the middle between front and back, at the grid's nodes.
void Discharge::write_profiles(const std::vector<Vec3> &mean, const std::filesystem::path &path) const
{
  const dem::HexahedronGrid &grid = velocity.grid();
  std::vector<std::vector<double>> rows;
  for (const double height : parameters.profile_heights)
    for (std::int32_t i = 0; i <= grid.n_cells[0]; ++i)
    {
      const Vec3 place(grid.node(i).x(), 0., height);
      const Vec3 v = dem::value_at(grid, mean, place);
      rows.push_back({height, place.x(), v.x(), v.y(), v.z()});
    }
  write_csv(path, {"height_m", "x_m", "velocity_x_m_s", "velocity_y_m_s", "velocity_z_m_s"}, rows);
}

void Discharge::visit(StateVisitor &visit)
{
  for (const auto &[name, value] : f.list())
    visit("figures/" + name, *value);
  visit("start_time", start_time);
  visit("start_mass", start_mass);
  visit("start_heights", start_heights);
  visit("outlet", outlet);
  visit("velocity", velocity);
  record.visit(visit);
  residual.visit(visit);
  if (auto read = visit_grains(visit, simulation.get(), parameters.discharge_simulation()))
    simulation = std::move(read);
}

} // namespace bergamo::driver
