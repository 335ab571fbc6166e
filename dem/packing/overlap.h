#pragma once

#include "dem/geometry/contact_geometry.h"
#include "dem/geometry/superquadric.h"

namespace bergamo::dem
{

/// Radius of the largest sphere about the centre inside a body [m]: the least support height, so one over the bounding
/// radius of the polar body, which is a superquadric of half-axes 1/r and exponents 2 - eps.
double inscribed_radius(const Superquadric &shape);

/// A grain where it is, with what decides about overlaps at little cost.
struct PlacedGrain
{
  const Superquadric &shape;
  BodyPose pose;
  double bounding_radius;  ///< [m]
  double inscribed_radius; ///< [m]
};

/// Whether a plane is known to lie between two grains. @param centre_line from the centre of the first to that of the
/// second, or to an image of it [m]. Where none is found, the grains overlap or as good as touch.
bool are_apart(const PlacedGrain &first, const PlacedGrain &second, const Vec3 &centre_line);

} // namespace bergamo::dem
