#pragma once

namespace bergamo::dem
{

/// Elastic grain or wall material.
struct Material
{
  double young_modulus = 50e9; ///< [Pa]
  double poisson_ratio = 0.2;
  double density = 2650.; ///< [kg/m^3]

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

} // namespace bergamo::dem
