#pragma once

#include "fe_dealii/material/elastic_parameters.h"
#include "fe_dealii/material/hyperelastic.h"

namespace bergamo::fe
{

/// Compressible Neo-Hooke law, W + U = G/2 (tr C − 3 − 2 ln J) + Λ/4 (J² − 1 − 2 ln J), Λ = K − 2G/3 (Wellmann 2.1.5,
/// where −2 ln J is missing from the first bracket: without it the reference state would not be free of stress).
class NeoHooke
{
public:
  /// Throws ConfigError; Poisson's ratio in [0, 0.5), since Λ must not be negative.
  explicit NeoHooke(const ElasticParameters &parameters) : p(parameters)
  {
    p.validate("Neo-Hooke material");
    require_parameter(p.poisson_ratio >= 0, "Neo-Hooke material", "poisson_ratio", p.poisson_ratio,
                      "choose it in [0, 0.5)");
  }

  template <class Real>
  PointResponse<Real> respond(const Tensor3<Real> &f, const Tensor3<Real> &minors, const Real &ratio) const
  {
    PointResponse<Real> response;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        response.stress[i][j] = shear_modulus() * (f[i][j] - minors[i][j] / ratio);
    Real c[6];
    right_cauchy_green(f, c);
    response.energy = (0.5 * shear_modulus()) * (c[0] + c[1] + c[2] - 3. - 2. * math::library_log(ratio));
    return response;
  }

  /// λ ∂W/∂λ and the share of one direction in W, incompressible, at x = λ².
  template <class Real>
  Real principal_slope(const Real &x) const
  {
    return shear_modulus() * x;
  }
  template <class Real>
  Real principal_energy(const Real &x) const
  {
    return (0.5 * shear_modulus()) * (x - 1.);
  }

  VolumetricEnergy volumetric() const { return {bulk_modulus() - 2 * shear_modulus() / 3}; }
  double shear_modulus() const { return p.shear_modulus(); } ///< G [Pa]
  double bulk_modulus() const { return p.bulk_modulus(); }   ///< K [Pa]
  double density() const { return p.density; }               ///< [kg/m³]

private:
  ElasticParameters p;
};

} // namespace bergamo::fe
