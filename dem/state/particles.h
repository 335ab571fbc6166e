#pragma once

#include "dem/core/types.h"
#include "dem/shape/superquadric.h"
#include "dem/state/periodic_cell.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace bergamo::dem
{

/// Grains as a structure of arrays, all of length size(). Global frame, SI units.
/// Velocities belong to half steps (leapfrog), everything else to whole steps.
struct Particles
{
  std::vector<std::int64_t> id; ///< identity that survives every sort
  std::vector<Superquadric> shape;
  std::vector<double> mass;            ///< [kg]
  std::vector<Vec3> inertia;           ///< principal moments in the body frame [kg m^2]
  std::vector<double> bounding_radius; ///< [m]

  std::vector<Vec3> position;          ///< centre [m]
  std::vector<Quaternion> orientation; ///< body to global
  std::vector<Vec3> velocity;          ///< at the half step before [m/s]
  std::vector<Vec3> angular_momentum;  ///< global frame [kg m^2/s]
  std::vector<Vec3> angular_velocity;  ///< mean over the step before, global frame [1/s]

  std::vector<Vec3> force;          ///< resultant at this step [N]
  std::vector<Vec3> torque;         ///< about the centre [N m]
  std::vector<Vec3> external_force; ///< added to the contact forces, e.g. by a coupling [N]; empty where there is none

  /// Share w in (0, 1] of this grain in the virtual work: 1 unless another model shares the grain's place.
  /// Mass, inertia and body forces count w times; a contact counts with the weight at its point.
  std::vector<double> weight;

  std::vector<double> motion; ///< path length that bounds the motion of any surface point since the start [m]
  double largest_motion = 0.; ///< sum over the steps of the largest growth of any grain's motion [m]

  PeriodicCell cell; ///< in which the grains repeat themselves, if any

  /// From the centre of grain i to the centre of an image of grain j [m].
  Vec3 branch(const std::int32_t i, const std::int32_t j, const Image image) const
  {
    return position[j] - position[i] + cell.place[image];
  }

  std::size_t size() const { return position.size(); }

  /// Adds a grain at rest. Mass, inertia and bounding radius follow from shape and density [kg/m^3].
  void add(const Superquadric &shape, double density, const Vec3 &position, const Quaternion &orientation);

  /// Holds a grain where it is: a part of a rough wall, of infinite mass and inertia. Two such grains feel no contact.
  void fix(std::size_t i);
  bool is_fixed(const std::size_t i) const { return std::isinf(mass[i]); }
};

} // namespace bergamo::dem
