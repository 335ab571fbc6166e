#include "fe_dealii/conditions/rigid_body.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>

namespace bergamo::fe
{

void RigidBodyShape::validate() const
{
  require(inertia.mass >= 0 && std::isfinite(inertia.mass), "rigid body: its mass", inertia.mass,
          "zero or a positive number of kilograms");
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    largest = std::max(largest, inertia.inertia[i][i]);
  for (int i = 0; i < 3; ++i)
  {
    require(std::isfinite(inertia.centre[i]), "rigid body: its centre", inertia.centre[i], "a number");
    require(std::isfinite(gravity[i]), "rigid body: gravity", gravity[i], "a number");
    for (int j = 0; j < 3; ++j)
      require(std::abs(inertia.inertia[i][j] - inertia.inertia[j][i]) <= 1e-12 * largest,
              "rigid body: a product of its inertia", inertia.inertia[i][j], "symmetric and finite");
    // The moments of a body obey the triangle's inequality.
    const double others = inertia.inertia[(i + 1) % 3][(i + 1) % 3] + inertia.inertia[(i + 2) % 3][(i + 2) % 3];
    require(inertia.inertia[i][i] >= 0 && inertia.inertia[i][i] <= others * (1 + 1e-12),
            "rigid body: a moment of its inertia", inertia.inertia[i][i],
            "zero or positive, and at most the sum of the other two");
  }
  for (const auto &vertex : vertices)
    for (const double x : vertex)
      require(std::isfinite(x), "rigid body: a vertex", x, "finite");
  for (const auto &triangle : triangles)
    for (const unsigned int vertex : triangle)
      if (vertex >= vertices.size())
        reject("rigid body: a triangle has vertex ", vertex, ", but there are only ", vertices.size(),
               "; count vertices from 0");
}

RigidBody::RigidBody(const RigidBodyShape &shape)
    : motion_((shape.validate(), shape.inertia)), gravity_(shape.gravity), triangles_(shape.triangles)
{
  motion_.guide = shape.guide;
  for (const Vector &vertex : shape.vertices)
    arm_.push_back({vertex[0] - shape.inertia.centre[0], vertex[1] - shape.inertia.centre[1],
                    vertex[2] - shape.inertia.centre[2]});
}

void RigidBody::clear_force()
{
  force_ = moment_ = {};
}

void RigidBody::add_force(const Vector &force, const Vector &place)
{
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    force_[i] += force[i];
    moment_[i] += (place[j] - centre()[j]) * force[k] - (place[k] - centre()[k]) * force[j];
  }
}

void RigidBody::add_moment(const Vector &moment)
{
  for (int i = 0; i < 3; ++i)
    moment_[i] += moment[i];
}

void RigidBody::set_angular_velocity(const Vector &spin)
{
  motion_.prescribe(velocity(), spin, 0);
}

double RigidBody::power(const Vector &velocity, const Vector &spin) const
{
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += (motion_.inertia().mass * gravity_[i] + guide_force()[i]) * velocity[i] + guide_moment()[i] * spin[i];
  return sum;
}

void RigidBody::kick(const double dt)
{
  require(dt > 0 && std::isfinite(dt), "rigid body: the time step", dt, "a positive number of seconds");
  if (kept_.is_kicked != 0)
    throw RunError("rigid body: kicked twice in one step; let a drift follow each kick");
  Vector force = force_;
  for (int i = 0; i < 3; ++i)
    force[i] += motion_.inertia().mass * gravity_[i];
  const Vector velocity_before = velocity(), spin_before = angular_velocity();
  motion_.kick(force, moment_, kept_.last_step > 0 ? 0.5 * (kept_.last_step + dt) : dt, dt);
  kept_.work = kept_.work_ahead + 0.5 * kept_.last_step * power(velocity_before, spin_before);
  kept_.work_ahead = kept_.work + 0.5 * dt * power(velocity(), angular_velocity());
  kept_.last_step = dt;
  kept_.is_kicked = 1;
}

void RigidBody::drift(const double dt)
{
  if (kept_.is_kicked == 0 || dt != kept_.last_step)
    throw RunError("rigid body: a drift without a kick for it; kick with the same time step first");
  motion_.drift(dt);
  kept_.is_kicked = 0;
}

double RigidBody::kinetic_energy() const
{
  double energy = 0;
  for (int i = 0; i < 3; ++i)
    energy += 0.5 * motion_.inertia().mass * velocity()[i] * velocity()[i] +
              0.5 * angular_momentum()[i] * angular_velocity()[i];
  return energy;
}

std::vector<std::pair<std::string, std::span<double>>> RigidBody::state()
{
  using Motion = RigidMotion::Motion;
  static_assert(sizeof(Motion) % sizeof(double) == 0 && sizeof(Kept) % sizeof(double) == 0);
  return {{"motion", {reinterpret_cast<double *>(&motion_.motion()), sizeof(Motion) / sizeof(double)}},
          {"kept", {reinterpret_cast<double *>(&kept_), sizeof(Kept) / sizeof(double)}},
          {"force", force_},
          {"moment", moment_}};
}

} // namespace bergamo::fe
