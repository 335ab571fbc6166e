#include "dem/simulation.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "dem/motion/leapfrog.h"
#include "dem/motion/rotation.h"
#include "dem/motion/stable_step.h"
#include "dem/neighbour/spatial_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace bergamo::dem
{
namespace
{

template <class T>
void permute(std::vector<T> &values, const std::vector<std::int32_t> &order)
{
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const std::int32_t old : order)
    sorted.push_back(values[old]);
  values = std::move(sorted);
}

} // namespace

void SimulationParameters::validate() const
{
  grain.validate();
  wall.validate();
  contact.validate();
  require(friction >= 0. && std::isfinite(friction), "friction coefficient", friction, "at least 0");
  require(wall_friction >= 0. && std::isfinite(wall_friction), "wall friction coefficient", wall_friction,
          "at least 0");
  require(damping_ratio >= 0. && std::isfinite(damping_ratio), "damping ratio", damping_ratio, "at least 0");
  require(relaxation_time >= 0. && std::isfinite(relaxation_time), "viscoelastic relaxation time", relaxation_time,
          "at least 0 [s]");
  require(time_step > 0. && std::isfinite(time_step), "time step", time_step, "positive [s]");
  require(verlet_distance > 0. && verlet_distance <= 2., "Verlet distance", verlet_distance,
          "in (0, 2] mean bounding radii");
  require(sort_interval >= 1, "interval of sorting", sort_interval, "at least 1 renewal of the neighbours");
  require(gravity.allFinite(), "gravity", gravity.norm(), "finite [m/s^2]");
}

Simulation::Simulation(const SimulationParameters &parameters) : p(parameters)
{
  p.validate();
  pair_law = {elastic_pair(p.grain, p.grain), p.friction, p.damping_ratio, p.relaxation_time};
  wall_law = {elastic_pair(p.grain, p.wall), p.wall_friction, p.damping_ratio, p.relaxation_time};
}

std::unique_ptr<Simulation> Simulation::empty(const SimulationParameters &parameters)
{
  return std::unique_ptr<Simulation>(new Simulation(parameters));
}

Simulation::Simulation(const SimulationParameters &parameters, Particles new_particles,
                       std::vector<PlaneWall> new_walls)
    : Simulation(parameters)
{
  particles = std::move(new_particles);
  walls = std::move(new_walls);
  if (particles.size() == 0)
    throw ConfigError("a simulation needs at least one grain");
  std::vector<double> radii = particles.bounding_radius;
  std::sort(radii.begin(), radii.end()); // so that the sum does not depend on the order in which the grains came
  const double mean_radius = std::accumulate(radii.begin(), radii.end(), 0.) / particles.size();
  h.verlet_distance = p.verlet_distance * mean_radius;
  index_of_id.resize(particles.size());
  if (particles.cell.is_periodic())
    check_cell();
  sort_by_place();
  h.start_potential = gravity_potential();
}

void Simulation::change(const SimulationParameters &parameters)
{
  parameters.validate();
  p.friction = parameters.friction;
  p.wall_friction = parameters.wall_friction;
  p.damping_ratio = parameters.damping_ratio;
  p.relaxation_time = parameters.relaxation_time;
  p.time_step = parameters.time_step;
  p.contact = parameters.contact;
  pair_law.friction = p.friction;
  wall_law.friction = p.wall_friction;
  pair_law.damping_ratio = wall_law.damping_ratio = p.damping_ratio;
  pair_law.relaxation_time = wall_law.relaxation_time = p.relaxation_time;
  refresh_contacts(); // the last drift was made with the old step
}

double Simulation::contact_range() const
{
  return 2. * *std::max_element(particles.bounding_radius.begin(), particles.bounding_radius.end()) + h.verlet_distance;
}

void Simulation::check_cell() const
{
  const auto refuse = [](const std::string &what) { throw ConfigError("a periodic cell " + what); };
  if (!walls.empty())
    refuse("has no walls, but " + std::to_string(walls.size()) + " were given: leave them out");
  if (p.gravity != Vec3::Zero())
    refuse("would fall for ever: set gravity to zero");
  if (particles.cell.edges.minCoeff() < 2. * contact_range())
    refuse("of edge " + std::to_string(particles.cell.edges.minCoeff()) +
           " m is too small: a grain would touch another "
           "one twice; it needs at least two ranges of contacts, " +
           std::to_string(2. * contact_range()) + " m: make it larger or the grains smaller");
}

