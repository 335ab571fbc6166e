#pragma once

#include "dem/packing/space.h"
#include "dem/state/surface.h"

namespace bergamo::benchmark
{

/// Upright silo about the z axis: a cylinder on a cone down to an orifice at z = 0.
struct Silo
{
  double radius = 0.05, orifice_radius = 0.015; ///< [m]
  double height = 0.3;                          ///< of cone and cylinder together [m]
  double slope = 1.;                            ///< of the cone, height over radius

  double cone_height() const { return slope * (radius - orifice_radius); }
  dem::Surface surface() const;    ///< open at the top and at the orifice
  dem::PackingSpace space() const; ///< inside of the triangles
};

/// Drum about the y axis, closed on both sides, its centre at the origin.
struct Drum
{
  double radius = 0.05, width = 0.04; ///< [m]

  dem::Surface surface() const;
  dem::PackingSpace space() const;
};

/// Box with its floor in z = 0, open at the top, centred about the z axis.
struct OpenBox
{
  double width = 0.1, height = 0.3; ///< [m]

  dem::Surface surface() const;
  dem::PackingSpace space() const;
};

} // namespace bergamo::benchmark
