#pragma once

#include "dem/state/particles.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Sum of the grains' own volumes but for fixed ones; overlaps count twice [m^3].
double solid_volume(const Particles &particles);

/// Share of a volume [m^3] that the grains take. @throws ConfigError if it is not positive
double solid_fraction(const Particles &particles, double volume);

struct Sphere
{
  Vec3 centre;   ///< [m]
  double radius; ///< [m]
};

/// Volume that two spheres share [m^3]: a lens, the smaller sphere, or nothing.
double shared_volume(const Sphere &a, const Sphere &b);

/// Every grain but fixed ones as a sphere with its centre and volume. Images of a periodic cell are the caller's to
/// add.
std::vector<Sphere> equivalent_spheres(const Particles &particles);

/// Solid fraction in sampling spheres, each grain taken for a sphere of equal volume (Wellmann 6.4). Too low where a
/// sampling sphere reaches beyond the packing.
/// @param grains see equivalent_spheres(); @param centres of the sampling spheres [m]; @param radius theirs [m]
/// @throws ConfigError if the radius is not positive
std::vector<double> sampled_solid_fraction(std::span<const Sphere> grains, std::span<const Vec3> centres,
                                           double radius);

} // namespace bergamo::dem
