#pragma once

#include "dem/core/types.h"

namespace bergamo::dem
{

/// What one contact gives to its bodies: the force on body 1 (body 2 gets the opposite) and both torques about the
/// centres, with the contact's weight. Every contact owns one, so that forces need neither locks nor atomics. Either
/// body reads six numbers in a row.
struct Resultant
{
  Vec3 torque1 = Vec3::Zero(); ///< [N m]
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 torque2 = Vec3::Zero(); ///< [N m]

  /// @param side 0 for body 1, 1 for body 2
  const Vec3 &torque(const int side) const { return side ? torque2 : torque1; }
};

} // namespace bergamo::dem
