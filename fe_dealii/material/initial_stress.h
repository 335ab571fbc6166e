#pragma once

#include "fe_dealii/material/tensor.h"

#include <array>
#include <functional>
#include <vector>

namespace bergamo::fe
{

/// Stress at rest at a point of the reference configuration, of a place [m] in Pa. Empty: no stress.
using InitialStress = std::function<Stress(const std::array<double, 3> &)>;

/// −p I everywhere. @param pressure p [Pa]
InitialStress uniform_pressure(double pressure);

/// Ground below the uppermost layer.
struct DeeperLayer
{
  double top = 0;         ///< z where it begins [m]
  double unit_weight = 0; ///< ρ g, >= 0 [N/m³]
};

/// Ground at rest under its own weight, z upwards: σ_zz = −(surcharge + ∫ unit weight dz), the others K0 times that, no
/// shear. Above the surface only the surcharge.
struct GeostaticStress
{
  double surface_height = 0;           ///< z of the surface [m]
  double unit_weight = 0;              ///< ρ g, >= 0 [N/m³]
  double earth_pressure_at_rest = 0.5; ///< K0, >= 0 [-]
  double surcharge = 0;                ///< on the surface, >= 0 [Pa]
  std::vector<DeeperLayer> deeper{};   ///< layers below the first, each below the one before

  /// Throws ConfigError.
  void validate() const;
};

/// Throws ConfigError for a value out of its range.
InitialStress geostatic_stress(const GeostaticStress &ground);

/// K0 = 1 − sin φ of ground that was only ever loaded (Jaky 1944). @param friction_angle φ [degrees]
double earth_pressure_at_rest(double friction_angle);

} // namespace bergamo::fe
