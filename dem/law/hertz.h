#pragma once

#include "dem/core/types.h"

namespace bergamo::dem
{

/// Relative curvature of two surfaces at their contact: half the eigenvalues of the sum of both curvature
/// tensors, a <= b [1/m], and the direction of a: the major axis of the contact ellipse.
/// Replaces the dissertation's angle between principal directions (Wellmann, eq. 3.15, 3.16).
struct RelativeCurvature
{
  double a, b;
  Vec3 major_axis;
};

/// Both principal radii of curvature of a surface are bounded to [factor r_min, r_max / factor], r_min and r_max
/// the body's smallest and largest half-axis: a flat spot (radius infinite) or a sharp one (radius 0) would have
/// an infinite or no Hertz force. 0 < factor <= 1; smaller is closer to the ideal shape.
struct CurvatureBounds
{
  double smallest_radius; ///< [m]
  double largest_radius;  ///< [m]
};

/// @param normal unit normal c; @param hessian1, hessian2 d p / d n of the surfaces in the global frame [m]
RelativeCurvature relative_curvature(const Vec3 &normal, const Mat3 &hessian1, const CurvatureBounds &bounds1,
                                     const Mat3 &hessian2, const CurvatureBounds &bounds2);

/// As above against a plane, whose curvature is zero.
RelativeCurvature relative_curvature(const Vec3 &normal, const Mat3 &hessian, const CurvatureBounds &bounds);

/// Elastic constants of a pair of bodies.
struct ElasticPair
{
  double effective_modulus; ///< E*, 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 [Pa]
  double lambda1, lambda2;  ///< Wellmann (3.22) [1/Pa]
};

struct Material;
ElasticPair elastic_pair(const Material &material1, const Material &material2);

/// The law of one contact for fixed curvatures: only the overlap is missing.
///   elastic normal force  f = normal delta^(3/2)
///   tangential stiffness  k = tangential_major|minor sqrt(delta), along the axes of the contact ellipse
struct HertzMindlin
{
  double normal;           ///< gamma E* [N/m^1.5], Wellmann (3.19)
  double tangential_major; ///< [N/m^1.5], Mindlin; Wellmann (3.21-3.23)
  double tangential_minor; ///< [N/m^1.5]
};

/// Coefficients from a table over log(b/a) in [0, log 1e10] made of complete elliptic integrals; the relative
/// error of the force is below 1e-8. Beyond the table the last entry holds.
HertzMindlin hertz_mindlin(double a, double b, const ElasticPair &pair);

} // namespace bergamo::dem
