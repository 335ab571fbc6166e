#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "fe_dealii/moving_body.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bergamo::fe
{
namespace
{

// Sums over dofs are taken in blocks of this many nodes, then over the blocks in order: the same on any thread count.
constexpr std::size_t block_nodes = 512;

} // namespace

/// A kick between two steps.
struct MovingBody::Kick
{
  double before, after, time; // the steps, and over which the forces act [s]
  double half_damping;        // of a velocity, over half of the time [-]

  /// A node of absent elements alone has no mass and stays.
  double velocity_after(const double old, const double force, const double mass) const
  {
    if (mass == 0)
      return 0;
    return ((1 - half_damping) * old + time * force / mass) / (1 + half_damping);
  }
};

/// A node with dashpots after a kick.
struct MovingBody::Braked
{
  Dashpots::Vector velocity{}, drag{}; // [m/s], [N]
};

/// What nodes add to the accounts by a kick.
struct MovingBody::KickSums
{
  double kinetic = 0;
  Work before, after; // over the half steps around it
};

void MovingBody::Work::add(const Work &part)
{
  external += part.external;
  gravity += part.gravity;
  boundary += part.boundary;
  viscous += part.viscous;
  radiated += part.radiated;
  step_change += part.step_change;
}

void MovingBody::kick(const double dt)
{
  require(dt > 0 && std::isfinite(dt), name_ + ": the time step", dt, "a positive number of seconds");
  if (progress_.is_kicked != 0)
    throw RunError(name_ + ": kicked twice in one step; let a drift follow each kick");
  if (!dashpots_.empty())
    let_go_of_dashpots();
  const Kick kick{ledger_.last_step > 0 ? ledger_.last_step : dt, dt, kick_time(dt),
                  0.5 * forces_.damping * kick_time(dt)};
  kick_images(kick);
  const std::size_t n_blocks = (n_nodes() + block_nodes - 1) / block_nodes;
  std::vector<KickSums> sums(n_blocks);
  parallel_ranges(n_blocks, 1,
                  [&](std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t block = begin; block < end; ++block)
                      sums[block] =
                          kick_nodes(kick, block * block_nodes, std::min(n_nodes(), (block + 1) * block_nodes));
                  });
  KickSums total;
  for (const KickSums &block : sums)
  {
    total.kinetic += block.kinetic;
    total.before.add(block.before);
    total.after.add(block.after);
  }
  if (!std::isfinite(total.kinetic + total.after.external))
    report_endless_motion();
  ledger_.here = ledger_.ahead;
  ledger_.here.add(total.before);
  ledger_.ahead = ledger_.here;
  ledger_.ahead.add(total.after);
  ledger_.kinetic = total.kinetic;
  if (ledger_.last_step == 0)
    ledger_.initial =
        ledger_.kinetic + elements_->elastic_energy() + elements_->dissipated_energy() + elements_->stiffness_loss();
  ledger_.last_step = dt;
  progress_.is_kicked = 1;
}

