#pragma once

#include "dem/packing/random_addition.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// How a packing is tightened.
struct TighteningParameters
{
  double start_size = 0.75;             ///< of the grains at the start, over their full size
  double size_step = 0.01;              ///< growth at most beyond the mean size, in one iteration
  double translation_probability = 0.5; ///< otherwise a grain turns
  int max_iterations = 2000;

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// One iteration of the tightening, at its end.
struct TighteningStep
{
  double solid_fraction = 0.;
  double mean_size = 0., smallest_size = 0.; ///< over the full size
};

struct Tightening
{
  GrainPlaces places;
  std::vector<double> size; ///< over the full size, 1 unless the iterations were used up
  std::vector<TighteningStep> steps;
};

/// Tightens a packing of grains that are placed at a common share of their full size, until all have it: translates,
/// turns and grows each grain between planes to its neighbours (after Wellmann 3.4.4, algorithm 2).
///
/// Each gap between two grains is parted by a plane in its middle. A grain that stays on its side of its planes meets
/// no other one, whatever those do, so all grains move at once: the result depends neither on an order nor on the
/// number of threads. Every gap is searched once for both grains, in packs.
/// @param grains at full size; @param start where they lie, free of contacts, at start_size of it
Tightening tighten(std::span<const Superquadric> grains, const PackingSpace &space, const GrainPlaces &start,
                   const TighteningParameters &parameters, std::uint64_t seed);

} // namespace bergamo::dem
