#pragma once

#include "dem/packing/space.h"
#include "dem/state/surface.h"

namespace bergamo::driver
{

/// Two chambers neck to neck, each a cone below or above a cylinder; around z, the neck in the origin, a flat floor,
/// open at the top. Its walls are flat facets between corners on the circles. SI units.
struct GlassShape
{
  double neck_radius = 4e-3, chamber_radius = 10e-3; ///< of the corners [m]
  double half_angle = 30.;                           ///< of the cones, from the axis [degrees]
  double cylinder_height = 8e-3;                     ///< of each chamber [m]
  int n_facets = 24;                                 ///< around
  double triangle_size = 3e-3;                       ///< along the walls at most [m]

  double slope() const;                                             ///< radius over height of the cones
  double cone_height() const;                                       ///< [m]
  double height() const { return cone_height() + cylinder_height; } ///< of each chamber [m]
};

dem::Surface make_glass(const GlassShape &shape);

/// What the upper chamber holds between two heights above the neck. @param top at most the chamber's height [m]
dem::PackingSpace chamber_between(const GlassShape &shape, double bottom, double top);

} // namespace bergamo::driver
