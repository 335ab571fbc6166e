#pragma once

#include "dem/core/pack_vectors.h"

namespace bergamo::dem
{

/// What one contact gives to its bodies: the force on body 1 (body 2 gets the opposite) and both torques about the
/// centres, with the contact's weight. Every contact owns one, so that forces need neither locks nor atomics.
struct Resultant
{
  Vec4 force = Vec4::Zero();   ///< [N]
  Vec4 torque1 = Vec4::Zero(); ///< [N m]
  Vec4 torque2 = Vec4::Zero(); ///< [N m]

  Resultant() = default;
  Resultant(const Vec3 &force, const Vec3 &torque1, const Vec3 &torque2)
      : force(force[0], force[1], force[2], 0.), torque1(torque1[0], torque1[1], torque1[2], 0.),
        torque2(torque2[0], torque2[1], torque2[2], 0.)
  {
  }
};

/// The same of two spheres, in one line of the cache: their arms lie along the normal, so both torques are parallel.
struct SphereResultant
{
  Vec4 force = Vec4::Zero();  ///< [N]; and the arm of body 1 [m]
  Vec4 torque = Vec4::Zero(); ///< of an arm of 1 [N]; and the arm of body 2 [m]
};

/// Force and torque on one grain; the fourth numbers mean nothing.
struct GrainLoad
{
  Vec4 force = Vec4::Zero();  ///< [N]
  Vec4 torque = Vec4::Zero(); ///< about the centre [N m]

  /// @param side 0 if the grain is body 1 of the contact, 1 if it is body 2; without branches, as it cannot be
  /// predicted
  void add(const Resultant &r, const int side)
  {
    force += (1. - 2. * side) * r.force;
    torque += *(side ? &r.torque2 : &r.torque1);
  }
  void add(const SphereResultant &r, const int side)
  {
    force += (1. - 2. * side) * r.force;
    torque += (*(side ? &r.torque : &r.force))[3] * r.torque;
  }
};

} // namespace bergamo::dem
