#include "dem/core/error.h"
#include "dem/motion/rotation.h"
#include "dem/simulation/cell_rules.h"
#include "dem/simulation/simulation.h"

#include <string>
#include <utility>

/// Bodies that come and go while a simulation runs.
namespace bergamo::dem
{

void Simulation::remove_wall(const std::int32_t wall)
{
  require(wall >= 0 && wall < static_cast<std::int32_t>(walls.size()), "number of the wall to be removed", wall,
          "below the number of walls, counted from 0");
  accounts.removed_wall_work += walls[wall].work;
  for (const TouchingContact &contact : contacts.touching_walls(particles))
    if (contact.wall == wall)
      accounts.exchanged -= stored_energy(contact.state).normal; // what its tangential spring held counts as lost
  contacts.remove_wall(wall);
  walls.erase(walls.begin() + wall);
  renew_neighbours();
}

void Simulation::add_wall(const PlaneWall &wall)
{
  wall.validate(p.materials.size());
  std::vector<PlaneWall> all = walls;
  all.push_back(wall);
  require_walls_fit(particles.cell, all);
  walls = std::move(all);
  walls.back().drift_velocity.setZero();
  renew_neighbours();
}

void Simulation::add_surface(Surface surface)
{
  surface.validate(p.materials.size());
  require_no_cell_of_surfaces(particles.cell);
  surfaces.push_back(std::move(surface));
  renew_neighbours();
}

void Simulation::remove_surface(const std::int32_t index)
{
  require_surface(index, "number of the surface to be removed");
  accounts.removed_wall_work += surfaces[index].work;
  for (const TouchingContact &contact : contacts.touching_walls(particles))
    if (contact.feature >= 0 && feature_of(surfaces, contact.feature).surface == index)
      accounts.exchanged -= stored_energy(contact.state).normal; // as of a wall
  std::size_t first = 0;
  for (std::int32_t s = 0; s < index; ++s)
    first += surfaces[s].n_features();
  contacts.remove_features(static_cast<std::int32_t>(first), static_cast<std::int32_t>(surfaces[index].n_features()));
  surfaces.erase(surfaces.begin() + index);
  renew_neighbours();
}

Exchange Simulation::remove(const std::vector<std::int32_t> &leaving)
{
  const auto n = static_cast<std::int32_t>(particles.size());
  std::vector<std::int64_t> leaving_ids;
  for (const std::int32_t i : leaving)
  {
    require(i >= 0 && i < n, "index of the grain to be removed", i, "below the number of grains, counted from 0");
    leaving_ids.push_back(particles.id[i]);
  }
  if (leaving.empty())
    return {};
  compute_forces(); // may sort the grains
  std::vector<std::uint8_t> leaves(n, 0);
  for (const std::int64_t id : leaving_ids)
    leaves[index(id)] = 1;
  Exchange gone;
  std::vector<std::int32_t> staying;
  for (std::int32_t i = 0; i < n; ++i)
    if (!leaves[i])
      staying.push_back(i);
  if (staying.empty())
    throw RunError("all grains would be removed at time " + std::to_string(time) +
                   " s: a simulation needs at least one; end the run before");

  for (std::int32_t i = 0; i < n; ++i)
  {
    if (!leaves[i])
      continue;
    ++gone.n_particles;
    gone.ids.push_back(particles.id[i]);
    if (particles.is_fixed(i))
      continue;
    gone.mass += particles.mass[i];
    gone.momentum += particles.mass[i] * particles.velocity[i];
    accounts.exchanged += accounts.external_work_on(particles, i, last_step) - kinetic_energy_of(i);
    accounts.start_potential += particles.weight[i] * particles.mass[i] * p.gravity.dot(particles.position[i]);
  }
  for (const auto &some : {contacts.touching(particles), contacts.touching_walls(particles)})
    for (const TouchingContact &contact : some)
      if (leaves[contact.first] || (contact.second != no_grain && leaves[contact.second]))
        accounts.exchanged -= stored_energy(contact.state).normal; // tangentially it counts as lost
  take_order(staying);
  renew_neighbours();
  return gone;
}

void Simulation::change_weights(const std::span<const std::int32_t> indices, const std::span<const double> weights)
{
  bool has_changed = false; // a restarted run has its weights already, and must not search its contacts anew
  for (std::size_t k = 0; k < indices.size(); ++k)
  {
    const std::int32_t i = indices[k];
    const double change = weights[k] - particles.weight[i];
    if (change == 0.)
      continue;
    has_changed = true;
    particles.weight[i] = weights[k];
    if (particles.is_fixed(i))
      continue;
    const Vec3 spin = angular_velocity(particles.orientation[i].toRotationMatrix(), particles.inertia[i],
                                       particles.angular_momentum[i]);
    accounts.exchanged +=
        0.5 * change *
        (particles.mass[i] * particles.velocity[i].squaredNorm() + particles.angular_momentum[i].dot(spin));
    accounts.start_potential -= change * particles.mass[i] * p.gravity.dot(particles.position[i]);
  }
  if (has_changed)
    refresh_contacts();
}

Exchange Simulation::add(const Particles &added)
{
  added.check(p.materials.size());
  if (forces_are_known)
    throw ConfigError("grains are added between steps, not between the forces of a step and its drift");
  if (!added.external_force.empty() || !added.external_torque.empty() || added.are_weighted())
    throw ConfigError(
        "grains that are added bring no external forces, torques or transfers: set those of all grains afterwards");
  Exchange come;
  if (added.size() > 0)
    announce_moving();
  for (std::size_t i = 0; i < added.size(); ++i)
  {
    ++come.n_particles;
    come.ids.push_back(next_id);
    particles.append(added, i, next_id++);
    if (added.is_fixed(i))
      continue;
    const double mass = added.weight[i] * added.mass[i];
    come.mass += added.mass[i];
    come.momentum += added.mass[i] * added.velocity[i];
    // As energy() will find it, if nothing touches it before: after the kick of the field alone.
    accounts.exchanged += kinetic_energy_of(particles.size() - 1);
    accounts.start_potential -= mass * p.gravity.dot(added.position[i]);
  }
  if (come.n_particles == 0)
    return come;
  accounts.make_room(particles.size());
  index.follow(particles.id);
  set_range();
  renew_neighbours();
  return come;
}

} // namespace bergamo::dem
