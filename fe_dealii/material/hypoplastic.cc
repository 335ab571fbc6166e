#include "fe_dealii/material/hypoplastic.h"

#include "fe_dealii/material/matsuoka_nakai.h"
#include "fe_dealii/material/principal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bergamo::fe
{

bool cut_tension(Stress &stress)
{
  // No principal stress exceeds the mean by more than 2 √(J2/3), so most stresses need no eigenvalues.
  if (mean_stress(stress) + 2 * std::sqrt(second_invariant(stress) / 3) <= 0)
    return false;
  PrincipalFrame<double> frame = principal_frame(stress);
  if (!(frame.value[0] > 0))
    return false;
  for (double &value : frame.value)
    value = std::min(value, 0.);
  stress = from_principal(frame.value, frame.direction);
  return true;
}

Stress HypoplasticResponse::rate(const Strain &strain_rate) const
{
  const double along_ratio = volume * energy_density(ratio, strain_rate);
  const double size = strain_norm(strain_rate);
  Stress result;
  for (int i = 0; i < 6; ++i)
    result[i] = shear * (i < 3 ? 1 : 0.5) * strain_rate[i] + along_ratio * ratio[i] + size * flow[i];
  return result;
}

double HypoplasticResponse::greatest_modulus() const
{
  const double of_ratio = stress_norm(ratio);
  return shear + volume * of_ratio * of_ratio + stress_norm(flow);
}

Moduli HypoplasticResponse::tangent(const Strain &strain_rate) const
{
  const double size = strain_norm(strain_rate);
  Moduli moduli{};
  for (int i = 0; i < 6; ++i)
  {
    moduli[i][i] = (i < 3 ? 1 : 0.5) * shear;
    for (int j = 0; j < 6; ++j)
    {
      const double direction = size > 0 ? (j < 3 ? 1 : 0.5) * strain_rate[j] / size : 0; // of ‖D‖ by its components
      moduli[i][j] += volume * ratio[i] * ratio[j] + flow[i] * direction;
    }
  }
  return moduli;
}

HypoplasticSand::HypoplasticSand(const HypoplasticParameters &parameters) : p_(parameters)
{
  parameters.validate();
  a_ = parameters.strength_factor();
  stiffness_ = parameters.granulate_hardness / parameters.compression_exponent *
               std::pow(parameters.loosest_void_ratio / parameters.critical_void_ratio, parameters.stiffness_exponent) /
               parameters.loosest_compression();
  modulus_ = response({{}, parameters.initial_void_ratio}).greatest_modulus();
}

double HypoplasticSand::compression_power(const double pressure) const
{
  return std::pow(3 * pressure / p_.granulate_hardness, p_.compression_exponent);
}

LimitVoidRatios HypoplasticSand::limits_at(const double compression_power) const
{
  const double share = std::exp(-compression_power);
  return {p_.densest_void_ratio * share, p_.critical_void_ratio * share, p_.loosest_void_ratio * share};
}

LimitVoidRatios HypoplasticSand::limit_void_ratios(const double pressure) const
{
  return limits_at(compression_power(pressure));
}

HypoplasticResponse HypoplasticSand::response(const SandState &state) const
{
  const double mean = mean_stress(state.stress), pressure = std::max(-mean, p_.least_pressure);

  HypoplasticResponse response;
  Stress deviator; // T̂*
  for (int i = 0; i < 6; ++i)
  {
    deviator[i] = (state.stress[i] - (i < 3 ? mean : 0)) / (-3 * pressure);
    response.ratio[i] = deviator[i] + (i < 3 ? 1. / 3 : 0);
  }

  const double power = compression_power(pressure);
  const auto [densest, critical, loosest] = limits_at(power);
  const double e = std::clamp(state.void_ratio, densest, loosest);
  const double f_d = std::pow((e - densest) / (critical - densest), p_.pyknotropy_exponent);
  const double f_e = std::pow(critical / e, p_.stiffness_exponent);
  const double of_ratio = stress_norm(response.ratio);
  const double f_s = stiffness_ * f_e * (1 + loosest) / loosest * (3 * pressure / p_.granulate_hardness) / power /
                     (of_ratio * of_ratio);

  const double f = matsuoka_nakai_factor(deviator);
  response.shear = f_s * f * f;
  response.volume = f_s * a_ * a_;
  for (int i = 0; i < 6; ++i)
    response.flow[i] = f_s * f_d * a_ * f * (response.ratio[i] + deviator[i]);
  return response;
}

} // namespace bergamo::fe
