#include "fe_dealii/conditions/rigid_boundary.h"

#include "dem/core/error.h"
#include "fe_dealii/material/elastic_parameters.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/physics/transformations.h>

#include <cmath>
#include <string>

namespace bergamo::fe
{
namespace
{

using Vector = RigidBoundary::Vector;
using Matrix = dealii::Tensor<2, 3>;
using Column = dealii::Tensor<1, 3>;

Column column(const Vector &v)
{
  Column result;
  for (int i = 0; i < 3; ++i)
    result[i] = v[i];
  return result;
}

Vector vector(const Column &v)
{
  return {v[0], v[1], v[2]};
}

Matrix matrix(const double (&m)[3][3])
{
  Matrix result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i][j] = m[i][j];
  return result;
}

void store(const Matrix &m, double (&result)[3][3])
{
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i][j] = m[i][j];
}

Vector cross(const Vector &a, const Vector &b)
{
  return vector(dealii::cross_product_3d(column(a), column(b)));
}

/// m (|a|² I − a ⊗ a).
Matrix inertia_of(const double mass, const Column &arm)
{
  Matrix result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i][j] = mass * ((i == j) * arm.norm_square() - arm[i] * arm[j]);
  return result;
}

/// Rotation by the vector's length [rad] about it.
Matrix rotation(const Column &turn)
{
  const double angle = turn.norm();
  Matrix identity;
  for (int i = 0; i < 3; ++i)
    identity[i][i] = 1;
  if (angle == 0)
    return identity;
  return dealii::Physics::Transformations::Rotations::rotation_matrix_3d(dealii::Point<3>(Column(turn / angle)), angle);
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
      mass_(parameters.mass)
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
  Column centre = parameters.mass * column(parameters.centre);
  for (const unsigned int node : nodes)
  {
    const double m = body.mass()[3 * std::size_t(node)];
    mass_ += m;
    centre += m * column(body.node_position()[node]);
  }
  centre /= mass_;
  next.centre = vector(centre);
  own_centre = vector(column(parameters.centre) - centre);
  Matrix sum = inertia_of(parameters.mass, column(parameters.centre) - centre);
  for (int i = 0; i < 3; ++i)
    sum[i][i] += parameters.inertia[i];
  for (const unsigned int node : nodes)
  {
    const Column to_node = column(body.node_position()[node]) - centre;
    arm.push_back(vector(to_node));
    sum += inertia_of(body.mass()[3 * std::size_t(node)], to_node);
    const unsigned int alone[] = {node};
    for (unsigned int i = 0; i < 3; ++i)
      constraints.push_back(body.prescribe_velocity(alone, i));
  }
  store(sum, inertia);
  now = next;
  step_of_next = static_cast<double>(body.n_steps());
}

void RigidBoundary::begin(const double dt)
{
  require(dt > 0 && std::isfinite(dt), "rigid body: the time step", dt, "a positive number of seconds");
  now = present();
  step_of_next = static_cast<double>(body.n_steps() + 1);
  gather_forces();
  next = now;
}

void RigidBoundary::gather_forces()
{
  force_ = moment_ = {};
  for (const unsigned int node : nodes)
  {
    Vector force, from_centre;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t dof = 3 * std::size_t(node) + i;
      force[i] = body.external_force()[dof] + body.weight(dof) - body.internal_force()[dof] -
                 body.damping() * body.mass()[dof] * body.velocity()[dof];
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
  const Matrix turned = rotation(dt * column(next.spin)) * matrix(now.rotation);
  store(turned, next.rotation);
  for (int i = 0; i < 3; ++i)
    next.centre[i] += dt * next.velocity[i];
  // To where the rigid motion brings them, so that distances keep to rounding.
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    const Column target = column(next.centre) + turned * column(arm[k]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t dof = 3 * std::size_t(nodes[k]) + i;
      const double here = body.node_position()[nodes[k]][i] + body.displacement()[dof];
      body.set_velocity(constraints[3 * k + i], (target[i] - here) / dt);
    }
  }
}

void RigidBoundary::prescribe(const Vector &velocity, const Vector &angular_velocity, const double dt)
{
  begin(dt);
  next.velocity = velocity;
  next.spin = angular_velocity;
  const Matrix halfway = rotation(0.5 * dt * column(next.spin)) * matrix(now.rotation);
  next.angular_momentum = vector(halfway * matrix(inertia) * transpose(halfway) * column(next.spin));
  advance(dt);
}

void RigidBoundary::move(const Vector &force, const Vector &moment, const double dt)
{
  const Matrix at_start = matrix(inertia);
  if (!(determinant(at_start) > 0))
    throw ConfigError("rigid body: its inertia is singular; give it one, or nodes that are not on a line");
  begin(dt);
  const double time = body.kick_time(dt);
  const Matrix r = matrix(now.rotation);
  const Column own_arm = r * column(own_centre);
  const Column weight = parameters.mass * column(body.gravity());
  const Column own_moment = dealii::cross_product_3d(own_arm, weight);
  for (int i = 0; i < 3; ++i)
  {
    next.velocity[i] += time / mass_ * (force_[i] + weight[i] + force[i]);
    next.angular_momentum[i] += time * (moment_[i] + own_moment[i] + moment[i]);
  }
  // The spin of the half step from the orientation of the half step: second order.
  const auto spin_at = [&](const Matrix &orientation)
  { return orientation * invert(at_start) * transpose(orientation) * column(next.angular_momentum); };
  const Column first = spin_at(r);
  next.spin = vector(spin_at(rotation(0.5 * dt * first) * r));
  advance(dt);
}

double RigidBoundary::kinetic_energy() const
{
  const Matrix r = matrix(next.rotation);
  const Column spin = column(next.spin);
  const Column velocity = column(next.velocity) + dealii::cross_product_3d(spin, r * column(own_centre));
  const Column in_body = transpose(r) * spin;
  double energy = 0.5 * parameters.mass * velocity.norm_square();
  for (int i = 0; i < 3; ++i)
    energy += 0.5 * parameters.inertia[i] * in_body[i] * in_body[i];
  return energy;
}

std::vector<std::pair<std::string, std::span<double>>> RigidBoundary::state()
{
  static_assert(sizeof(Motion) % sizeof(double) == 0);
  constexpr std::size_t size = sizeof(Motion) / sizeof(double);
  return {{"rigid_motion", {reinterpret_cast<double *>(&now), size}},
          {"rigid_motion_next", {reinterpret_cast<double *>(&next), size}},
          {"rigid_step_of_next", {&step_of_next, 1}}};
}

} // namespace bergamo::fe
