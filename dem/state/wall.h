#pragma once

#include "dem/core/types.h"

namespace bergamo::dem
{

/// Rigid plane, infinite in extent, that may move along its normal.
struct PlaneWall
{
  Vec3 point = Vec3::Zero();    ///< any point of the plane [m]
  Vec3 normal = Vec3::UnitZ();  ///< unit, towards the grains
  Vec3 velocity = Vec3::Zero(); ///< at the half step before; the owner may change it every step [m/s]
  double motion = 0.;           ///< path length since the start [m]
  Vec3 force = Vec3::Zero();    ///< of the grains on the wall at this step, with the contacts' weights [N]
  double work = 0.;             ///< done by the wall on the grains since the start [J]
};

} // namespace bergamo::dem
