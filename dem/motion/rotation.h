#pragma once

#include "dem/core/types.h"

#include <cmath>

namespace bergamo::dem
{

/// Rotation by the vector angle = axis * angle [rad].
inline Quaternion rotation(const Vec3 &angle)
{
  const double square = angle.squaredNorm();
  if (square < 1e-4) // series: next terms are below 1e-16
  {
    const double s = 0.5 - square * (1. / 48. - square * (1. / 3840.));
    const double c = 1. - square * (1. / 8. - square * (1. / 384. - square / 46080.));
    return {c, s * angle[0], s * angle[1], s * angle[2]};
  }
  const double size = std::sqrt(square), s = std::sin(0.5 * size) / size;
  return {std::cos(0.5 * size), s * angle[0], s * angle[1], s * angle[2]};
}

/// omega = T I^-1 T^T H [1/s]. @param inertia principal moments in the body frame [kg m^2]
inline Vec3 angular_velocity(const Quaternion &orientation, const Vec3 &inertia, const Vec3 &angular_momentum)
{
  const Vec3 body = orientation.conjugate() * angular_momentum;
  return orientation * Vec3(body.cwiseQuotient(inertia));
}

/// Mean angular velocity over one step with the angular momentum H held: four evaluations averaged as in the classical
/// Runge-Kutta formula (Wellmann 3.40-3.44, after Munjiza et al. 2003), with the two commutators that rotations, which
/// do not commute, need for fourth order (Munthe-Kaas 1999; without them it is of second). Turning by it keeps H
/// exactly.
/// @param orientation at the beginning of the step; @param inertia principal moments in the body frame [kg m^2]
inline Vec3 mean_angular_velocity(const Quaternion &orientation, const Vec3 &inertia, const Vec3 &angular_momentum,
                                  const double time_step)
{
  const Vec3 w1 = angular_velocity(orientation, inertia, angular_momentum);
  if (inertia[0] == inertia[1] && inertia[1] == inertia[2])
    return w1;
  const auto velocity_after = [&](const Vec3 &w, const double dt) -> Vec3
  { return angular_velocity(rotation(dt * w) * orientation, inertia, angular_momentum); };
  const Vec3 w2 = velocity_after(w1, 0.5 * time_step);
  const Vec3 w3 = velocity_after(w2 - 0.25 * time_step * w1.cross(w2), 0.5 * time_step);
  const Vec3 w4 = velocity_after(w3, time_step);
  return (w1 + 2. * w2 + 2. * w3 + w4) / 6. - time_step / 12. * w1.cross(w4);
}

} // namespace bergamo::dem
