#pragma once

#include "fe_dealii/material/elastic_parameters.h"
#include "fe_dealii/material/tensor.h"

#include <cmath>

namespace bergamo::fe
{

/// Hooke's isotropic law at small strain.
class LinearElastic
{
public:
  /// Throws ConfigError.
  explicit LinearElastic(const ElasticParameters &parameters) : p(parameters) { p.validate("linear elastic material"); }

  double shear_modulus() const { return p.shear_modulus(); }                       ///< G [Pa]
  double bulk_modulus() const { return p.bulk_modulus(); }                         ///< K [Pa]
  double lame_modulus() const { return bulk_modulus() - 2 * shear_modulus() / 3; } ///< λ [Pa]
  double density() const { return p.density; }                                     ///< [kg/m³]

  /// Moduli; the same from any stress, for any increment.
  Moduli tangent(const Stress &, const Strain &) const { return isotropic_moduli(lame_modulus(), shear_modulus()); }

private:
  ElasticParameters p;
};

} // namespace bergamo::fe
