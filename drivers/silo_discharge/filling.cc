#include "drivers/silo_discharge/filling.h"

#include "dem/core/error.h"
#include "dem/measure/inertial_number.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/packing_target.h"
#include "drivers/common/run/measured_columns.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/silo_discharge/silo_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace bergamo::driver
{
namespace
{

SiloSurfaces surfaces_of(const SiloParameters &p)
{
  return make_silo({p.width, p.depth, p.packing_height(), p.orifice_widths, p.triangle_size});
}

constexpr double full_share = 0.75; // of the mass, from below, over which the bulk density is taken

/// Below it lie the centres of so much mass [m].
double height_of(const dem::Particles &grains, const double mass)
{
  std::vector<std::pair<double, double>> by_height;
  for (std::size_t i = 0; i < grains.size(); ++i)
    by_height.emplace_back(grains.position[i].z(), grains.mass[i]);
  std::sort(by_height.begin(), by_height.end());
  double below = 0.;
  for (const auto &[height, of_grain] : by_height)
    if ((below += of_grain) >= mass)
      return height;
  return by_height.back().first;
}

} // namespace

bool Filling::begin()
{
  SiloSurfaces silo = surfaces_of(parameters);
  const Vec3 half(0.5 * parameters.width, 0.5 * parameters.depth, 0.);
  dem::PackingParameters packing = parameters.packing();
  packing.tightening.is_stopped = interrupted;
  dem::PackedGrains packed = parameters.sizes.pack(dem::Box{-half, half + parameters.packing_height() * Vec3::UnitZ()},
                                                   packing, parameters.seed);
  if (interrupted())
    return false;
  require_target(packed, packing.solid_fraction, "Filling/solid fraction");
  simulation = std::make_unique<dem::Simulation>(parameters.filling_simulation(), std::move(packed.particles),
                                                 std::vector<dem::PlaneWall>());
  for (dem::Surface &surface : silo.surfaces)
    simulation->add_surface(std::move(surface));
  return true;
}

/// Of the uppermost grains, to where they are expected to come to rest [s].
double Filling::fall_time() const
{
  return std::sqrt(2. * (parameters.packing_height() - parameters.fill_height) / parameters.gravity);
}

double Filling::fraction() const
{
  constexpr double to_rest = 3.; // in times of the fall
  return std::min(0.99, time() / (to_rest * fall_time() + 1e-3));
}

void Filling::look()
{
  const dem::MeanGrain grain = dem::mean_grain(simulation->particles);
  const double n = static_cast<double>(simulation->particles.size());
  kinetic_share = simulation->energy().kinetic / (n * grain.mass * parameters.gravity * grain.diameter);
  settled = time() > fall_time() && kinetic_share < parameters.rest_share;
  if (!settled && time() > parameters.longest_filling)
    throw RunError("the grains have not come to rest after Filling/longest time, " +
                   std::to_string(parameters.longest_filling) + " s: their mean kinetic energy is " +
                   std::to_string(kinetic_share) + " of weight times diameter; choose a larger Filling/rest share, " +
                   "damping ratio or longest time");
}

void Filling::measure()
{
  energy = simulation->energy();
  residual.add(energy.balance(), energy.gravity_work);
  loads = simulation->surface_loads();
}

FillingFigures Filling::figures() const
{
  const dem::Particles &grains = simulation->particles;
  FillingFigures f;
  f.n_grains = static_cast<double>(grains.size());
  f.mass = std::accumulate(grains.mass.begin(), grains.mass.end(), 0.);
  const double height = height_of(grains, full_share * f.mass);
  f.bulk_density = full_share * f.mass / (parameters.width * parameters.depth * height);
  for (std::size_t s = surfaces_of(parameters).first_plug - 1; s < loads.size(); ++s)
    f.floor_share -= loads[s].force.z() / (f.mass * parameters.gravity);
  f.duration = time();
  f.n_steps = static_cast<double>(simulation->n_steps);
  return f;
}

std::unique_ptr<dem::Simulation> Filling::take()
{
  simulation->drift();
  return std::move(simulation);
}

Table Filling::table() const
{
  Table table{{{"time_s", [this] { return time(); }}, {"kinetic_share", [this] { return kinetic_share; }}}};
  table.add(columns_of(energy));
  table.add({{"energy_residual_J", [this] { return residual.present(); }}});
  table.add(columns_of(loads, closed_surface_names(parameters)));
  return table;
}

void Filling::visit(StateVisitor &visit)
{
  std::int64_t is_settled = settled;
  visit("filling/is_settled", is_settled);
  settled = is_settled != 0;
  visit("filling/kinetic_share", kinetic_share);
  residual.visit(visit);
  if (auto read = visit_grains(visit, simulation.get(), parameters.filling_simulation()))
    simulation = std::move(read);
}

std::vector<std::string> closed_surface_names(const SiloParameters &p)
{
  return surfaces_of(p).names;
}

std::vector<std::string> open_surface_names(const SiloParameters &p)
{
  const SiloSurfaces silo = surfaces_of(p);
  return {silo.names.begin(), silo.names.begin() + static_cast<std::ptrdiff_t>(silo.first_plug)};
}

} // namespace bergamo::driver
