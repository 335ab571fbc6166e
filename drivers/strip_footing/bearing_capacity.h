#pragma once

#include <cmath>
#include <numbers>

namespace bergamo::driver
{

/// Limit pressure of a strip footing on associated Mohr–Coulomb ground, c Nc + q Nq + ½ γ B Nγ.
struct BearingFactors
{
  double cohesion = 0, surcharge = 0, weight = 0; ///< Nc, Nq, Nγ
};

struct Strength
{
  double friction_angle = 0; ///< [degrees]
  double cohesion = 0;       ///< [Pa]
};

/// What slip along a zero extension line bears where the ground dilates less than associated flow would: both tan φ and
/// c times cos ψ cos φ/(1 − sin ψ sin φ) (Davis, Theories of plasticity and the failure of soil masses, 1968). @param
/// dilation_angle ψ [degrees]
inline Strength davis_strength(const Strength &strength, const double dilation_angle)
{
  constexpr double degree = std::numbers::pi / 180;
  const double phi = strength.friction_angle * degree, psi = dilation_angle * degree;
  const double share = std::cos(psi) * std::cos(phi) / (1 - std::sin(psi) * std::sin(phi));
  return {std::atan(share * std::tan(phi)) / degree, share * strength.cohesion};
}

/// Nc and Nq are exact without weight (Prandtl 1921, Reissner 1924). Nγ is the fit of Davis and Booker (1971), after
/// Poulos et al. (2001), a tenth above the exact values at 30 degrees. @param friction_angle φ [degrees]
inline BearingFactors bearing_factors(const double friction_angle, const bool rough)
{
  constexpr double pi = std::numbers::pi;
  const double phi = friction_angle * pi / 180;
  if (phi == 0)
    return {2 + pi, 1, 0};
  const double tangent = std::tan(pi / 4 + phi / 2);
  const double surcharge = std::exp(pi * std::tan(phi)) * tangent * tangent;
  const double weight = rough ? 0.1054 * std::exp(9.6 * phi) : 0.0663 * std::exp(9.3 * phi);
  return {(surcharge - 1) / std::tan(phi), surcharge, weight};
}

} // namespace bergamo::driver
