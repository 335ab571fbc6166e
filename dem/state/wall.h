#pragma once

#include "dem/core/types.h"

#include <cstdint>

namespace bergamo::dem
{

/// Rigid plane, infinite in extent, that may move.
struct PlaneWall
{
  Vec3 point = Vec3::Zero();          ///< any point of the plane [m]
  Vec3 normal = Vec3::UnitZ();        ///< unit, towards the grains
  Vec3 velocity = Vec3::Zero();       ///< of the drift to come; may be set between steps [m/s]
  Vec3 drift_velocity = Vec3::Zero(); ///< over the step before, which led to the present place [m/s]
  double motion = 0.;                 ///< path length since the start [m]
  Vec3 force = Vec3::Zero();          ///< of the grains on the wall at this step, with the contacts' weights [N]
  double work = 0.;                   ///< done by the wall on the grains since the start [J]
  std::int32_t material = 1;          ///< of the simulation's table

  /// Throws ConfigError for a normal that is no unit vector, for numbers that are not finite, or for a material that
  /// the table lacks. @param n_materials of the table
  void validate(std::int32_t n_materials) const;

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("point", self.point);
    visit("normal", self.normal);
    visit("velocity", self.velocity);
    visit("drift_velocity", self.drift_velocity);
    visit("motion", self.motion);
    visit("force", self.force);
    visit("work", self.work);
    visit("material", self.material);
  }
};

} // namespace bergamo::dem
