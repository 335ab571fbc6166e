#include "dem/measure/solid_fraction.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace bergamo::dem
{
namespace
{

double volume_of_sphere(const double radius)
{
  return 4. / 3. * std::numbers::pi * radius * radius * radius;
}

} // namespace

double solid_volume(const Particles &particles)
{
  std::vector<double> volumes; // summed by size, so that the sum does not depend on the grains' order
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (!particles.is_fixed(i))
      volumes.push_back(particles.volume[i]);
  std::sort(volumes.begin(), volumes.end());
  return std::accumulate(volumes.begin(), volumes.end(), 0.);
}

double solid_fraction(const Particles &particles, const double volume)
{
  require(volume > 0. && std::isfinite(volume), "volume of the solid fraction", volume, "positive and finite [m^3]");
  return solid_volume(particles) / volume;
}

double shared_volume(const Sphere &a, const Sphere &b)
{
  const double sum = a.radius + b.radius, difference = a.radius - b.radius;
  const double square = (b.centre - a.centre).squaredNorm();
  if (square >= sum * sum)
    return 0.;
  if (square <= difference * difference)
    return volume_of_sphere(std::min(a.radius, b.radius));
  // Two caps (Weisstein, MathWorld "Sphere-Sphere Intersection", eq. 16), sorted so that equal radii cancel exactly.
  const double d = std::sqrt(square), depth = sum - d;
  return std::numbers::pi * depth * depth * (square + 2. * d * sum - 3. * difference * difference) / (12. * d);
}

std::vector<Sphere> equivalent_spheres(const Particles &particles)
{
  std::vector<Sphere> spheres;
  spheres.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (!particles.is_fixed(i))
      spheres.push_back({particles.position[i], equivalent_radius(particles.volume[i])});
  return spheres;
}

std::vector<double> sampled_solid_fraction(const std::span<const Sphere> grains, const std::span<const Vec3> centres,
                                           const double radius)
{
  require(radius > 0. && std::isfinite(radius), "radius of the sampling spheres", radius, "positive and finite [m]");
  std::vector<double> fractions(centres.size());
  parallel_ranges(centres.size(), 1,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t k = begin; k < end; ++k)
                    {
                      double solid = 0.;
                      for (const Sphere &grain : grains)
                        solid += shared_volume({centres[k], radius}, grain);
                      fractions[k] = solid / volume_of_sphere(radius);
                    }
                  });
  return fractions;
}

} // namespace bergamo::dem
