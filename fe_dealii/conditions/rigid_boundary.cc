#include "fe_dealii/conditions/rigid_boundary.h"

#include "dem/core/error.h"
#include "fe_dealii/material/elastic_parameters.h"

#include <cmath>
#include <string>

namespace bergamo::fe
{
namespace
{

using Vector = RigidBoundary::Vector;

Vector cross(const Vector &a, const Vector &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector minus(const Vector &a, const Vector &b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector place_of(const MovingBody &body, const unsigned int node)
{
  Vector place = body.node_position()[node];
  for (std::size_t i = 0; i < 3; ++i)
    place[i] += body.displacement()[3 * std::size_t(node) + i];
  return place;
}

/// Of the rigid body and the nodes that it takes, as they lie now.
RigidInertia inertia_of_both(const MovingBody &body, const std::span<const unsigned int> nodes,
                             const RigidBodyParameters &own)
{
  RigidInertia both;
  both.mass = own.mass;
  for (int i = 0; i < 3; ++i)
    both.centre[i] = own.mass * own.centre[i];
  for (const unsigned int node : nodes)
  {
    const double mass = body.mass()[3 * std::size_t(node)];
    both.mass += mass;
    for (int i = 0; i < 3; ++i)
      both.centre[i] += mass * place_of(body, node)[i];
  }
  for (double &component : both.centre)
    component /= both.mass;
  both.add_point(own.mass, minus(own.centre, both.centre));
  for (int i = 0; i < 3; ++i)
    both.inertia[i][i] += own.inertia[i];
  for (const unsigned int node : nodes)
    both.add_point(body.mass()[3 * std::size_t(node)], minus(place_of(body, node), both.centre));
  return both;
}

/// Throws ConfigError for nodes that are none or held by others.
std::span<const unsigned int> checked(const MovingBody &body, const std::span<const unsigned int> nodes)
{
  if (nodes.empty())
    throw ConfigError("rigid body: it has no nodes; name a boundary or nodes of the mesh");
  for (const unsigned int node : nodes)
    for (unsigned int i = 0; i < 3; ++i)
      if (node >= body.n_nodes() || body.constraint_of(3 * std::size_t(node) + i))
        throw ConfigError("rigid body: node " + std::to_string(node) +
                          (node < body.n_nodes()
                               ? " is held by another condition; prescribe the rigid body first, "
                                 "or leave the node out"
                               : " does not exist; the mesh has " + std::to_string(body.n_nodes()) + " nodes"));
  return nodes;
}

} // namespace

void RigidBodyParameters::validate() const
{
  const auto require = [](const bool holds, const char *name, const double value, const char *rule)
  { require_parameter(holds, "rigid body", name, value, rule); };
  require(mass >= 0 && std::isfinite(mass), "mass [kg]", mass, "give zero or a positive number");
  for (int i = 0; i < 3; ++i)
  {
    require(std::isfinite(centre[i]), "centre [m]", centre[i], "give a number");
    require(inertia[i] >= 0 && std::isfinite(inertia[i]), "inertia [kg m^2]", inertia[i],
            "give zero or a positive number");
  }
}

RigidBoundary::RigidBoundary(MovingBody &body, const std::span<const unsigned int> nodes,
                             const RigidBodyParameters &parameters)
    : body(body), parameters((parameters.validate(), parameters)), nodes(nodes.begin(), nodes.end()),
      next_(inertia_of_both(body, checked(body, nodes), parameters))
{
  const Vector &centre = next_.inertia().centre;
  own_centre = minus(parameters.centre, centre);
  for (const unsigned int node : nodes)
  {
    arm.push_back(minus(place_of(body, node), centre));
    const unsigned int alone[] = {node};
    for (unsigned int i = 0; i < 3; ++i)
      constraints.push_back(body.prescribe_velocity(alone, i));
  }
  body.make_rigid(nodes);
  next_.guide = parameters.guide;
  now = next_.motion();
  step_of_next = static_cast<double>(body.n_steps());
}

void RigidBoundary::begin(const double dt)
{
  require(dt > 0 && std::isfinite(dt), "rigid body: the time step", dt, "a positive number of seconds");
  now = present();
  step_of_next = static_cast<double>(body.n_steps() + 1);
  gather_forces();
  next_.motion() = now;
}

void RigidBoundary::gather_forces()
{
  force_ = moment_ = {};
  for (const unsigned int node : nodes)
  {
    const Vector drag = body.drag(node);
    Vector force, from_centre;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t dof = 3 * std::size_t(node) + i;
      force[i] = body.external_force()[dof] + body.weight(dof) - body.internal_force()[dof] -
                 body.damping() * body.mass()[dof] * body.velocity()[dof] - drag[i];
      from_centre[i] = body.node_position()[node][i] + body.displacement()[dof] - now.centre[i];
    }
    const Vector turn = cross(from_centre, force);
    for (int i = 0; i < 3; ++i)
    {
      force_[i] += force[i];
      moment_[i] += turn[i];
    }
  }
}

void RigidBoundary::advance(const double dt)
{
  next_.drift(dt);
  // To where the rigid motion brings them, so that distances keep to rounding.
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    const Vector target = next_.place_of(arm[k]), here = place_of(body, nodes[k]);
    for (std::size_t i = 0; i < 3; ++i)
      body.set_velocity(constraints[3 * k + i], (target[i] - here[i]) / dt);
  }
}

void RigidBoundary::prescribe(const Vector &velocity, const Vector &angular_velocity, const double dt)
{
  begin(dt);
  next_.prescribe(velocity, angular_velocity, dt);
  advance(dt);
}

void RigidBoundary::move(const Vector &force, const Vector &moment, const double dt)
{
  begin(dt);
  const Vector own_arm = minus(next_.place_of(own_centre), now.centre);
  Vector weight, total_force, total_moment;
  for (int i = 0; i < 3; ++i)
    weight[i] = parameters.mass * body.gravity()[i];
  const Vector own_moment = cross(own_arm, weight);
  for (int i = 0; i < 3; ++i)
  {
    total_force[i] = force_[i] + weight[i] + force[i];
    total_moment[i] = moment_[i] + own_moment[i] + moment[i];
  }
  next_.kick(total_force, total_moment, body.kick_time(dt), dt);
  advance(dt);
}

double RigidBoundary::kinetic_energy() const
{
  const RigidMotion::Motion &motion = next_.motion();
  const Vector velocity = next_.velocity_of(own_centre);
  double energy = 0;
  for (int i = 0; i < 3; ++i)
  {
    double in_body = 0; // spin about the body's own axes
    for (int j = 0; j < 3; ++j)
      in_body += motion.rotation[j][i] * motion.spin[j];
    energy += 0.5 * parameters.mass * velocity[i] * velocity[i] + 0.5 * parameters.inertia[i] * in_body * in_body;
  }
  return energy;
}

std::vector<std::pair<std::string, std::span<double>>> RigidBoundary::state()
{
  using Motion = RigidMotion::Motion;
  static_assert(sizeof(Motion) % sizeof(double) == 0);
  constexpr std::size_t size = sizeof(Motion) / sizeof(double);
  return {{"rigid_motion", {reinterpret_cast<double *>(&now), size}},
          {"rigid_motion_next", {reinterpret_cast<double *>(&next_.motion()), size}},
          {"rigid_step_of_next", {&step_of_next, 1}}};
}

} // namespace bergamo::fe
