#pragma once

#include "drivers/fit_mohr_coulomb/ensemble.h"
#include "drivers/fit_mohr_coulomb/triaxial_path.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

/// Triaxial tests made by the Mohr-Coulomb material itself, with parameters that are none of the defaults.
namespace synthetic
{

using namespace bergamo;
using namespace bergamo::driver;

inline fe::MohrCoulombParameters known()
{
  return {.young_modulus = 80e6,
          .poisson_ratio = 0.21,
          .friction_angle = 31.5,
          .dilation_angle = 8.25,
          .cohesion = 15,
          .density = 1700};
}

/// Compressions from 0 to 20 %: 41 rows to 0.02 %, then 0.01 % apart.
inline std::vector<double> axial_strains()
{
  std::vector<double> strains;
  for (int i = 0; i <= 40; ++i)
    strains.push_back(-5e-6 * i);
  for (int i = 3; i <= 2000; ++i)
    strains.push_back(-1e-4 * i);
  return strains;
}

inline TriaxialCurve curve(const double pressure, const fe::MohrCoulombParameters &parameters = known(),
                           const double solid_fraction = 0.66)
{
  return drive_triaxial(fe::MohrCoulomb(parameters), {pressure, solid_fraction}, axial_strains());
}

/// Adds normally distributed noise, of its own in every row, by Box and Muller from the seed alone.
inline void add_noise(std::vector<double> &values, const double deviation, const std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  for (double &value : values)
    value += deviation * std::sqrt(-2 * std::log(uniform())) * std::cos(2 * 3.141592653589793 * uniform());
}

inline Sample sample(const int number, const double pressure, TriaxialCurve curve)
{
  return {number, 0.01, 0.15, pressure, 1700, std::move(curve)};
}

} // namespace synthetic
