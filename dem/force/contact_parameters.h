#pragma once

namespace bergamo::dem
{

/// How contacts are searched and how sharp or flat their surfaces may be.
struct ContactParameters
{
  /// Between two searches of a touching pair its normal, point and overlap follow the motion with the radii of
  /// curvature held, see ContactTurn. The error is of third order in the turn of the normal relative to the bodies; a
  /// new search is due when it may exceed this share of the overlap, see turn_wear(). 0: every step.
  double overlap_tolerance = 3e-5;
  /// Radii of curvature are bounded to [curvature_bound r_min, r_max / curvature_bound]; see CurvatureBounds.
  double curvature_bound = 0.1;

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

} // namespace bergamo::dem
