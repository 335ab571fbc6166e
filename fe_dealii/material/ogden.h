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
    const Stretches<Real> s = stretches(f, ratio);
    // S = Σ_k (∂W/∂ln λ_k)/λ_k² N_k ⊗ N_k, and at constant volume the logarithmic derivatives have no trace.
    Real value[3];
    for (int k = 0; k < 3; ++k)
      value[k] = (2. * s.slope[k] - s.slope[(k + 1) % 3] - s.slope[(k + 2) % 3]) / (3. * s.frame.value[k]);
    Real second_piola[6];
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (int c = 0; c < 6; ++c)
    {
      second_piola[c] = value[0] * s.frame.direction[0][row[c]] * s.frame.direction[0][column[c]];
      for (int k = 1; k < 3; ++k)
        second_piola[c] += value[k] * s.frame.direction[k][row[c]] * s.frame.direction[k][column[c]];
    }
    return times_symmetric(f, second_piola);
  }

  template <class Real>
  Real point_energy(const Tensor3<Real> &f, const Real &ratio) const
  {
    const Stretches<Real> s = stretches(f, ratio);
    return s.energy[0] + s.energy[1] + s.energy[2];
  }

  VolumetricEnergy volumetric() const { return {p.bulk_modulus}; }
  double shear_modulus() const { return p.shear_modulus(); } ///< G [Pa]
  double bulk_modulus() const { return p.bulk_modulus; }     ///< K [Pa]
  double density() const { return p.density; }               ///< [kg/m³]
  const OgdenParameters &parameters() const { return p; }

private:
  template <class Real>
  struct Stretches
  {
    PrincipalFrame<Real> frame; // of C: values λ²
    Real slope[3];              // Σ_p μ_p λ̄_k^α_p
    Real energy[3];             // Σ_p μ_p/α_p (λ̄_k^α_p − 1)
  };

  template <class Real>
  Stretches<Real> stretches(const Tensor3<Real> &f, const Real &ratio) const
  {
    Stretches<Real> s;
    Real c[6];
    right_cauchy_green(f, c);
    s.frame = principal_frame<Real>(c);
    const Real scale = lanes::power(ratio, -2. / 3.);
    for (int k = 0; k < 3; ++k)
    {
      const Real log_stretch = 0.5 * lanes::logarithm(Real(scale * s.frame.value[k]));
      s.slope[k] = s.energy[k] = ratio * 0.;
      for (int n = 0; n < 3; ++n)
      {
        if (p.modulus[n] == 0)
          continue;
        const Real power = lanes::exponential(Real(p.exponent[n] * log_stretch));
        s.slope[k] += p.modulus[n] * power;
        s.energy[k] += p.modulus[n] / p.exponent[n] * (power - 1.);
      }
    }
    return s;
  }

  OgdenParameters p;
};

} // namespace bergamo::fe
