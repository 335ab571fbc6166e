#include "drivers/fit_mohr_coulomb/sand_path.h"

#include "dem/core/error.h"
#include "drivers/fit_mohr_coulomb/void_ratio.h"
#include "fe_dealii/material/hypoplastic_integration.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{
namespace
{

constexpr double longest_step = 2e-3;                    // logarithmic, over which the direction of the strain is held
constexpr fe::SubstepControl control{.tolerance = 1e-8}; // so that a fit may take differences

/// A step whose strain is known but for the multiple of a direction, at which a mean of stresses has a value.
struct Aim
{
  fe::Strain fixed, direction;
  double (*held)(const fe::Stress &); // that mean [Pa], rising with the multiple
  double value;                       // [Pa]

  fe::Strain increment(const double multiple) const
  {
    fe::Strain result = fixed;
    for (int i = 0; i < 6; ++i)
      result[i] += multiple * direction[i];
    return result;
  }
  /// Derivative of the mean by the multiple.
  double slope(const fe::Moduli &moduli) const
  {
    fe::Stress along{};
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        along[i] += moduli[i][j] * direction[j];
    return held(along);
  }
};

/// Newton's steps to the multiple. @param multiple where to start, and the one found
fe::SandState reach(const Aim &aim, const fe::HypoplasticSand &sand, const fe::SandState &start, double &multiple)
{
  constexpr int most_steps = 50;
  for (int k = 0; k < most_steps; ++k)
  {
    const fe::Strain increment = aim.increment(multiple);
    const fe::SandUpdate next = fe::update(sand, start, increment, control);
    if (next.status != fe::SandUpdateStatus::done)
      break;
    const double miss = aim.held(next.state.stress) - aim.value;
    if (std::abs(miss) <= 1e-9 * std::abs(aim.value))
      return next.state;
    // That of the end serves: it is the derivative but for what the step changes in it.
    const double slope = aim.slope(sand.response(next.state).tangent(increment));
    if (!(slope > 0))
      break;
    multiple -= miss / slope;
  }
  throw RunError("no strain holds a stress of " + std::to_string(aim.value) +
                 " Pa on the sand; check the fitted parameters");
}

double lateral(const fe::Stress &stress)
{
  return 0.5 * (stress[0] + stress[1]);
}

} // namespace

TriaxialCurve drive_triaxial(const fe::HypoplasticSand &sand, const TriaxialStart &start,
                             const std::span<const double> axial_strains)
{
  const double p = start.confining_pressure;
  fe::SandState state{{-p, -p, -p, 0, 0, 0}, void_ratio_of(start.initial_solid_fraction)};
  const double volume_at_start = 1 + state.void_ratio;
  double done = 0, share = -0.3; // logarithmic axial strain; lateral strain over axial
  TriaxialCurve curve;
  for (const double axial_strain : axial_strains)
  {
    const double to = std::log1p(axial_strain);
    const int n_steps = std::max(1, static_cast<int>(std::ceil(std::abs(to - done) / longest_step)));
    const double step = (to - done) / n_steps;
    for (int k = 0; k < n_steps && step != 0; ++k)
    {
      double lateral_strain = share * step;
      state = reach({{0, 0, step, 0, 0, 0}, {1, 1, 0, 0, 0, 0}, lateral, -p}, sand, state, lateral_strain);
      share = lateral_strain / step;
    }
    done = to;
    const double volumetric = (1 + state.void_ratio) / volume_at_start - 1;
    curve.axial_strain.push_back(axial_strain);
    curve.volumetric_strain.push_back(volumetric);
    curve.axial_stress.push_back(state.stress[2]);
    curve.lateral_stress.push_back(lateral(state.stress));
    curve.solid_fraction.push_back(start.initial_solid_fraction / (1 + volumetric));
  }
  return curve;
}

std::vector<double> compress(const fe::HypoplasticSand &sand, const std::span<const double> pressures,
                             const double solid_fraction)
{
  const double p = pressures.front();
  fe::SandState state{{-p, -p, -p, 0, 0, 0}, void_ratio_of(solid_fraction)};
  std::vector<double> result;
  for (const double pressure : pressures)
  {
    const double miss = pressure + fe::mean_stress(state.stress);
    double strain = -miss / (3 * sand.response(state).greatest_modulus());
    if (miss > 0)
      state = reach({{}, {1, 1, 1, 0, 0, 0}, fe::mean_stress, -pressure}, sand, state, strain);
    result.push_back(1 / (1 + state.void_ratio));
  }
  return result;
}

std::vector<double> compress(const fe::MohrCoulomb &material, const std::span<const double> pressures,
                             const double solid_fraction)
{
  std::vector<double> result{solid_fraction};
  for (std::size_t i = 1; i < pressures.size(); ++i)
  {
    const double middle = 0.5 * (pressures[i - 1] + pressures[i]);
    const double factor = material.depends_on_pressure() ? material.stiffness_factor(-middle) : 1;
    const double volumetric = -(pressures[i] - pressures[i - 1]) / (factor * material.bulk_modulus());
    result.push_back(result.back() / (1 + volumetric));
  }
  return result;
}

} // namespace bergamo::driver
