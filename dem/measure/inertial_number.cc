#include "dem/measure/inertial_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace bergamo::dem
{

MeanGrain mean_grain(const Particles &particles)
{
  // Summed by size: the arrays are sorted by place now and then, and a rate that follows from the mean must not notice.
  std::vector<double> masses, diameters;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (!particles.is_fixed(i))
    {
      masses.push_back(particles.mass[i]);
      diameters.push_back(2. * equivalent_radius(particles.volume[i]));
    }
  const auto mean = [](std::vector<double> &values)
  {
    std::sort(values.begin(), values.end());
    return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
  };
  return masses.empty() ? MeanGrain() : MeanGrain{mean(masses), mean(diameters)};
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
