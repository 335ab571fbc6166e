#pragma once

#include "dem/core/types.h"
#include "dem/shape/superquadric.h"
#include "dem/law/hertz.h"

namespace bergamo::dem
{

/// How contacts are searched and how sharp or flat their surfaces may be.
struct ContactParameters
{
  /// A touching pair is searched anew when its relative motion exceeds this share of its smaller bounding radius r.
  /// In between the overlap follows the rigid motion, with an error of about motion_budget^2 r. 0: every step.
  double motion_budget = 2e-5;
  /// Radii of curvature are bounded to [curvature_bound r_min, r_max / curvature_bound]; see CurvatureBounds.
  double curvature_bound = 0.1;

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

inline CurvatureBounds curvature_bounds(const Superquadric &shape, const double factor)
{
  return {factor * shape.half_axes.minCoeff(), shape.half_axes.maxCoeff() / factor};
}

} // namespace bergamo::dem
