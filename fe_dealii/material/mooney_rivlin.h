#pragma once

#include "fe_dealii/material/elastic_parameters.h"
#include "fe_dealii/material/hyperelastic.h"

namespace bergamo::fe
{

struct MooneyRivlinParameters
{
  ElasticParameters elastic;
  double second_share = 0.05; ///< c: share of the second invariant in the shear modulus [-], in [0, 1]

  /// Throws ConfigError.
  void validate() const
  {
    elastic.validate("Mooney-Rivlin material");
    require_parameter(second_share >= 0 && second_share <= 1, "Mooney-Rivlin material", "second_share", second_share,
                      "choose it in [0, 1]");
  }
};

/// Mooney-Rivlin law of rubber, W = G/2 ((1 − c)(Ī1 − 3) + c (Ī2 − 3)) with the invariants of the part of C that keeps
/// the volume, U = K/4 (J² − 1 − 2 ln J).
class MooneyRivlin
{
public:
  /// Throws ConfigError.
  explicit MooneyRivlin(const MooneyRivlinParameters &parameters) : p(parameters) { p.validate(); }

  template <class Real>
  PointResponse<Real> respond(const Tensor3<Real> &f, const Tensor3<Real> &minors, const Real &ratio) const
  {
    const Invariants<Real> v = invariants(f, ratio);
    // dĪ1/dF = 2 J^-2/3 F − 2/3 Ī1 F^-T,  dĪ2/dF = 2 J^-4/3 F (I1 1 − C) − 4/3 Ī2 F^-T
    Real weighted[6];
    for (int k = 0; k < 6; ++k)
      weighted[k] = -second() * v.scale * v.scale * v.c[k];
    for (int k = 0; k < 3; ++k)
      weighted[k] += first() * v.scale + second() * v.scale * v.first;
    Tensor3<Real> stress = times_symmetric(f, weighted);
    const Real along = (first() * v.first + 2. * second() * v.second) / (3. * ratio);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        stress[i][j] -= along * minors[i][j];
    return {stress, 0.5 * (first() * (v.first - 3.) + second() * (v.second - 3.))};
  }

  /// λ ∂W/∂λ and the share of one direction in W, incompressible, at x = λ².
  template <class Real>
  Real principal_slope(const Real &x) const
  {
    return first() * x - second() / x;
  }
  template <class Real>
  Real principal_energy(const Real &x) const
  {
    return 0.5 * (first() * (x - 1.) + second() * (1. / x - 1.));
  }

  VolumetricEnergy volumetric() const { return {bulk_modulus()}; }
  double shear_modulus() const { return p.elastic.shear_modulus(); } ///< G [Pa]
  double bulk_modulus() const { return p.elastic.bulk_modulus(); }   ///< K [Pa]
  double density() const { return p.elastic.density; }               ///< [kg/m³]

private:
  template <class Real>
  struct Invariants
  {
    Real c[6];          // right Cauchy-Green
    Real scale;         // J^-2/3
    Real first, second; // Ī1, Ī2
  };

  template <class Real>
  static Invariants<Real> invariants(const Tensor3<Real> &f, const Real &ratio)
  {
    Invariants<Real> v;
    right_cauchy_green(f, v.c);
    const auto &c = v.c;
    v.scale = math::library_pow(ratio, -2. / 3.);
    v.first = v.scale * (c[0] + c[1] + c[2]);
    v.second = v.scale * v.scale * (c[0] * c[1] + c[1] * c[2] + c[2] * c[0] - c[3] * c[3] - c[4] * c[4] - c[5] * c[5]);
    return v;
  }

  double first() const { return (1 - p.second_share) * shear_modulus(); }
  double second() const { return p.second_share * shear_modulus(); }

  MooneyRivlinParameters p;
};

} // namespace bergamo::fe
