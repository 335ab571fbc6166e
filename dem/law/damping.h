#pragma once

#include "dem/core/pack.h"

namespace bergamo::dem
{

/// Dashpot along the normal [N s/m], Wellmann (3.27-3.29): ratio times the critical damping of the current stiffness.
/// @param ratio zeta, 1 is critical; @param normal_stiffness d f_el / d delta [N/m];
/// @param reduced_mass m1 m2 / (m1 + m2) [kg]
template <class Real>
Real dashpot(const double ratio, const Real &normal_stiffness, const Real &reduced_mass)
{
  return Real(2. * ratio) * math::sqrt(normal_stiffness * reduced_mass);
}

/// Viscoelastic damping along the normal [N s/m], Wellmann (3.30) after Brilliantov et al. (1996):
/// f_el(delta) + A d f_el / d t, so the damping is the current stiffness times A.
/// @param relaxation_time A [s], see dem/law/restitution.h; @param normal_stiffness d f_el / d delta [N/m]
template <class Real>
Real viscoelastic(const double relaxation_time, const Real &normal_stiffness)
{
  return Real(relaxation_time) * normal_stiffness;
}

} // namespace bergamo::dem
