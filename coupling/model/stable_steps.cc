#include "coupling/model/stable_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace bergamo::coupling
{

namespace
{

/// Largest time between two impulses of a mover's own forces [s]; see StableSteps::combined(). @param mover, coupling
/// stable steps [s]
double largest_interval(const double mover, const double coupling)
{
  double low = 0., high = std::min(mover, 0.5 * std::numbers::pi * coupling);
  for (int n = 0; n < 60; ++n)
  {
    const double interval = 0.5 * (low + high), angle = interval / coupling;
    const bool is_stable = interval * interval / (mover * mover) * std::tan(angle) < angle || angle == 0.;
    (is_stable ? low : high) = interval;
  }
  return low;
}

} // namespace

double StableSteps::combined() const
{
  double least = std::numeric_limits<double>::infinity();
  for (const OfMover &mover : movers)
  {
    double of_couplings = 0.; // squared frequencies
    for (const std::size_t k : mover.couplings)
      of_couplings += 1. / (couplings[k].step * couplings[k].step);
    least = std::min(least, mover.steps_per_force == 1
                                ? 1. / std::sqrt(1. / (mover.step * mover.step) + of_couplings)
                                : largest_interval(mover.step, 1. / std::sqrt(of_couplings)) / mover.steps_per_force);
  }
  return least;
}

} // namespace bergamo::coupling
