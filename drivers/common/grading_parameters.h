#pragma once

#include "dem/packing/pack_grains.h"
#include "drivers/common/parameter_file.h"

#include <cstdint>

namespace bergamo::driver
{

enum class ShapeKind
{
  superquadrics,
  clumps ///< of one kind, in the sizes of the grading
};

enum class SizeKind
{
  gaussian, ///< of the half-axes
  uniform,  ///< diameters of the spheres of equal volume
  sieves    ///< by mass
};

/// Sizes of the grains, in one of three ways, and their shapes. SI units.
struct GradingParameters
{
  GradingParameters();

  ShapeKind shape = ShapeKind::superquadrics;
  dem::ClumpShape clump; ///< relative to a unit size
  SizeKind kind = SizeKind::gaussian;
  dem::GrainDistribution gaussian;
  dem::UniformSizes uniform;
  double d10 = 0.64e-3, d50 = 0.78e-3, d60 = 0.81e-3; ///< of the sieve curve [m]

  /// Binds them to the section "Grains" and its sub-sections.
  void declare(ParameterFile &file);

  /// Throws ConfigError, for a packing that cannot be made of such grains too.
  void validate(const dem::PackingParameters &packing) const;

  dem::Grading grading() const;

  /// Grains of that solid volume, all at one place, in the order in which pack() draws them.
  dem::Particles draw(double solid_volume, std::uint64_t seed) const;

  /// See pack_grains() and pack_clumps().
  dem::PackedGrains pack(const dem::PackingSpace &space, const dem::PackingParameters &parameters,
                         std::uint64_t seed) const;

private:
  dem::ClumpGrading clump_grading() const;
};

} // namespace bergamo::driver