void Simulation::return_to_cell()
{
  const PeriodicCell &cell = particles.cell;
  if (cell.edges.minCoeff() < 2. * contact_range())
    throw RunError("the periodic cell has shrunk to an edge of " + std::to_string(cell.edges.minCoeff()) +
                   " m at time " + std::to_string(time) + " s, less than two ranges of contacts, " +
                   std::to_string(2. * contact_range()) + " m: begin with a larger cell or load it less");
  h.cell_work.sum += dem::return_to_cell(particles);
}

void Simulation::rebuild_neighbours()
{
  check_finite(); // places that are no numbers have no cell
  if (particles.cell.is_periodic())
    return_to_cell();
  h.edges_when_built = particles.cell.edges;
  const BoundingSpheres spheres{particles.position, particles.bounding_radius, particles.mass};
  pairs.renew(build_verlet_list(spheres, h.verlet_distance, particles.cell), particles);
  wall_contacts.renew(particles, walls, h.verlet_distance);
  h.position_when_built = particles.position;
  h.look_at_motion = particles.largest_motion + 0.5 * h.verlet_distance;
  h.wall_motion_when_built.clear();
  for (const PlaneWall &wall : walls)
    h.wall_motion_when_built.push_back(wall.motion);
  ++n_rebuilds;
}

bool Simulation::grains_left_their_neighbours()
{
  double limit = 0.5 * h.verlet_distance;
  if (particles.cell.is_periodic())
    limit -= 0.5 * (particles.cell.edges - h.edges_when_built).norm();
  if (particles.largest_motion < h.look_at_motion)
    return false;
  Collected<double> squares;
  parallel_ranges(particles.size(), 1024,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    double most = 0.;
                    for (std::size_t i = begin; i < end; ++i)
                      most = std::max(most, (particles.position[i] - h.position_when_built[i]).squaredNorm());
                    squares.of(part).push_back(most);
                  });
  double largest_square = 0.;
  squares.for_each([&](const double square) { largest_square = std::max(largest_square, square); });
  const double largest = std::sqrt(largest_square);
  h.look_at_motion = particles.largest_motion + (limit - largest);
  return largest > limit;
}

void Simulation::sort_by_place()
{
  check_finite(); // places that are no numbers have no cell
  const double largest = *std::max_element(particles.bounding_radius.begin(), particles.bounding_radius.end());
  const std::vector<std::int32_t> order = spatial_order(particles.position, largest);
  permute(particles.id, order);
  permute(particles.shape, order);
  permute(particles.mass, order);
  permute(particles.inertia, order);
  permute(particles.bounding_radius, order);
  permute(particles.position, order);
  permute(particles.orientation, order);
  permute(particles.velocity, order);
  permute(particles.angular_momentum, order);
  permute(particles.angular_velocity, order);
  permute(particles.force, order);
  permute(particles.torque, order);
  if (!particles.external_force.empty())
    permute(particles.external_force, order);
  permute(particles.weight, order);
  permute(particles.motion, order);
  if (!h.external_work.empty())
    permute(h.external_work, order);
  if (!h.last_external_force.empty())
    permute(h.last_external_force, order);
  pairs.reorder(order, particles);
  wall_contacts.reorder(order);
  for (std::size_t i = 0; i < particles.size(); ++i)
    index_of_id[particles.id[i]] = static_cast<std::int32_t>(i);
  h.n_rebuilds_when_sorted = n_rebuilds;
  rebuild_neighbours();
}

void Simulation::remove_wall(const std::int32_t index)
{
  h.removed_wall_work += walls[index].work;
  wall_contacts.remove_wall(index);
  walls.erase(walls.begin() + index);
  rebuild_neighbours();
}

void Simulation::refresh_contacts()
{
  pairs.refresh(particles);
  wall_contacts.refresh();
}

