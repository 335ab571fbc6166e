#pragma once

#include "dem/core/types.h"

namespace bergamo::dem
{

/// What shapes there may be. Within these limits volumes and moments of inertia neither overflow nor vanish, the
/// support function keeps the distance of its exponents from one, and the contact search decides every pair (the fuzz
/// target draws such shapes).
namespace shape_limits
{
inline constexpr double smallest_half_axis = 1e-30, largest_half_axis = 1e30; ///< [m]
inline constexpr double largest_ratio = 1e5;                                  ///< of two half-axes
inline constexpr double smallest_exponent = 1e-6, largest_exponent = 2. - 1e-6;
} // namespace shape_limits

/// Superquadric with half-axes r1, r2, r3 [m] along its body axes and exponents 0 < eps < 2
/// (towards 0 a box, 1 an ellipsoid, towards 2 an octahedron). Wellmann, eq. (3.1):
///   F(X) = (|X1/r1|^(2/eps1) + |X2/r2|^(2/eps1))^(eps1/eps2) + |X3/r3|^(2/eps2).
struct Superquadric
{
  Vec3 half_axes = Vec3::Ones();
  double eps1 = 1.;
  double eps2 = 1.;

  /// Throws ConfigError for half-axes or exponents outside the limits of shapes.
  void validate() const;

  bool is_sphere() const;
};

/// F(X) for a point in the body frame: below 1 inside, 1 on the surface, above 1 outside.
double inside_outside(const Superquadric &shape, const Vec3 &body_point);

/// Volume [m^3], Wellmann (3.4).
double volume(const Superquadric &shape);

/// Principal moments of inertia about the centre for density 1 [m^5], Wellmann (3.5-3.7).
Vec3 inertia_per_density(const Superquadric &shape);

/// Radius of the smallest sphere about the centre that contains the body [m], Wellmann (A.1.1).
double bounding_radius(const Superquadric &shape);

/// Bound of the change of the support height in a fixed direction over a radian of the body's turn [m]: the part of the
/// arm beside the direction, whose square is arm^2 - height^2.
double largest_swing(const Superquadric &shape);

/// Radius of the sphere of equal volume [m].
double equivalent_radius(const Superquadric &shape);
double equivalent_radius(double volume);

/// Point of the surface in the body frame for the angles -pi/2 <= latitude <= pi/2, -pi <= longitude <= pi (Barr 1981).
Vec3 surface_point(const Superquadric &shape, double latitude, double longitude);

} // namespace bergamo::dem
