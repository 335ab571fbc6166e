#pragma once

#include "dem/core/pack.h"
#include "dem/core/types.h"

namespace bergamo::dem
{

/// Normal of two bodies that share their centre, where symmetry prefers none: a unit vector fixed in space, along no
/// axis or diagonal of grains that stand along the axes.
template <class Real>
Vector3<Real> normal_without_line()
{
  return {Real(2. / 7.), Real(3. / 7.), Real(6. / 7.)};
}

/// Unit vector along the line of centres, from which searches begin. A line whose square is lost (centres at one place,
/// nearer than 1e-145 m, or 1e145 m apart) counts as none; one that is no number stays so.
/// @param line x2 - x1 [m]
template <class Real>
Vector3<Real> centre_direction(const Vector3<Real> &line)
{
  const Real square = line.squaredNorm();
  const math::Mask<Real> is_lost = square < Real(1e-290) || square > Real(1e290);
  return math::select<Real>(is_lost, normal_without_line<Real>(), Vector3<Real>(line / math::sqrt(square)));
}

} // namespace bergamo::dem
