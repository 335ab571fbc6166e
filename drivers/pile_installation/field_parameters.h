#pragma once

#include "dem/core/types.h"
#include "drivers/common/parameter_file.h"

namespace bergamo::driver
{

/// On which grids the fields of the ground are sampled (Wellmann 6.4.3). The solid fraction in spheres on a grid in the
/// middle of the ground, y = 0; stresses in cells that are square in x and z and as deep as the ground.
struct FieldParameters
{
  double spacing = 0.75e-3;      ///< of the sampling spheres [m]
  double sphere_radius = 1.6e-3; ///< [m]
  double stress_cell = 2e-3;     ///< about the edge of a cell: as many as go best into the ground's length [m]

  /// Binds them to the section "Fields".
  void declare(ParameterFile &file);

  /// Throws ConfigError, before any work. @param box edges of the box of sand [m]
  void validate(const Vec3 &box) const;
};

} // namespace bergamo::driver
