#pragma once

#include "dem/core/pack.h"

namespace bergamo::dem
{

/// How contacts are searched and how sharp or flat their surfaces may be.
struct ContactParameters
{
  /// Between two searches of a touching pair its overlap follows the rigid motion with the normal held. The error is of
  /// second order, about theta^2 H / 2 with theta the relative motion over the bounding radius and H the sum of both
  /// surfaces' radii of curvature; a new search is due when it may exceed this share of the overlap. 0: every step.
  double overlap_tolerance = 1e-4;
  /// Radii of curvature are bounded to [curvature_bound r_min, r_max / curvature_bound]; see CurvatureBounds.
  double curvature_bound = 0.1;

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// Relative motion at a contact after which it is searched anew [m], see ContactParameters::overlap_tolerance.
/// @param radius smaller bounding radius of the pair [m]; @param overlap [m], > 0; @param curvature_radius H [m]
template <class Real>
Real motion_budget(const ContactParameters &parameters, const Real &radius, const Real &overlap,
                   const Real &curvature_radius)
{
  return radius * math::sqrt(Real(2. * parameters.overlap_tolerance) * overlap / curvature_radius);
}

} // namespace bergamo::dem
