#pragma once

#include <cmath>

namespace bergamo::dem
{

/// Dashpot along the normal [N], Wellmann (3.27-3.29): ratio times the critical damping of the current stiffness.
/// @param ratio zeta, 1 is critical; @param normal_stiffness d f_el / d delta [N/m];
/// @param reduced_mass m1 m2 / (m1 + m2) [kg]; @param overlap_rate d delta / d t [m/s], positive while approaching
template <class Real>
Real dashpot(const Real ratio, const Real normal_stiffness, const Real reduced_mass, const Real overlap_rate)
{
  using std::sqrt;
  return Real(2) * ratio * sqrt(normal_stiffness * reduced_mass) * overlap_rate;
}

} // namespace bergamo::dem
