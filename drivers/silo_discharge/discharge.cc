#include "drivers/silo_discharge/discharge.h"

#include "dem/io/grain_points_vtu.h"
#include "dem/io/grid_vtu.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/silo_discharge/filling.h"

#include <algorithm>
#include <cmath>
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
  const dem::GridField fields[] = {{"velocity", std::span<const Vec3>(velocity)},
                                   {"solid_fraction", std::span<const double>(solid_fraction)}};
  dem::write_grid_vtu(grid, {.of_nodes = fields}, path);
}

} // namespace

Discharge::Discharge(const SiloParameters &p, const std::size_t number)
    : parameters(p), orifice(number), outlet(outlet_of(p)), flow(dem::HalfSpace{Vec3::UnitZ(), 0.}),
      velocity(p.field_grid())
{
  f.width = p.orifice_widths.at(orifice);
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
         flow.record().quiet_time() >= parameters.patience;
}

void Discharge::compute()
{
  outlet.act(*simulation);
  simulation->compute_forces();
  simulation->kick();
}

void Discharge::look()
{
  flow.look(*simulation, time(), outlet.passed());
  std::vector<dem::SurfaceLoad> &loads = flow.loads();
  for (; loads.size() > floor_surface + 1; loads.pop_back()) // of wider orifices, which are floor now
  {
    loads[floor_surface].force += loads.back().force;
    loads[floor_surface].moment += loads.back().moment;
  }
  if (parameters.steady.contains(discharged_share()))
    velocity.add_velocities(simulation->particles);
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
  table.add(flow.columns(open_surface_names(parameters)));
  return table;
}

dem::MassFlow Discharge::steady_flow() const
{
  return dem::mass_flow(flow.record().times(), flow.record().masses(), parameters.steady.span(start_mass),
                        parameters.steady.n_windows);
}

const DischargeFigures &Discharge::figures()
{
  const dem::MassFlow steady = steady_flow();
  f.mass_flow = steady.mean;
  f.mass_flow_deviation = steady.deviation;
  f.steady_begin = steady.begin;
  f.steady_end = steady.end;
  f.duration = time();
  f.discharged_mass = flow.record().mass();
  f.discharged_grains = static_cast<double>(flow.record().n_grains());
  f.grains_left = static_cast<double>(start_heights.size()) - f.discharged_grains;
  f.stopped_by_itself = flow.record().quiet_time() >= parameters.patience;
  f.n_steps = std::round(time() / parameters.simulation.time_step);
  f.stable_step = flow.stable_step();
  f.largest_overlap_over_radius = flow.largest_overlap();
  f.energy_residual = flow.energy_residual();
  f.n_undecided = static_cast<double>(simulation->contacts.n_undecided());
  return f;
}

void Discharge::write(const std::filesystem::path &folder) const
{
  write_windows(folder / "mass_flow.csv", steady_flow());
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
  visit("start_time", start_time);
  visit("start_mass", start_mass);
  visit("start_heights", start_heights);
  visit("outlet", outlet);
  visit("velocity", velocity);
  flow.visit(visit);
  if (auto read = visit_grains(visit, simulation.get(), parameters.discharge_simulation()))
    simulation = std::move(read);
}

} // namespace bergamo::driver
