#include "drivers/overlap_waves/lattice.h"

#include "dem/law/hertz.h"

#include <cmath>
#include <numbers>

namespace bergamo::driver
{
namespace
{

/// The wave's equation in W = w^2 / (k / m) and its derivatives, over s^2.
struct Dispersion
{
  double root;  ///< W
  double slope; ///< dW / d(s^2)
};

Dispersion compression(const double square)
{
  return {4. * square, 4.};
}

Dispersion shear(const double square, const double j)
{
  const double half = 0.5 * (4. * j * square + 2. - square);
  const double root = 4. * square / (half + std::sqrt(half * half - 4. * j * square));
  return {root, (4. - (4. * j - 1.) * root) / (2. * half - 2. * j * root)};
}

} // namespace

double CubicLattice::speed(const Wave wave) const
{
  return std::sqrt(modulus(wave) / density());
}

double CubicLattice::frequency(const Wave wave, const double wave_number) const
{
  const double s = std::sin(0.5 * wave_number * spacing);
  return wave == Wave::compression
             ? std::sqrt(normal / mass * compression(s * s).root)
             : std::sqrt(tangential / mass * shear(s * s, inertia / (mass * spacing * spacing)).root);
}

double CubicLattice::group_velocity(const Wave wave, const double wave_number) const
{
  const double angle = 0.5 * wave_number * spacing, s = std::sin(angle), c = std::cos(angle);
  const Dispersion w =
      wave == Wave::compression ? compression(s * s) : shear(s * s, inertia / (mass * spacing * spacing));
  const double stiffness = wave == Wave::compression ? normal : tangential;
  return 0.5 * std::sqrt(stiffness / (mass * w.root)) * w.slope * spacing * s * c;
}

fe::ElasticParameters CubicLattice::continuum() const
{
  const double m = modulus(Wave::compression), g = modulus(Wave::shear);
  return {.young_modulus = g * (3. * m - 4. * g) / (m - g),
          .poisson_ratio = (m - 2. * g) / (2. * (m - g)),
          .density = density()};
}

CubicLattice press_lattice(const double radius, const dem::Material &material, const double pressure)
{
  const dem::HertzMindlin<double> law =
      dem::hertz_mindlin(1. / radius, 1. / radius, dem::elastic_pair(material, material));
  CubicLattice lattice;
  for (int round = 0; round < 50; ++round) // the spacing falls with the overlap, by a factor of its share a round
  {
    lattice.spacing = 2. * radius - lattice.overlap;
    lattice.overlap = std::pow(pressure * lattice.spacing * lattice.spacing / law.normal, 2. / 3.);
  }
  lattice.normal = 1.5 * law.normal * std::sqrt(lattice.overlap);
  lattice.tangential = law.tangential_major * std::sqrt(lattice.overlap);
  lattice.mass = 4. / 3. * std::numbers::pi * radius * radius * radius * material.density;
  lattice.inertia = 0.4 * lattice.mass * radius * radius;
  return lattice;
}

} // namespace bergamo::driver
