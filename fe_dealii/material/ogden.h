#pragma once

#include "fe_dealii/material/elastic_parameters.h"
#include "fe_dealii/material/hyperelastic.h"
#include "fe_dealii/material/principal.h"

#include <array>

namespace bergamo::fe
{

struct OgdenParameters
{
  /// μ_p [Pa] and α_p [-] of the three terms; a term of μ = 0 counts for nothing. The defaults are Ogden's fit to
  /// Treloar's rubber (Proc. R. Soc. Lond. A 326 (1972) 565-584) for a shear modulus of 0.5 MPa, as in Wellmann's
  /// table 4.3: G (1.491, 0.003, −0.0237), (1.3, 5, −2).
  std::array<double, 3> modulus{0.7455e6, 0.0015e6, -0.01185e6};
  std::array<double, 3> exponent{1.3, 5, -2};
  double bulk_modulus = 25e6; ///< K [Pa], > 0
  double density = 1000;      ///< of the reference state [kg/m³], > 0

  /// G = ½ Σ μ_p α_p [Pa].
  double shear_modulus() const
  {
    return 0.5 * (modulus[0] * exponent[0] + modulus[1] * exponent[1] + modulus[2] * exponent[2]);
  }

  /// Throws ConfigError; every μ_p α_p must be at least 0 (Ogden's condition), one of them positive.
  void validate() const;
};

/// Ogden's law of rubber in three terms, W = Σ μ_p/α_p (λ̄1^α_p + λ̄2^α_p + λ̄3^α_p − 3), λ̄ = J^-1/3 λ the principal
/// stretches at constant volume, U = K/4 (J² − 1 − 2 ln J).
class Ogden
{
public:
  /// Throws ConfigError.
  explicit Ogden(const OgdenParameters &parameters) : p(parameters) { p.validate(); }

  template <class Real>
  PointResponse<Real> respond(const Tensor3<Real> &f, const Tensor3<Real> &, const Real &ratio) const
  {
    const PrincipalFrame<Real> stretch = principal_squares(f);
    const Real scale = math::library_pow(ratio, -2. / 3.);
    Real slope[3], energy = 0. * ratio;
    for (int k = 0; k < 3; ++k)
    {
      const Principal<Real> principal = principal_response(Real(scale * stretch.value[k]));
      slope[k] = principal.slope;
      energy += principal.energy;
    }
    // S = Σ_k (∂W/∂ln λ_k)/λ_k² N_k ⊗ N_k, and at constant volume the logarithmic derivatives have no trace.
    Real second_piola[6];
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (int c = 0; c < 6; ++c)
      second_piola[c] = 0. * ratio;
    for (int k = 0; k < 3; ++k)
    {
      const Real value = (2. * slope[k] - slope[(k + 1) % 3] - slope[(k + 2) % 3]) / (3. * stretch.value[k]);
      for (int c = 0; c < 6; ++c)
        second_piola[c] += value * stretch.direction[k][row[c]] * stretch.direction[k][column[c]];
    }
    return {times_symmetric(f, second_piola), energy};
  }

  /// λ ∂W/∂λ and the share of one direction in W, at x = λ̄².
  template <class Real>
  Real principal_slope(const Real &x) const
  {
    return principal_response(x).slope;
  }
  template <class Real>
  Real principal_energy(const Real &x) const
  {
    return principal_response(x).energy;
  }

  VolumetricEnergy volumetric() const { return {p.bulk_modulus}; }
  double shear_modulus() const { return p.shear_modulus(); } ///< G [Pa]
  double bulk_modulus() const { return p.bulk_modulus; }     ///< K [Pa]
  double density() const { return p.density; }               ///< [kg/m³]
  const OgdenParameters &parameters() const { return p; }

private:
  template <class Real>
  struct Principal
  {
    Real slope, energy;
  };

  template <class Real>
  Principal<Real> principal_response(const Real &square) const
  {
    const Real log_stretch = 0.5 * math::library_log(square);
    Principal<Real> sum{0. * square, 0. * square};
    for (int n = 0; n < 3; ++n)
      if (p.modulus[n] != 0)
      {
        const Real power = math::library_exp(Real(p.exponent[n] * log_stretch));
        sum.slope += p.modulus[n] * power;
        sum.energy += (p.modulus[n] / p.exponent[n]) * (power - 1.);
      }
    return sum;
  }

  template <class Real>
  static PrincipalFrame<Real> principal_squares(const Tensor3<Real> &f)
  {
    Real c[6];
    right_cauchy_green(f, c);
    return principal_frame<Real>(c);
  }

  OgdenParameters p;
};

} // namespace bergamo::fe
