#include "drivers/fit_mohr_coulomb/triaxial_path.h"

#include "dem/core/error.h"

#include <cmath>

namespace bergamo::driver
{

namespace
{

struct Point
{
  fe::Stress stress;
  double plastic_strain = 0;
};

struct Step
{
  double lateral_strain; ///< increment
  Point point;           ///< after it
};

/// Secant steps for the lateral strain that holds the pressure. The residual is increasing and made of two straight
/// pieces, elastic and on the edge, so few steps end it.
Step hold_pressure(const fe::MohrCoulomb &material, const Point &point, const double axial, const double pressure)
{
  const fe::Stress &old = point.stress;
  const auto update_at = [&](const double lateral) {
    return material.update(old, {lateral, lateral, axial, 0, 0, 0}, point.plastic_strain);
  };
  const auto residual_of = [&](const fe::Stress &stress) { return 0.5 * (stress[0] + stress[1]) + pressure; };

  const double factor = material.depends_on_pressure() ? material.stiffness_factor(fe::mean_stress(old)) : 1;
  const double modulus = 2 * factor * (material.lame_modulus() + material.shear_modulus());
  // Some rounding of the trial stress, which a large step makes far larger than the pressure, is left over.
  const auto tolerance = [&](const double lateral)
  { return 1e-12 * pressure + 1e-14 * (modulus * (std::abs(axial) + std::abs(lateral)) + std::abs(old[2])); };

  double earlier = 0;
  double earlier_residual = residual_of(update_at(earlier).stress);
  double lateral = -earlier_residual / modulus;
  for (int iteration = 0; iteration < 100; ++iteration)
  {
    const fe::StressUpdate update = update_at(lateral);
    const double residual = residual_of(update.stress);
    if (std::abs(residual) <= tolerance(lateral))
      return {lateral, {update.stress, point.plastic_strain + fe::equivalent_strain(update.plastic_strain)}};
    const double slope = (residual - earlier_residual) / (lateral - earlier);
    earlier = lateral;
    earlier_residual = residual;
    lateral -= residual / (slope > 0 ? slope : modulus);
  }
  throw RunError("no lateral strain holds the pressure of " + std::to_string(pressure) +
                 " Pa on the continuum; check the fitted parameters");
}

/// The steps of a strain, where friction hardens: within each it stays that of its start.
int n_steps(const fe::MohrCoulomb &material, const double axial)
{
  constexpr double share = 0.02; // of the strain that mobilises half
  return material.hardens()
             ? static_cast<int>(std::ceil(std::abs(axial) / (share * material.parameters().hardening_strain)))
             : 1;
}

} // namespace

TriaxialCurve drive_triaxial(const fe::MohrCoulomb &material, const TriaxialStart &start,
                             const std::span<const double> axial_strains)
{
  const double p = start.confining_pressure;
  Point point{{-p, -p, -p, 0, 0, 0}};
  double axial = 0, lateral = 0;
  TriaxialCurve curve;
  for (const double next_axial : axial_strains)
  {
    const int n = n_steps(material, next_axial - axial);
    for (int k = 0; k < n; ++k)
    {
      const Step step = hold_pressure(material, point, (next_axial - axial) / n, p);
      point = step.point;
      lateral += step.lateral_strain;
    }
    axial = next_axial;
    const double volumetric = axial + 2 * lateral;
    curve.axial_strain.push_back(axial);
    curve.volumetric_strain.push_back(volumetric);
    curve.axial_stress.push_back(point.stress[2]);
    curve.lateral_stress.push_back(0.5 * (point.stress[0] + point.stress[1]));
    curve.solid_fraction.push_back(start.initial_solid_fraction / (1 + volumetric));
  }
  return curve;
}

} // namespace bergamo::driver