void Simulation::compute_forces()
{
  bool wall_moved = false;
  for (std::size_t w = 0; w < walls.size(); ++w)
    wall_moved = wall_moved || walls[w].motion - h.wall_motion_when_built[w] > 0.5 * h.verlet_distance;
  Stopwatch watch;
  if (wall_moved || grains_left_their_neighbours())
  {
    if (n_rebuilds - h.n_rebuilds_when_sorted >= p.sort_interval)
      sort_by_place();
    else
      rebuild_neighbours();
  }
  watch.lap(times.neighbours);

  pairs.compute(particles, pair_law, p.contact, p.time_step, times);
  watch.restart();
  wall_contacts.compute(particles, walls, wall_law, p.contact, p.time_step);
  watch.lap(times.walls);
  sum_contact_forces();
  if (particles.cell.is_periodic())
    h.cell_work.book_contacts(particles.cell, pairs.virial().image.cwiseQuotient(particles.cell.edges), p.time_step);
  watch.lap(times.summation);
}

void Simulation::sum_contact_forces()
{
  parallel_for(particles.size(),
               [&](const std::size_t i)
               {
                 BodyLoad load;
                 pairs.add_load(i, load);
                 wall_contacts.add_load(i, load);
                 particles.force[i] = load.force.head<3>();
                 particles.torque[i] = load.torque.head<3>();
               });
}

void Simulation::integrate()
{
  Stopwatch watch;
  const double dt = p.time_step;
  if (!particles.external_force.empty() || !h.last_external_force.empty())
    book_external_work();
  if (particles.cell.is_periodic())
    h.cell_work.begin_kick(particles, dt);
  if (!advance(particles, {p.gravity, stretching(particles.cell)}, dt))
    report_divergence();
  if (particles.cell.is_periodic())
  {
    h.cell_work.end_kick(particles, dt);
    particles.cell.advance(dt);
    particles.largest_motion += 0.5 * dt * particles.cell.rate.norm();
  }
  const ContactLosses &lost = pairs.losses, &wall_lost = wall_contacts.losses;
  if (!std::isfinite(lost.friction + lost.viscous + lost.curvature + wall_lost.friction + wall_lost.viscous +
                     wall_lost.curvature))
    throw RunError("the run diverged: the energy lost in contacts is not finite at time " + std::to_string(time) +
                   " s; choose a smaller time step (stable estimate in summary.json) or start from the last snapshot");
  for (PlaneWall &wall : walls)
  {
    wall.point += dt * wall.velocity;
    wall.motion += dt * wall.velocity.norm();
  }
  time += dt;
  ++n_steps;
  watch.lap(times.motion);
}

void Simulation::book_external_work()
{
  h.external_work.resize(particles.size(), 0.);
  h.last_external_force.resize(particles.size(), Vec3::Zero());
  const bool acts = !particles.external_force.empty();
  parallel_for(particles.size(),
               [&](const std::size_t i)
               {
                 const Vec3 external = acts ? particles.external_force[i] : Vec3(Vec3::Zero());
                 h.external_work[i] +=
                     0.5 * p.time_step * (h.last_external_force[i] + external).dot(particles.velocity[i]);
                 h.last_external_force[i] = external;
               });
  if (!acts)
    h.last_external_force.clear();
}

void Simulation::rest()
{
  std::fill(particles.velocity.begin(), particles.velocity.end(), Vec3::Zero());
  std::fill(particles.angular_momentum.begin(), particles.angular_momentum.end(), Vec3::Zero());
  std::fill(particles.angular_velocity.begin(), particles.angular_velocity.end(), Vec3::Zero());
  refresh_contacts(); // the last drift is not known any more
}

void Simulation::reset_accounts()
{
  pairs.losses = wall_contacts.losses = {};
  for (PlaneWall &wall : walls)
    wall.work = 0.;
  h.removed_wall_work = 0.;
  h.cell_work.sum = h.cell_work.half_kick = 0.;
  std::fill(h.external_work.begin(), h.external_work.end(), 0.);
  h.start_potential = gravity_potential();
}

