#pragma once

#include "dem/law/ellipse_table.h"
#include "dem/law/relative_curvature.h"
#include "dem/state/material.h"

#include <numbers>

namespace bergamo::dem
{

/// Elastic constants of a pair of bodies.
struct ElasticPair
{
  double effective_modulus; ///< E*, 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 [Pa]
  double lambda1, lambda2;  ///< Wellmann (3.22) [1/Pa]
};

ElasticPair elastic_pair(const Material &material1, const Material &material2);

/// The law of one contact for fixed curvatures: only the overlap is missing.
///   elastic normal force  f = normal delta^(3/2)
///   tangential stiffness  k = tangential_major|minor sqrt(delta), along the axes of the contact ellipse
template <class Real>
struct HertzMindlin
{
  Real normal;           ///< gamma E* [N/m^1.5], Wellmann (3.19)
  Real tangential_major; ///< [N/m^1.5], Mindlin; Wellmann (3.21-3.23)
  Real tangential_minor; ///< [N/m^1.5]
};

/// @param a,b relative curvatures, 0 < a <= b [1/m]
template <class Real>
HertzMindlin<Real> hertz_mindlin(const Real &a, const Real &b, const ElasticPair &pair)
{
  const EllipseShape<Real> shape = ellipse_table()(math::log(b / a));
  const Real root = Real(1.) / math::sqrt(a + b);
  const Real traction = Real(std::numbers::pi) * shape.semi_axis * root; // pi times semi-axis over sqrt(delta)
  const Real lambda1(pair.lambda1), lambda2(pair.lambda2);
  return {Real(2. / 3. * std::numbers::pi * pair.effective_modulus) * shape.force * root,
          traction / (shape.k * lambda1 - shape.bm * lambda2), traction / (shape.k * lambda1 - shape.d * lambda2)};
}

} // namespace bergamo::dem
