#pragma once

#include <array>
#include <cmath>

namespace bergamo::fe
{

/// Symmetric stress, xx yy zz xy yz zx [Pa], global frame, tension positive.
using Stress = std::array<double, 6>;

/// Symmetric strain, xx yy zz xy yz zx [-], tension positive. Shears are engineering shears (twice the tensor's
/// component), so that the plain sum of products with a Stress is an energy density.
using Strain = std::array<double, 6>;

/// Derivative of a Stress by a Strain, [stress component][strain component] [Pa].
using Moduli = std::array<std::array<double, 6>, 6>;

/// Moduli of an isotropic elastic solid. @param lame, shear moduli λ, G [Pa]
inline Moduli isotropic_moduli(const double lame, const double shear)
{
  Moduli moduli{};
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
      moduli[i][j] = lame;
    moduli[i][i] += 2 * shear;
    moduli[3 + i][3 + i] = shear;
  }
  return moduli;
}

/// stress : strain [J/m³].
inline double energy_density(const Stress &stress, const Strain &strain)
{
  double sum = 0;
  for (int i = 0; i < 6; ++i)
    sum += stress[i] * strain[i];
  return sum;
}

/// Mean stress tr/3 [Pa], tension positive (the pressure is its negative).
inline double mean_stress(const Stress &stress)
{
  return (stress[0] + stress[1] + stress[2]) / 3;
}

/// Second invariant of the deviator, J2 = s:s/2 [Pa²].
inline double second_invariant(const Stress &stress)
{
  const double mean = mean_stress(stress);
  const double x = stress[0] - mean, y = stress[1] - mean, z = stress[2] - mean;
  return 0.5 * (x * x + y * y + z * z) + stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5];
}

/// ‖σ‖ = sqrt(σ:σ) [Pa].
inline double stress_norm(const Stress &stress)
{
  const double normal = stress[0] * stress[0] + stress[1] * stress[1] + stress[2] * stress[2];
  return std::sqrt(normal + 2 * (stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5]));
}

/// ‖ε‖ = sqrt(ε:ε) [-].
inline double strain_norm(const Strain &strain)
{
  const double normal = strain[0] * strain[0] + strain[1] * strain[1] + strain[2] * strain[2];
  return std::sqrt(normal + 0.5 * (strain[3] * strain[3] + strain[4] * strain[4] + strain[5] * strain[5]));
}

/// ½ σ : C⁻¹ : σ of an isotropic elastic solid [J/m³]. @param bulk, shear moduli K, G [Pa]
inline double elastic_energy_density(const Stress &stress, const double bulk, const double shear)
{
  const double mean = mean_stress(stress);
  return second_invariant(stress) / (2 * shear) + mean * mean / (2 * bulk);
}

/// Equivalent shear strain sqrt(2/3 e:e) of the deviator e [-]; for uniaxial isochoric strain it is the axial strain.
inline double equivalent_strain(const Strain &strain)
{
  const double mean = (strain[0] + strain[1] + strain[2]) / 3;
  const double x = strain[0] - mean, y = strain[1] - mean, z = strain[2] - mean;
  const double shear = strain[3] * strain[3] + strain[4] * strain[4] + strain[5] * strain[5];
  return std::sqrt((2 * (x * x + y * y + z * z) + shear) / 3);
}

} // namespace bergamo::fe