double Simulation::gravity_potential() const
{
  double sum = 0.;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (!particles.is_fixed(i))
      sum -= particles.weight[i] * particles.mass[i] * p.gravity.dot(particles.position[i]);
  return sum;
}

GrainEnergy Simulation::energy() const
{
  GrainEnergy e;
  const double dt = p.time_step;
  const AccelerationField acting{p.gravity, stretching(particles.cell)};
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (particles.is_fixed(i))
      continue;
    const double mass = particles.weight[i] * particles.mass[i];
    const Vec3 &v = particles.velocity[i];
    Vec3 force = particles.force[i];
    if (!particles.external_force.empty())
      force += particles.external_force[i];
    const Vec3 next = v + dt * (force / mass + acting.at(particles.position[i]));
    const Vec3 &momentum = particles.angular_momentum[i];
    const Vec3 next_momentum = momentum + dt / particles.weight[i] * particles.torque[i];
    const Mat3 rotation = particles.orientation[i].toRotationMatrix();
    e.kinetic +=
        0.5 * mass * v.dot(next) +
        0.5 * particles.weight[i] * momentum.dot(angular_velocity(rotation, particles.inertia[i], next_momentum));
    if (h.external_work.empty())
      continue;
    e.external_work += h.external_work[i];
    if (!particles.external_force.empty() && !h.last_external_force.empty())
      e.external_work += 0.5 * dt * (h.last_external_force[i] + particles.external_force[i]).dot(v);
  }
  for (const auto &stored : {pairs.total_energy(), wall_contacts.total_energy()})
  {
    e.normal += stored.normal;
    e.tangential += stored.tangential;
  }
  for (const auto &lost : {pairs.losses, wall_contacts.losses})
  {
    e.friction_loss += lost.friction;
    e.viscous_loss += lost.viscous;
    e.curvature_work += lost.curvature;
  }
  e.wall_work = h.removed_wall_work;
  for (const PlaneWall &wall : walls)
    e.wall_work += wall.work;
  e.gravity_work = h.start_potential - gravity_potential();
  e.cell_work = h.cell_work.at_this_step(particles, dt);
  return e;
}

double Simulation::stable_time_step() const
{
  return dem::stable_time_step(particles, pairs.touching(particles), pair_law, wall_contacts, wall_law, p.time_step);
}

void Simulation::check_finite() const
{
  Collected<std::size_t> diverged;
  parallel_ranges(particles.size(), 256,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t i = begin; i < end; ++i)
                      if (!particles.position[i].allFinite() || !particles.velocity[i].allFinite() ||
                          !particles.angular_momentum[i].allFinite() || !particles.angular_velocity[i].allFinite() ||
                          !particles.orientation[i].coeffs().allFinite())
                        diverged.of(part).push_back(i);
                  });
  diverged.for_each([&](const std::size_t i) { throw_diverged(i, "whose state is not finite"); });
}

void Simulation::report_divergence() const
{
  check_finite();
  // All states were finite: forces are not.
  std::size_t worst = 0;
  double largest = -1.;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    Vec3 force = particles.force[i];
    if (!particles.external_force.empty())
      force += particles.external_force[i];
    if (!force.allFinite() || !particles.torque[i].allFinite())
      throw_diverged(i, "on which the force is not finite");
    const double acceleration = force.stableNorm() / particles.mass[i];
    if (acceleration > largest)
    {
      largest = acceleration;
      worst = i;
    }
  }
  throw_diverged(worst, "on which the force is too large");
}

void Simulation::throw_diverged(const std::size_t i, const char *trouble) const
{
  std::ostringstream message;
  message << "the run diverged: grain " << particles.id[i];
  if (particles.position[i].allFinite())
    message << " at (" << particles.position[i].transpose() << ") m";
  else if (i < h.position_when_built.size())
    message << ", last seen at (" << h.position_when_built[i].transpose() << ") m,";
  message << ' ' << trouble << ", at time " << time << " s, step " << n_steps
          << "; choose a smaller time step (stable estimate in summary.json) or start from the last snapshot";
  throw RunError(message.str());
}

} // namespace bergamo::dem
