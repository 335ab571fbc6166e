#pragma once

#include "drivers/fit_mohr_coulomb/statistic.h"
#include "drivers/fit_mohr_coulomb/triaxial_curve.h"

#include <span>
#include <vector>

namespace bergamo::driver
{

/// Mean and deviation over samples at one axial strain.
struct MeanPoint
{
  double axial_strain; ///< tension positive
  Statistic axial_stress, stress_ratio, volumetric_strain, solid_fraction;
};

/// Mean of curves, each interpolated linearly, at `n_points` axial strains (at least 2) from 0 to the end of the
/// shortest curve; they lie closer together towards 0, as squares do, because the curves bend there. Rows of a curve
/// that do not go beyond the compression reached before are left out. Requires at least one curve, none empty.
std::vector<MeanPoint> mean_curve(std::span<const TriaxialCurve *const> curves, std::size_t n_points);

} // namespace bergamo::driver
