#pragma once

#include "dem/packing/random_addition.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// How a packing is tightened.
struct TighteningParameters
{
  double size_step = 0.0015;            ///< growth at most beyond the mean size, in one iteration
  double translation_probability = 0.5; ///< otherwise a grain turns
  int max_iterations = 2000;
  std::function<bool()> is_stopped{}; ///< asked before each iteration; the tightening ends early where it says so

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// Grains at a common share of their full size.
struct LoosePacking
{
  GrainPlaces places;
  double size = 1.; ///< over the full size

  /// Throws ConfigError for a size outside (0, 1], or places that are no numbers or not as many as the grains.
  void validate(std::size_t n_grains) const;
};

/// Distance of centres up to which the tightening looks for neighbours, for the largest bounding radius [m]: a periodic
/// box must be larger than twice as much.
double tightening_range(double largest_radius);

/// One iteration of the tightening, at its end.
struct TighteningStep
{
  double solid_fraction = 0.;
  double mean_size = 0., smallest_size = 0.; ///< over the full size
};

struct Tightening
{
  GrainPlaces places;
  std::vector<double> size; ///< over the full size: 1 unless the tightening ended early
  std::vector<TighteningStep> steps;
};

/// Tightens a packing of grains that are placed at a common share of their full size, until all have it: translates,
/// turns and grows each grain between planes to its neighbours (after Wellmann 3.4.4, algorithm 2).
///
/// Each gap between two grains is parted by a plane in its middle. A grain that stays on its side of its planes meets
/// no other one, whatever those do, so all grains move at once: the result depends neither on an order nor on the
/// number of threads. Every gap is searched once for both grains, in packs.
///
/// No grain grows beyond the mean size by more than the size step, so all grow together, and at the end all are full
/// size exactly. Growing slowly is quicker: grains that ran ahead would lock others in (0.0015: 167 iterations to 0.55,
/// 0.003: 389). Ends at the full size, after the largest number of iterations, when the grains no longer grow, or when
/// it is stopped.
/// @param grains at full size; @param start free of contacts
/// @throws ConfigError for a periodic box of at most two tightening ranges
Tightening tighten(std::span<const Superquadric> grains, const PackingSpace &space, const LoosePacking &start,
                   const TighteningParameters &parameters, std::uint64_t seed);

} // namespace bergamo::dem
