#pragma once

#include "dem/core/types.h"

namespace bergamo::dem
{

/// The three paths of the shear phase (Wellmann, fig. 6.4b).
enum class StrainPath
{
  unloading = 1,       ///< shear with volumetric unloading
  constant_volume = 2, ///< shear at constant volume
  compression = 3      ///< shear with further volumetric compression
};

enum class StrainAxis
{
  x,
  y,
  z
};

/// Strains of the cube over time: isotropic compression, then shear with the largest compression along one axis.
/// Each phase starts and ends smoothly. Tension positive.
struct StrainProgram
{
  double isotropic_volumetric_strain = -0.005;
  double isotropic_time = 0.006; ///< [s]
  StrainPath path = StrainPath::compression;
  StrainAxis axis = StrainAxis::z;         ///< of the largest compression in the shear phase
  double axial_strain = -0.015;            ///< of the shear phase, along the axis
  double volumetric_strain_change = 0.005; ///< size of the change in the shear phase; 0 is taken for path 2
  double shear_time = 0.012;               ///< [s]
  double ramp = 0.1;                       ///< share of a phase in which it speeds up, and again slows down

  /// Throws ConfigError for a value out of its range.
  void validate() const;

  double end_time() const { return isotropic_time + shear_time; } ///< [s]

  /// Strains of x, y, z at a time [s].
  Vec3 strain(double time) const;

  /// 1 during the isotropic phase, 2 during the shear phase.
  int stage(double time) const { return time < isotropic_time ? 1 : 2; }
};

} // namespace bergamo::dem
