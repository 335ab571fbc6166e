#include "dem/simulation/simulation.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "dem/core/state.h"
#include "dem/motion/leapfrog.h"
#include "dem/motion/stable_step.h"
#include "dem/neighbour/spatial_order.h"
#include "dem/neighbour/verlet_distance.h"
#include "dem/simulation/cell_rules.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bergamo::dem
{

Simulation::Simulation(const SimulationParameters &parameters, Particles new_particles,
                       std::vector<PlaneWall> new_walls)
    : particles(std::move(new_particles)), walls(std::move(new_walls)), contacts(parameters.materials.n_pairs()),
      p(parameters)
{
  p.validate();
  particles.look_at_weights();
  if (particles.size() == 0)
    throw ConfigError("the number of grains is 0: a simulation needs at least one grain");
  particles.check(p.materials.size());
  particles.cell.validate();
  for (const PlaneWall &wall : walls)
    wall.validate(p.materials.size());
  laws = contact_laws(p.materials);
  last_step = p.time_step; // velocities are those of half a step before
  next_id = 1 + *std::max_element(particles.id.begin(), particles.id.end());
  set_range();
  if (particles.cell.is_periodic())
    check_cell();
  sort_by_place();
  accounts.start_potential = gravity_potential(particles, p.gravity);
}

Simulation::Simulation(const SimulationParameters &parameters, StateReader &reader)
    : contacts(parameters.materials.n_pairs()), p(parameters)
{
  visit_state(*this, reader);
  p.validate();
  laws = contact_laws(p.materials);
  index.follow(particles.id);
}

void Simulation::change(const SimulationParameters &parameters)
{
  parameters.validate();
  const MaterialTable &old = p.materials, &now = parameters.materials;
  require(now.size() == old.size(), "number of materials of a simulation that goes on", now.size(),
          "as at its start, " + std::to_string(old.size()) + ": begin a new simulation");
  for (std::int32_t m = 0; m < now.size(); ++m)
    require(now[m].young_modulus == old[m].young_modulus && now[m].poisson_ratio == old[m].poisson_ratio &&
                now[m].density == old[m].density,
            "Young's modulus, Poisson's ratio or density of a material of a simulation that goes on: modulus",
            now[m].young_modulus, "as at its start: begin a new simulation for another material");
  require_gravity_fits(particles.cell, parameters.gravity);
  accounts.start_potential +=
      gravity_potential(particles, parameters.gravity) - gravity_potential(particles, p.gravity);
  const bool has_other_range = parameters.verlet_distance != p.verlet_distance;
  p = parameters;
  laws = contact_laws(p.materials);
  refresh_contacts(); // which are due may be judged otherwise
  if (!has_other_range)
    return;
  set_range();
  renew_neighbours();
}

void Simulation::set_range()
{
  watch.verlet_distance = verlet_distance_of(particles, p.verlet_distance);
}

void Simulation::check_cell() const
{
  require_walls_fit(particles.cell, walls);
  require_gravity_fits(particles.cell, p.gravity);
  const double least = least_cell_edge(particles, watch.verlet_distance);
  if (const double edge = particles.cell.edges.minCoeff(); edge < least)
    throw ConfigError("a periodic cell of edge " + std::to_string(edge) +
                      " m is too small: a grain would touch another "
                      "one twice; it needs at least two ranges of contacts, " +
                      std::to_string(least) + " m: make it larger or the grains smaller");
}

void Simulation::renew_neighbours()
{
  check_finite(); // places that are no numbers have no cell
  if (particles.cell.is_periodic())
  {
    const double least = least_cell_edge(particles, watch.verlet_distance);
    if (const double edge = particles.cell.edges.minCoeff(); edge < least)
      throw RunError("the periodic cell has shrunk to an edge of " + std::to_string(edge) + " m at time " +
                     std::to_string(time) + " s, less than two ranges of contacts, " + std::to_string(least) +
                     " m: begin with a larger cell or load it less");
    accounts.cell_work.sum += return_to_cell(particles);
  }
  contacts.renew(particles, walls, surfaces, {watch.verlet_distance});
  watch.take_all(particles, walls, surfaces);
  ++n_renewals;
}

/// The neighbours of those particles alone that have left theirs or will soon.
void Simulation::renew_strayed()
{
  check_finite(); // places that are no numbers have no cell
  const std::vector<std::uint8_t> strayed = watch.take_strayed(particles);
  const std::vector<Vec3> places = watch.part_places(particles);
  contacts.renew(particles, walls, surfaces, {watch.verlet_distance, places, strayed});
  ++n_renewals;
}

void Simulation::sort_by_place()
{
  check_finite(); // places that are no numbers have no cell
  const double largest = *std::max_element(particles.bounding_radius.begin(), particles.bounding_radius.end());
  take_order(spatial_order(particles.position, largest));
  n_renewals_when_sorted = n_renewals;
  renew_neighbours();
}

void Simulation::announce_moving() const
{
  if (before_moving)
    before_moving();
}

/// Takes the order of the particles, order[new] = old, of those that stay; the neighbours must be renewed afterwards.
void Simulation::take_order(const std::vector<std::int32_t> &order)
{
  announce_moving();
  const std::size_t n_parts = particles.parts.size();
  const std::vector<std::int32_t> part_order = particles.reorder(order);
  accounts.reorder(order);
  contacts.reorder(part_order, n_parts);
  index.follow(particles.id);
}

void Simulation::compute_forces()
{
  if (forces_are_known)
    return; // history of contacts and works advance once a step
  Stopwatch watch_of_phases;
  if (watch.must_renew(particles, walls, surfaces))
  {
    if (n_renewals - n_renewals_when_sorted >= p.sort_interval)
      sort_by_place();
    else if (watch.must_renew_all(particles, walls, surfaces))
      renew_neighbours();
    else
      renew_strayed();
  }
  watch_of_phases.lap(times.neighbours);

  contacts.compute(particles, walls, {laws, p.contact, last_step, surfaces}, times);
  watch_of_phases.restart();
  const std::vector<const LoadSums *> sums = contacts.load_sums();
  const bool are_weighted = particles.are_weighted();
  const auto load_of = [&](const std::size_t body)
  {
    BodyLoad load;
    for (const LoadSums *sum : sums)
      sum->add_load(body, load);
    return load;
  };
  parallel_for(particles.size(),
               [&](const std::size_t i)
               {
                 const BodyLoad load = load_of(i);
                 particles.force[i] = load.force.head<3>();
                 particles.torque[i] = load.torque.head<3>();
                 if (!are_weighted)
                   return;
                 BodyLoad transfer;
                 for (const LoadSums *sum : sums)
                   sum->add_transfer(i, transfer);
                 particles.transfer_force[i] = transfer.force.head<3>();
                 particles.transfer_torque[i] = transfer.torque.head<3>();
               });
  for (std::size_t w = 0; w < walls.size(); ++w)
  {
    const Vec3 force = load_of(particles.size() + w).force.head<3>();
    const Vec3 old_force = std::exchange(walls[w].force, force);
    walls[w].work -= 0.5 * last_step * (old_force + force).dot(walls[w].drift_velocity);
  }
  load_surfaces();
  if (particles.cell.is_periodic())
    accounts.cell_work.book_contacts(particles.cell, contacts.virial().image.cwiseQuotient(particles.cell.edges),
                                     last_step);
  watch_of_phases.lap(times.summation);
  forces_are_known = true;
}

void Simulation::kick()
{
  compute_forces();
  for (const auto &[forces, what] : {std::pair(&particles.external_force, " external forces for "),
                                     std::pair(&particles.external_torque, " external torques for ")})
    if (!forces->empty() && forces->size() != particles.size())
      throw ConfigError("there are " + std::to_string(forces->size()) + what + std::to_string(particles.size()) +
                        " grains: give one each, or none");
}

void Simulation::drift()
{
  Stopwatch watch_of_phases;
  const auto [last, kick] = steps();
  const double dt = p.time_step;
  accounts.book_external_work(particles, last);
  accounts.step_change += step_change_here();
  const bool is_periodic = particles.cell.is_periodic();
  require_walls_fit(particles.cell, walls); // normals and rates may have been set
  if (is_periodic)
    accounts.cell_work.begin_kick(particles, last);
  if (!advance(particles, {p.gravity, stretching(particles.cell)}, kick, dt))
    report_divergence(particles, watch, now());
  if (is_periodic)
  {
    accounts.cell_work.end_kick(particles, dt);
    particles.cell.advance(kick, dt);
    particles.largest_motion += 0.5 * dt * particles.cell.rate.norm();
  }
  const ContactLosses lost = contacts.losses();
  if (!std::isfinite(lost.friction + lost.viscous + lost.curvature))
    throw RunError("the run diverged: the energy lost in contacts is not finite at time " + std::to_string(time) +
                   " s; choose a smaller time step (stable estimate in summary.json) or start from the last snapshot");
  move_walls(dt);
  move_surfaces(dt);
  time += dt;
  ++n_steps;
  last_step = dt;
  forces_are_known = false;
  watch_of_phases.lap(times.motion);
}

void Simulation::move_walls(const double dt)
{
  for (PlaneWall &wall : walls)
  {
    wall.drift_velocity = wall.velocity;
    wall.point += dt * wall.velocity;
    wall.motion += dt * wall.velocity.norm();
  }
  dem::check_finite(walls, now());
}

std::vector<std::vector<Vec3>> Simulation::forces_of_moving() const
{
  std::vector<bool> keeps_forces;
  for (const Surface &surface : surfaces)
    keeps_forces.push_back(surface.keeps_forces());
  return dem::node_forces(particles, contacts, surfaces, keeps_forces);
}

void Simulation::require_surface(const std::int32_t index, const char *what) const
{
  require(index >= 0 && index < static_cast<std::int32_t>(surfaces.size()), what, index,
          "that of one of the " + std::to_string(surfaces.size()) + " surfaces, counted from 0");
}

std::vector<Vec3> Simulation::node_forces(const std::int32_t surface) const
{
  require_surface(surface, "number of the surface whose forces are asked for");
  std::vector<bool> is_wanted(surfaces.size(), false);
  is_wanted[surface] = true;
  return std::move(dem::node_forces(particles, contacts, surfaces, is_wanted)[surface]);
}

std::vector<SurfaceLoad> Simulation::surface_loads() const
{
  return dem::surface_loads(particles, contacts, surfaces);
}

/// Forces of a surface that begins to move are those of this step.
void Simulation::move_surfaces(const double dt)
{
  if (std::any_of(surfaces.begin(), surfaces.end(),
                  [](const Surface &s) { return s.keeps_forces() && s.force.empty(); }))
  {
    std::vector<std::vector<Vec3>> forces = forces_of_moving();
    for (std::size_t s = 0; s < surfaces.size(); ++s)
      if (surfaces[s].force.empty())
        surfaces[s].force = std::move(forces[s]);
  }
  for (Surface &surface : surfaces)
    surface.advance(dt);
}

void Simulation::load_surfaces()
{
  if (std::none_of(surfaces.begin(), surfaces.end(), [](const Surface &s) { return s.keeps_forces(); }))
    return;
  std::vector<std::vector<Vec3>> forces = forces_of_moving();
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    surfaces[s].take_forces(std::move(forces[s]), last_step);
}

void Simulation::rest()
{
  std::fill(particles.velocity.begin(), particles.velocity.end(), Vec3::Zero());
  std::fill(particles.angular_momentum.begin(), particles.angular_momentum.end(), Vec3::Zero());
}

void Simulation::reset_accounts()
{
  contacts.open_accounts();
  for (PlaneWall &wall : walls)
    wall.work = 0.;
  for (Surface &surface : surfaces)
    surface.work = 0.;
  accounts.reset(gravity_potential(particles, p.gravity));
}

GrainEnergy Simulation::energy() const
{
  GrainEnergy e;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (!particles.is_fixed(i))
    {
      e.kinetic += kinetic_energy_of(i);
      e.external_work += accounts.external_work_on(particles, i, last_step);
    }
  const ContactEnergy stored = contacts.total_energy();
  e.normal = stored.normal;
  e.tangential = stored.tangential;
  const ContactLosses lost = contacts.losses();
  e.friction_loss = lost.friction;
  e.viscous_loss = lost.viscous;
  e.curvature_work = lost.curvature;
  e.search_work = lost.search;
  e.quadrature_work = lost.quadrature;
  e.wall_work = accounts.removed_wall_work;
  for (const PlaneWall &wall : walls)
    e.wall_work += wall.work;
  for (const Surface &surface : surfaces)
    e.wall_work += surface.work;
  e.gravity_work = accounts.start_potential - gravity_potential(particles, p.gravity);
  e.cell_work = accounts.cell_work.at_this_step(particles, last_step);
  e.exchanged = accounts.exchanged;
  e.step_change = accounts.step_change + 0.5 * step_change_here();
  return e;
}

double Simulation::kinetic_energy_of(const std::size_t i) const
{
  const AccelerationField acting{p.gravity, stretching(particles.cell)};
  return kinetic_energy(particles, i, acting.at(particles.position[i]), steps());
}

/// Work of a change of the time step at this step; half of it counts at the step itself.
double Simulation::step_change_here() const
{
  if (last_step == p.time_step)
    return 0.;
  const AccelerationField acting{p.gravity, stretching(particles.cell)};
  return ordered_sum(particles.size(), 0.,
                     [&](const std::size_t i) {
                       return particles.is_fixed(i)
                                  ? 0.
                                  : step_change_work(particles, i, acting.at(particles.position[i]), steps());
                     });
}

double Simulation::stable_time_step() const
{
  std::vector<TouchingContact> all = contacts.touching(particles);
  const std::vector<TouchingContact> with_walls = contacts.touching_walls(particles);
  all.insert(all.end(), with_walls.begin(), with_walls.end());
  return dem::stable_time_step(particles, all, laws, p.time_step);
}

void Simulation::check_finite() const
{
  dem::check_finite(particles, watch, now());
}

std::uint64_t state_hash(const Simulation &simulation)
{
  StateHash hash;
  Simulation::visit_state(simulation, hash);
  return hash.value();
}

} // namespace bergamo::dem
