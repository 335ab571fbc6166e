#include "coupling/model/stable_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bergamo::coupling
{

double StableSteps::combined() const
{
  double least = std::numeric_limits<double>::infinity();
  for (const OfMover &mover : movers)
  {
    double square = 1. / (mover.step * mover.step);
    for (const std::size_t k : mover.couplings)
      square += 1. / (couplings[k].step * couplings[k].step);
    least = std::min(least, 1. / std::sqrt(square));
  }
  return least;
}

} // namespace bergamo::coupling
