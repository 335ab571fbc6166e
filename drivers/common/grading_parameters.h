#pragma once

#include "dem/packing/grading.h"
#include "drivers/common/parameter_file.h"

namespace bergamo::driver
{

enum class SizeKind
{
  gaussian, ///< of the half-axes
  uniform,  ///< diameters of the spheres of equal volume
  sieves    ///< by mass
};

/// Sizes and shapes of the grains, in one of three ways. SI units.
struct GradingParameters
{
  SizeKind kind = SizeKind::gaussian;
  dem::GrainDistribution gaussian;
  dem::UniformSizes uniform;
  double d10 = 0.64e-3, d50 = 0.78e-3, d60 = 0.81e-3; ///< of the sieve curve [m]

  /// Binds them to the section "Grains" and its sub-sections.
  void declare(ParameterFile &file);

  /// Throws ConfigError.
  void validate() const;

  dem::Grading grading() const;
};

} // namespace bergamo::driver
