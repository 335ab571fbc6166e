#pragma once

#include "drivers/fit_mohr_coulomb/ensemble.h"
#include "drivers/fit_mohr_coulomb/mean_curve.h"

#include <cstddef>
#include <vector>

namespace bergamo::driver
{

/// The samples of one packing under one pressure, as means: what a law is held against.
struct SandTest
{
  double generation_friction;
  double confining_pressure; ///< [Pa]
  std::size_t n_samples;
  std::vector<MeanPoint> shear;
  CompressionCurve compression; ///< isotropic, before the shear; empty where no sample has one

  double initial_solid_fraction() const { return shear.front().solid_fraction.mean; } ///< of the shear
  std::vector<double> axial_strains() const;                                          ///< of the shear
};

/// The tests of an ensemble, by generation friction, then by pressure. Shears have `n_points` strains, as in
/// mean_curve(); compressions a quarter of that, evenly spaced in the logarithm of the pressure.
/// @param compression_from share of the confining pressure from which the compression counts, in (0, 1): before that,
/// grains settle under the friction of the test
std::vector<SandTest> sand_tests(const std::vector<Sample> &samples, std::size_t n_points, double compression_from);

} // namespace bergamo::driver
