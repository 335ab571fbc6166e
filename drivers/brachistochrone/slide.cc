#include "drivers/brachistochrone/slide.h"

#include "dem/core/error.h"
#include "drivers/brachistochrone/track.h"
#include "drivers/common/run/visit_models.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace bergamo::driver
{
namespace
{

constexpr double patience = 3.; // in times of the closed form, until a sphere is given up

std::unique_ptr<dem::Simulation> start(const SlideParameters &p, const Path &path, const int n_facets)
{
  dem::Superquadric sphere;
  sphere.half_axes = Vec3::Constant(p.radius);
  sphere.eps1 = sphere.eps2 = 1.;
  dem::Particles grains;
  grains.add(sphere, p.simulation.grain().density, path.at(0.), Quaternion::Identity());
  const dem::SimulationParameters parameters = p.simulation_parameters();
  grains.velocity[0] = -0.5 * parameters.time_step * parameters.gravity; // half a step before it is at rest
  auto simulation = std::make_unique<dem::Simulation>(parameters, std::move(grains), std::vector<dem::PlaneWall>());
  simulation->add_surface(make_track(path, n_facets, p.radius));
  return simulation;
}

} // namespace

Slide::Slide(const SlideParameters &p, const SlideSettings &settings)
    : parameters(p), path(make_path(settings.curve, p.end())), exact_time(path->travel_time(p.effective_gravity())),
      simulation(start(p, *path, settings.n_facets))
{
  f.exact_travel_time = exact_time;
  f.stable_step = std::numeric_limits<double>::infinity();
}

Vec3 Slide::exact_centre() const
{
  return path->at(time() / exact_time);
}

void Slide::look()
{
  if (has_arrived())
    return;
  const double end = parameters.run;
  f.n_steps = static_cast<double>(simulation->n_steps);
  f.n_undecided = static_cast<double>(simulation->contacts.n_undecided());
  if (centre().x() >= end)
  {
    const double share = (end - last_centre.x()) / (centre().x() - last_centre.x());
    f.travel_time = last_time + share * (time() - last_time);
    return;
  }
  if (time() > patience * exact_time)
    throw RunError("the sphere has not reached the end of the track after " + std::to_string(time()) +
                   " s, for which it takes " + std::to_string(exact_time) +
                   " s in closed form: give more Track/facets, or less damping");
  last_centre = centre();
  last_time = time();

  const double distance = path->distance(centre(), time() / exact_time);
  f.distance_above = std::max(f.distance_above, distance);
  f.distance_below = std::max(f.distance_below, -distance);
  if (time() <= exact_time)
  {
    const Vec3 difference = centre() - exact_centre();
    f.x = std::max(f.x, std::abs(difference.x()));
    f.z = std::max(f.z, std::abs(difference.z()));
  }
  ++n_looks;
  if (simulation->contacts.n_touching_walls() == 0)
    ++n_airborne;
  f.airborne = static_cast<double>(n_airborne) / static_cast<double>(n_looks);
  for (const dem::TouchingContact &contact : simulation->contacts.touching_walls(simulation->particles))
    f.largest_overlap_over_radius = std::max(f.largest_overlap_over_radius, contact.state.overlap / parameters.radius);
}

void Slide::look_at_energy()
{
  energy = simulation->energy();
  residual.add(energy.balance(), energy.gravity_work);
  f.energy_residual = residual.relative();
  f.stable_step = std::min(f.stable_step, simulation->stable_time_step());
}

Table Slide::table() const
{
  return {{{"time_s", [this] { return time(); }},
           {"x_m", [this] { return centre().x(); }},
           {"z_m", [this] { return centre().z(); }},
           {"exact_x_m", [this] { return exact_centre().x(); }},
           {"exact_z_m", [this] { return exact_centre().z(); }},
           {"distance_from_path_m", [this] { return path->distance(centre(), time() / exact_time); }},
           {"touching", [this] { return static_cast<double>(simulation->contacts.n_touching_walls()); }},
           {"energy_kinetic_J", [this] { return energy.kinetic; }},
           {"energy_elastic_J", [this] { return energy.normal + energy.tangential; }},
           {"energy_friction_loss_J", [this] { return energy.friction_loss; }},
           {"energy_viscous_loss_J", [this] { return energy.viscous_loss; }},
           {"energy_gravity_work_J", [this] { return energy.gravity_work; }},
           {"energy_residual_J", [this] { return residual.present(); }}}};
}

void Slide::visit(StateVisitor &visit)
{
  for (const auto &[name, value] : f.list())
    visit("figures/" + name, *value);
  visit("last_centre", last_centre);
  visit("last_time", last_time);
  visit("n_looks", n_looks);
  visit("n_airborne", n_airborne);
  residual.visit(visit);
  if (auto read = visit_grains(visit, simulation.get(), parameters.simulation_parameters()))
    simulation = std::move(read);
}

} // namespace bergamo::driver
