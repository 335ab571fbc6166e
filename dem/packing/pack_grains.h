#pragma once

#include "dem/packing/clump_grading.h"
#include "dem/packing/grading.h"
#include "dem/packing/tightening.h"
#include "dem/state/particles.h"

#include <cstdint>
#include <vector>

namespace bergamo::dem
{

/// A packing to be made.
struct PackingParameters
{
  double solid_fraction = 0.55;       ///< of the finished packing
  double start_solid_fraction = 0.26; ///< that the random addition places; the rest is tightening
  double density = 2650.;             ///< of the grains [kg/m^3]
  TighteningParameters tightening;

  /// Throws ConfigError for a value out of its range.
  void validate() const;

  /// Throws ConfigError for a solid fraction that a random addition does not reach.
  void validate_for_clumps() const;
};

/// What came out.
struct PackingReport
{
  double solid_fraction = 0.;     ///< reached
  bool has_reached_target = true; ///< within 0.001
  double size_factor = 1.;        ///< of all drawn grains, so that whole grains make up the solid volume exactly
  double smallest_size = 1.;      ///< over the size that a grain should have: 1, all sizes are as drawn
  std::vector<AdditionRound> addition;
  std::vector<TighteningStep> tightening;

  /// Trials of the random addition for each grain.
  double trials_per_grain() const;
};

struct PackedGrains
{
  Particles particles; ///< at rest, free of contacts, in the order in which they were drawn
  PackingReport report;
};

/// Fills a space with grains: draws them, places them at random at a reduced size and tightens the packing until they
/// have their full size (Wellmann 3.4.4). The same bits for the same seed on any number of threads.
/// @throws ConfigError for a space that is too small for the grains, or a start solid fraction at which they find no
/// place. A tightening that gets stuck below the target is reported, not thrown.
PackedGrains pack_grains(const Grading &grading, const PackingSpace &space, const PackingParameters &parameters,
                         std::uint64_t seed);

/// Fills a space with clumps: draws them and places them at random at their full size. They are not tightened, so the
/// solid fraction is at most 0.35 (some 0.25 works for most shapes); the start solid fraction and the tightening of the
/// parameters do not count. The same bits for the same seed on any number of threads.
/// @throws ConfigError for a solid fraction above that, for a space that is too small for the grains, or if they find
/// no place
PackedGrains pack_clumps(const ClumpGrading &grading, const PackingSpace &space, const PackingParameters &parameters,
                         std::uint64_t seed);

} // namespace bergamo::dem
