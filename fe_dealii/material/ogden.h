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

  /// Throws ParameterError; every μ_p α_p must be at least 0 (Ogden's condition), one of them positive.
  void validate() const;
};

/// Ogden's law of rubber in three terms, W = Σ μ_p/α_p (λ̄1^α_p + λ̄2^α_p + λ̄3^α_p − 3), λ̄ = J^-1/3 λ the principal
/// stretches at constant volume, U = K/4 (J² − 1 − 2 ln J).
class Ogden
{
public:
  /// Throws ParameterError.
  explicit Ogden(const OgdenParameters &parameters) : p(parameters) { p.validate(); }

  template <class Real>
  Tensor3<Real> point_stress(const Tensor3<Real> &f, const Tensor3<Real> &, const Real &ratio) const
  {
    const PrincipalFrame<Real> stretch = principal_squares(f);
    const Real scale = lanes::power(ratio, -2. / 3.);
    Real slope[3];
    for (int k = 0; k < 3; ++k)
      slope[k] = principal_slope(Real(scale * stretch.value[k]));
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
    return times_symmetric(f, second_piola);
  }

  template <class Real>
  Real point_energy(const Tensor3<Real> &f, const Real &ratio) const
  {
    const PrincipalFrame<Real> stretch = principal_squares(f);
    const Real scale = lanes::power(ratio, -2. / 3.);
    return principal_energy(Real(scale * stretch.value[0])) + principal_energy(Real(scale * stretch.value[1])) +
           principal_energy(Real(scale * stretch.value[2]));
  }

  /// λ ∂W/∂λ and the share of one direction in W, at x = λ̄².
  template <class Real>
  Real principal_slope(const Real &x) const
  {
    return sum_of_terms(x, [](const double modulus, double, const Real &power) { return Real(modulus * power); });
  }
  template <class Real>
  Real principal_energy(const Real &x) const
  {
    return sum_of_terms(x, [](const double modulus, const double exponent, const Real &power)
                        { return Real((modulus / exponent) * (power - 1.)); });
  }

  VolumetricEnergy volumetric() const { return {p.bulk_modulus}; }
  double shear_modulus() const { return p.shear_modulus(); } ///< G [Pa]
  double bulk_modulus() const { return p.bulk_modulus; }     ///< K [Pa]
  double density() const { return p.density; }               ///< [kg/m³]
  const OgdenParameters &parameters() const { return p; }

private:
  template <class Real, class Term>
  Real sum_of_terms(const Real &square, const Term &term) const
  {
    const Real log_stretch = 0.5 * lanes::logarithm(square);
    Real sum = 0. * square;
    for (int n = 0; n < 3; ++n)
      if (p.modulus[n] != 0)
        sum += term(p.modulus[n], p.exponent[n], Real(lanes::exponential(Real(p.exponent[n] * log_stretch))));
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
