#pragma once

#include "coupling/model/mover.h"
#include "dem/state/particles.h"

#include <initializer_list>

namespace bergamo::coupling::test
{

/// Kinetic, stored and lost less what came from outside, between kick and drift [J].
inline double energy_of(const std::initializer_list<const Mover *> movers)
{
  double sum = 0.;
  for (const Mover *mover : movers)
  {
    const MoverEnergy e = mover->energy();
    sum += e.kinetic + e.stored + e.lost - e.work;
  }
  return sum;
}

/// How projectiles() come.
struct Flight
{
  double height, lag; ///< of the first grain's centre, and of each next one below it [m]
  Vec3 velocity;      ///< [m/s]; grain k has k times its y
};

/// A sphere and two superquadrics of about 1 mm that fly towards a body from below, beside its middle.
inline dem::Particles projectiles(const Flight &flight)
{
  constexpr double mm = 1e-3, density = 2650.;
  dem::Particles grains;
  const dem::Superquadric shapes[] = {
      {Vec3::Constant(mm), 1., 1.}, {Vec3(1.2, 1., 0.8) * mm, 0.8, 0.9}, {Vec3(1.1, 0.9, 1.4) * mm, 1., 1.}};
  for (int k = 0; k < 3; ++k)
  {
    grains.add(shapes[k], density, Vec3(2.5 * mm * (k - 0.7), 0.4 * mm * k, flight.height - flight.lag * k),
               Quaternion(Eigen::AngleAxisd(0.3 + k, Vec3(1., 2., -1.).normalized())));
    grains.velocity[k] = Vec3(flight.velocity.x(), flight.velocity.y() * k, flight.velocity.z());
  }
  return grains;
}

} // namespace bergamo::coupling::test
