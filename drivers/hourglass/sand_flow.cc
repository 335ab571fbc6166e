#include "drivers/hourglass/sand_flow.h"

#include "dem/io/vtu.h"
#include "dem/measure/beverloo.h"
#include "dem/measure/inertial_number.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/packing_target.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/visit_models.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace bergamo::driver
{
namespace
{

constexpr dem::BeverlooLaw usual_law{.c = 0.58, .k = 1.4}; // of circular orifices (Nedderman 1992)
constexpr double full_part = 0.5;                          // of the cone, from the neck, that is full while sand flows

} // namespace

SandFlow::SandFlow(const HourglassParameters &p) : parameters(p), flow(dem::HalfSpace{Vec3::UnitZ(), 0.}) {}

bool SandFlow::begin()
{
  dem::Surface glass = make_glass(parameters.glass);
  dem::PackingParameters packing = parameters.packing();
  packing.tightening.is_stopped = interrupted;
  dem::PackedGrains packed = parameters.sizes.pack(
      chamber_between(parameters.glass, parameters.fill_bottom, parameters.fill_height), packing, parameters.seed);
  if (interrupted())
    return false;
  require_target(packed, packing.solid_fraction, "Filling/solid fraction");
  simulation = std::make_unique<dem::Simulation>(parameters.simulation_parameters(), std::move(packed.particles),
                                                 std::vector<dem::PlaneWall>());
  simulation->add_surface(std::move(glass));
  const dem::Particles &grains = simulation->particles;
  mass = std::accumulate(grains.mass.begin(), grains.mass.end(), 0.);
  start_heights.resize(grains.size());
  for (std::size_t i = 0; i < grains.size(); ++i)
    start_heights[grains.id[i]] = grains.position[i].z();
  return true;
}

double SandFlow::fraction() const
{
  return std::min(1., std::max(time() / parameters.longest_time, passed_share() / parameters.last_discharged));
}

bool SandFlow::is_over() const
{
  return time() >= parameters.longest_time || passed_share() >= parameters.last_discharged ||
         flow.record().quiet_time() >= parameters.patience;
}

/// Mass of the grains in the full part of the cone [kg].
double SandFlow::above_neck() const
{
  const dem::Particles &grains = simulation->particles;
  double above = 0.;
  for (std::size_t i = 0; i < grains.size(); ++i)
    if (grains.position[i].z() > 0. && grains.position[i].z() < full_part * parameters.glass.cone_height())
      above += grains.mass[i];
  return above;
}

void SandFlow::look()
{
  flow.look(*simulation, time());
  load_share = -flow.loads().front().force.z() / (mass * parameters.gravity);
  if (!parameters.steady.contains(passed_share()))
    return;
  n_steady += 1.;
  sum_of_load_shares += load_share;
  sum_of_masses += above_neck();
}

std::vector<Picture> SandFlow::pictures() const
{
  const auto draw_grains = [this](const std::filesystem::path &path)
  {
    std::vector<double> heights;
    for (const std::int64_t id : simulation->particles.id)
      heights.push_back(start_heights[id]);
    const dem::GrainField fields[] = {{"start_height", heights}};
    constexpr int coarse = 4; // steps a quarter turn
    dem::write_grains_vtu(simulation->particles, fields, path, coarse);
  };
  return {{"grains", draw_grains}, picture_of_surfaces(*simulation)};
}

Table SandFlow::table() const
{
  Table table{{{"time_s", [this] { return time(); }}, {"load_over_weight", [this] { return load_share; }}}};
  table.add(flow.columns({"glass"}));
  return table;
}

dem::MassFlow SandFlow::steady_flow() const
{
  return dem::mass_flow(flow.record().times(), flow.record().masses(), parameters.steady.span(mass),
                        parameters.steady.n_windows);
}

void SandFlow::add_figures(Summary &summary, RunFigures run) const
{
  run.steps = simulation->n_steps;
  run.stable_time_step_s = flow.stable_step();
  run.energy_residual = flow.energy_residual();
  run.undecided_contacts = simulation->contacts.n_undecided();
  run.max_overlap_over_radius = flow.largest_overlap();
  const dem::MassFlow steady = steady_flow();
  summary.set(run);
  summary.set("mass_kg", mass, "kg");
  summary.set("discharge_time_s", time(), "s");
  summary.set("discharged_mass_kg", flow.record().mass(), "kg");
  summary.set("stopped_by_itself", flow.record().quiet_time() >= parameters.patience);
  summary.set("mass_flow_kg_s", steady.mean, "kg/s");
  summary.set("mass_flow_deviation_kg_s", steady.deviation, "kg/s");
  if (n_steady == 0.)
    return;
  const double full_height = full_part * parameters.glass.cone_height();
  const dem::BeverlooScale scale{sum_of_masses / n_steady / chamber_between(parameters.glass, 0., full_height).volume(),
                                 parameters.gravity, dem::mean_grain(simulation->particles).diameter, 0.};
  summary.set("load_over_weight", sum_of_load_shares / n_steady);
  summary.set("bulk_density_kg_m3", scale.bulk_density, "kg/m3");
  summary.set("usual_beverloo_flow_kg_s", usual_law.flow(2. * parameters.glass.neck_radius, scale), "kg/s");
}

void SandFlow::visit(StateVisitor &visit)
{
  std::int64_t is_packed = simulation != nullptr;
  visit("is_packed", is_packed);
  if (is_packed == 0)
    return;
  visit("start_heights", start_heights);
  visit("mass", mass);
  visit("n_steady", n_steady);
  visit("sum_of_load_shares", sum_of_load_shares);
  visit("sum_of_masses", sum_of_masses);
  flow.visit(visit);
  if (auto read = visit_grains(visit, simulation.get(), parameters.simulation_parameters()))
    simulation = std::move(read);
}

} // namespace bergamo::driver