MovingBody::KickSums MovingBody::kick_nodes(const Kick &kick, const std::size_t begin, const std::size_t end)
{
  const double half_step_before = ledger_.last_step > 0 ? 0.5 * kick.before : 0, half_step_after = 0.5 * kick.after;
  // Of v⁺ − v⁻, to what it would be between two steps like the one before, and like the one after; none where the steps
  // are alike.
  const double to_before = (kick.before - kick.time) / kick.time, to_after = (kick.time - kick.after) / kick.time;
  const bool changes = kick.before != kick.after;
  KickSums sums;
  for (std::size_t node = begin; node < end; ++node)
  {
    const bool is_braked = dashpots_.has(node), is_imaged = images_.has(node);
    const Braked braked = is_braked ? brake(kick, node) : Braked{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t dof = 3 * node + i;
      const double mass = mass_[dof], old = velocity_[dof];
      const double external = external_force_[dof], weight = gravitational_mass_[node] * forces_.gravity[i];
      const double held = is_braked ? held_force(dof) : 0, drag = braked.drag[i];
      const double force = external + weight - internal_force_[dof];
      const int constraint = constraint_of_dof_[dof];
      double fresh, damping, reaction = 0;
      if (constraint < 0 && !is_imaged)
      {
        fresh = is_braked ? braked.velocity[i] : kick.velocity_after(old, force, mass);
        damping = 0.5 * forces_.damping * mass * (old + fresh);
      }
      else
      {
        fresh = is_imaged ? imaged_velocity_[dof] : constraint_velocity_[constraint];
        damping = 0.5 * forces_.damping * mass * (old + fresh);
        reaction = mass * (fresh - old) / kick.time + damping + drag - force;
      }
      velocity_[dof] = fresh;
      reaction_force_[dof] = reaction;
      if (changes)
      {
        const double kinetic = 0.5 * mass * old * (fresh + to_before * (fresh - old));
        sums.kinetic += kinetic;
        sums.after.step_change += 0.5 * mass * (old + to_after * (fresh - old)) * fresh - kinetic;
      }
      else
        sums.kinetic += 0.5 * mass * old * fresh;
      const auto add = [&](Work &work, const double path)
      {
        work.external += external * path;
        work.gravity += weight * path;
        work.boundary += (reaction + held) * path;
        work.viscous += damping * path;
        work.radiated += drag * path;
      };
      add(sums.before, half_step_before * old);
      add(sums.after, half_step_after * fresh);
    }
  }
  return sums;
}

MovingBody::Braked MovingBody::brake(const Kick &kick, const std::size_t node) const
{
  Dashpots::Kick of_node;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t dof = 3 * node + i;
    const double force = external_force_[dof] + weight(dof) + held_force(dof) - internal_force_[dof];
    const int constraint = constraint_of_dof_[dof];
    of_node.old[i] = velocity_[dof];
    of_node.is_free[i] = constraint < 0;
    of_node.without[i] =
        constraint < 0 ? kick.velocity_after(velocity_[dof], force, mass_[dof]) : constraint_velocity_[constraint];
    of_node.inertia[i] = mass_[dof] * (1 + kick.half_damping) / kick.time;
  }
  Braked braked;
  braked.velocity = dashpots_.velocity_after(node, of_node);
  Dashpots::Vector mean;
  for (int i = 0; i < 3; ++i)
    mean[i] = 0.5 * (of_node.old[i] + braked.velocity[i]);
  braked.drag = dashpots_.drag(node, mean);
  return braked;
}

/// What images get by a kick. Their forces on one another are reactions, whose work on both is that of the faces.
void MovingBody::kick_images(const Kick &kick)
{
  for (const NodeImages::Group &group : images_.groups())
    for (std::size_t i = 0; i < 3; ++i)
    {
      double mass = 0, momentum = 0, pushed = 0, force = 0; // momenta of what they had, and of what faces give
      for (std::size_t k = 0; k < group.nodes.size(); ++k)
      {
        const std::size_t node = group.nodes[k], dof = 3 * node + i;
        mass += mass_[dof];
        momentum += mass_[dof] * velocity_[dof];
        pushed += mass_[dof] * group.shift[k][i] * face_velocity_[i];
        force += external_force_[dof] + weight(dof) - internal_force_[dof];
      }
      const int constraint = constraint_of_dof_[3 * std::size_t(group.nodes[0]) + i];
      const double first = constraint >= 0 ? constraint_velocity_[constraint]
                           : mass == 0     ? 0
                                           : kick.velocity_after(momentum / mass, force, mass) - pushed / mass;
      for (std::size_t k = 0; k < group.nodes.size(); ++k)
        imaged_velocity_[3 * std::size_t(group.nodes[k]) + i] = first + group.shift[k][i] * face_velocity_[i];
    }
}

} // namespace bergamo::fe
