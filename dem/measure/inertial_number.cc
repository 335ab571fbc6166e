#include "dem/measure/inertial_number.h"

#include <cmath>
#include <limits>

namespace bergamo::dem
{

MeanGrain mean_grain(const Particles &particles)
{
  MeanGrain sum;
  double n = 0.;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (particles.is_fixed(i))
      continue;
    sum.mass += particles.mass[i];
    sum.diameter += 2. * equivalent_radius(particles.volume[i]);
    n += 1.;
  }
  return n > 0. ? MeanGrain{sum.mass / n, sum.diameter / n} : MeanGrain();
}

double inertial_number(const MeanGrain &grain, const double strain_rate, const double pressure)
{
  if (!(pressure > 0.))
    return std::numeric_limits<double>::infinity();
  return std::abs(strain_rate) * std::sqrt(grain.mass / (grain.diameter * pressure));
}

double strain_rate_of(const MeanGrain &grain, const double inertial_number, const double pressure)
{
  return pressure > 0. ? inertial_number * std::sqrt(grain.diameter * pressure / grain.mass) : 0.;
}

} // namespace bergamo::dem
