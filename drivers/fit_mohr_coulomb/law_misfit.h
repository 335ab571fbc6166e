#pragma once

#include "drivers/fit_mohr_coulomb/sand_tests.h"
#include "drivers/fit_mohr_coulomb/triaxial_curve.h"

#include <cstddef>
#include <vector>

namespace bergamo::driver
{

/// A law on the path of one test.
struct LawCurves
{
  TriaxialCurve shear;                           ///< at the strains of the test
  std::vector<double> compressed_solid_fraction; ///< at the pressures of its compression
};

/// @param law HypoplasticSand or MohrCoulomb
template <class Law>
LawCurves curves_of(const Law &law, const SandTest &test);

/// The same on each of some tests.
template <class Law>
std::vector<LawCurves> curves_of(const Law &law, const std::vector<SandTest> &tests)
{
  std::vector<LawCurves> curves;
  for (const SandTest &test : tests)
    curves.push_back(curves_of(law, test));
  return curves;
}

/// Differences between a law and the grains, each over the root of the sum of squares of the grains' values over all
/// tests, and over the root of the number of the kinds of values: of σ3/σ1 − 1, of the volumetric strain since the
/// start of the shear, and of that since the start of the compression, where there is one. The root of the sum of their
/// squares is 0 for the grains themselves and 1 for a body in which nothing changes.
std::vector<double> differences(const std::vector<SandTest> &tests, const std::vector<LawCurves> &curves);

/// How far a law is off, over the root of the sum of squares of the grains' values.
struct Misfit
{
  double all = 0;                                                  ///< that root of all kinds: one number for a law
  double stress_ratio = 0, volumetric_strain = 0, compression = 0; ///< of one kind alone; 0 where there is none
};
Misfit misfit(const std::vector<SandTest> &tests, const std::vector<LawCurves> &curves);

} // namespace bergamo::driver
