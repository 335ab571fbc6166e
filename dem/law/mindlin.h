#pragma once

#include "dem/core/types.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{

/// Stiffness of the contact in its tangent plane: principal values [N/m] along the axes of the contact ellipse.
struct TangentialStiffness
{
  double major, minor;
  Vec3 major_axis, minor_axis; ///< unit, tangential
};

inline Vec3 tangential_force_increment(const TangentialStiffness &k, const Vec3 &displacement)
{
  return k.major * k.major_axis.dot(displacement) * k.major_axis +
         k.minor * k.minor_axis.dot(displacement) * k.minor_axis;
}

/// Energy stored in the tangential springs, f.C.f / 2 [J].
inline double tangential_energy(const TangentialStiffness &k, const Vec3 &force)
{
  const double major = k.major_axis.dot(force), minor = k.minor_axis.dot(force);
  return 0.5 * (major * major / k.major + minor * minor / k.minor);
}

/// Tangential force of this step, Wellmann (3.25, 3.26).
/// @param old_force last step's force on body 1, in the present tangent plane [N]
/// @param shrink present over last contact radius: where the contact shrinks its spring lets go of the same share of
///        the force (Thornton & Randall 1988); without it a closed loop of loading and shearing would make energy
/// @param displacement tangential motion of body 2 relative to body 1 since last step [m]
/// @param limit mu |f_N| [N]
inline Vec3 tangential_force(const TangentialStiffness &k, const Vec3 &old_force, const double shrink,
                             const Vec3 &displacement, const double limit)
{
  const Vec3 trial = std::min(shrink, 1.) * old_force + tangential_force_increment(k, displacement);
  const double size = trial.norm();
  return size > limit ? Vec3(trial * (limit / size)) : trial;
}

} // namespace bergamo::dem
