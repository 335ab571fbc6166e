#include "dem/state/particles.h"

#include <limits>

namespace bergamo::dem
{

void Particles::add(const Superquadric &new_shape, const double density, const Vec3 &new_position,
                    const Quaternion &new_orientation)
{
  id.push_back(static_cast<std::int64_t>(id.size()));
  shape.push_back(new_shape);
  mass.push_back(density * volume(new_shape));
  inertia.push_back(density * inertia_per_density(new_shape));
  bounding_radius.push_back(dem::bounding_radius(new_shape));
  position.push_back(new_position);
  orientation.push_back(new_orientation.normalized());
  velocity.push_back(Vec3::Zero());
  angular_momentum.push_back(Vec3::Zero());
  angular_velocity.push_back(Vec3::Zero());
  force.push_back(Vec3::Zero());
  torque.push_back(Vec3::Zero());
  weight.push_back(1.);
  motion.push_back(0.);
}

void Particles::fix(const std::size_t i)
{
  mass[i] = std::numeric_limits<double>::infinity();
  inertia[i].setConstant(mass[i]);
  velocity[i].setZero();
  angular_momentum[i].setZero();
  angular_velocity[i].setZero();
}

} // namespace bergamo::dem
