#pragma once

namespace bergamo::fe
{

/// Young's modulus, Poisson's ratio and density of an elastic solid at small strain.
struct ElasticParameters
{
  double young_modulus = 1e6; ///< [Pa], > 0
  double poisson_ratio = 0.3; ///< [-], in (-1, 0.5)
  double density = 1000;      ///< of the reference state [kg/m³], > 0

  double shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }
  double bulk_modulus() const { return young_modulus / (3 * (1 - 2 * poisson_ratio)); }

  /// Throws ConfigError that names the material and the first value outside its range.
  void validate(const char *material) const;
};

/// Throws ConfigError "MATERIAL: NAME = VALUE is not allowed; RULE" unless it holds; for the other parameters of a
/// law.
void require_parameter(bool holds, const char *material, const char *name, double value, const char *rule);

} // namespace bergamo::fe
