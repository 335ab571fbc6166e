#include "fe_dealii/material/mohr_coulomb.h"

#include "fe_dealii/material/elastic_parameters.h"

#include <cmath>
#include <numbers>

namespace bergamo::fe
{
namespace
{

void require(const bool holds, const char *name, const double value, const char *rule)
{
  require_parameter(holds, "Mohr-Coulomb material", name, value, rule);
}

} // namespace

void MohrCoulombParameters::validate() const
{
  // Written so that NaN fails every one.
  require(young_modulus > 0 && std::isfinite(young_modulus), "young_modulus [Pa]", young_modulus,
          "give a positive number");
  require(poisson_ratio >= 0 && poisson_ratio < 0.5, "poisson_ratio", poisson_ratio, "choose it in [0, 0.5)");
  require(friction_angle >= 0 && friction_angle < 90, "friction_angle [degrees]", friction_angle,
          "choose it in [0, 90)");
  require(dilation_angle >= 0 && dilation_angle <= friction_angle, "dilation_angle [degrees]", dilation_angle,
          "choose it between 0 and the friction angle; above it, flow would create energy");
  require(cohesion >= 0 && std::isfinite(cohesion), "cohesion [Pa]", cohesion, "give zero or a positive number");
  require(cohesion > 0 || friction_angle > 0, "cohesion [Pa]", cohesion,
          "with a friction angle of zero it must be positive, otherwise the material has no strength");
  require(reference_pressure >= 0 && std::isfinite(reference_pressure), "reference_pressure [Pa]", reference_pressure,
          "give a positive number, or zero for a stiffness that does not depend on the pressure");
  require(stiffness_exponent >= 0 && stiffness_exponent <= 1, "stiffness_exponent", stiffness_exponent,
          "choose it in [0, 1]; 1/3 for contacts after Hertz, about 0.5 for sands");
  require(density > 0 && std::isfinite(density), "density [kg/m^3]", density, "give a positive number");
}

MohrCoulomb::MohrCoulomb(const MohrCoulombParameters &parameters) : parameters_(parameters)
{
  parameters.validate();
  const double e = parameters.young_modulus, nu = parameters.poisson_ratio;
  bulk_ = e / (3 * (1 - 2 * nu));
  shear_ = e / (2 * (1 + nu));
  lame_ = bulk_ - 2 * shear_ / 3;
  const double friction = parameters.friction_angle * std::numbers::pi / 180;
  sin_friction_ = std::sin(friction);
  sin_dilation_ = std::sin(parameters.dilation_angle * std::numbers::pi / 180);
  cohesion_cos_ = parameters.cohesion * std::cos(friction);
  worst_lode_ = 1 + sin_friction_ * sin_friction_ / 3;
  apex_ = sin_friction_ > 0 ? cohesion_cos_ / sin_friction_ : 0;
  const double product = sin_friction_ * sin_dilation_, sum = sin_friction_ + sin_dilation_;
  plane_ = 4 * shear_ * (1 + product / 3) + 4 * bulk_ * product;
  right_ = 2 * shear_ * (1 + sum - product / 3) + 4 * bulk_ * product;
  left_ = 2 * shear_ * (1 - sum - product / 3) + 4 * bulk_ * product;
}

double MohrCoulomb::yield_function(const Stress &stress) const
{
  const PrincipalFrame<double> frame = principal_frame(stress);
  return frame.value[0] - frame.value[2] + (frame.value[0] + frame.value[2]) * sin_friction_ - 2 * cohesion_cos_;
}

StressUpdate MohrCoulomb::update(const Stress &stress_old, const Strain &strain_increment) const
{
  const double stiffness = depends_on_pressure() ? stiffness_factor(mean_stress(stress_old)) : 1;
  Stress trial = elastic_stress(strain_increment);
  for (int i = 0; i < 6; ++i)
    trial[i] = stress_old[i] + stiffness * trial[i];
  if (is_surely_elastic(mean_stress(trial), second_invariant(trial)))
    return {trial, {}, Sector::elastic, 0};
  return return_to_surface(stress_old, trial, principal_frame(trial), stiffness);
}

StressUpdate MohrCoulomb::return_to_surface(const Stress &stress_old, const Stress &stress_trial,
                                            const PrincipalFrame<double> &frame, const double stiffness) const
{
  const double t1 = frame.value[0], t2 = frame.value[1], t3 = frame.value[2];
  const double phi = t1 - t3 + (t1 + t3) * sin_friction_ - 2 * cohesion_cos_;
  if (!(phi > 0)) // a NaN stays in the stress, where it is seen
    return {stress_trial, {}, Sector::elastic, 0};

  const double s = sin_dilation_;
  // Stress change per unit of multiplier of a plane with flow (1 + s, 0, −1 + s): the middle and the most compressive
  // component of C : flow.
  const double middle = (2 * bulk_ - 4 * shear_ / 3) * s;
  const double minor = 2 * shear_ * (s / 3 - 1) + 2 * bulk_ * s;
  // The most tensile stress follows from Φ = 0 and the most compressive one, so that Φ = 0 holds to rounding.
  const auto tensile_of = [&](const double compressive)
  { return (compressive * (1 - sin_friction_) + 2 * cohesion_cos_) / (1 + sin_friction_); };

  double value[3];
  Sector sector = Sector::main_plane;
  const double multiplier = phi / plane_;
  value[2] = t3 - minor * multiplier;
  value[1] = t2 - middle * multiplier;
  value[0] = tensile_of(value[2]);
  if (!(value[0] >= value[1] && value[1] >= value[2]))
  {
    // The plane through the hydrostatic axis along the flow splits what goes to either edge (ibid. 8.2.3). On the side
    // chosen, the middle stress has overtaken its neighbour, so both multipliers come out positive. Only their sum,
    // (Φ + Φ2)/(a + b), enters.
    if ((1 - s) * t1 - 2 * t2 + (1 + s) * t3 >= 0)
    {
      sector = Sector::right_edge; // second plane: (σ1, σ2)
      const double phi_2 = t1 - t2 + (t1 + t2) * sin_friction_ - 2 * cohesion_cos_;
      value[2] = 0.5 * (t2 + t3 - (middle + minor) * (phi + phi_2) / (plane_ + right_));
      value[1] = value[2];
      value[0] = tensile_of(value[2]);
    }
    else
    {
      sector = Sector::left_edge; // second plane: (σ2, σ3)
      const double phi_2 = t2 - t3 + (t2 + t3) * sin_friction_ - 2 * cohesion_cos_;
      value[2] = t3 - minor * (phi + phi_2) / (plane_ + left_);
      value[0] = tensile_of(value[2]);
      value[1] = value[0];
    }
    // Beyond the apex the surface's mirror image waits. Without dilation the flow rule alone cannot lower the mean
    // stress; the apex is then the nearest admissible state.
    if (!(value[0] >= value[2]) && sin_friction_ > 0)
    {
      sector = Sector::apex;
      value[0] = value[1] = value[2] = apex_;
    }
  }

  StressUpdate result;
  result.sector = sector;
  result.stress = from_principal(value, frame.direction);
  Stress relaxed, middle_stress;
  for (int i = 0; i < 6; ++i)
  {
    relaxed[i] = stress_trial[i] - result.stress[i];
    middle_stress[i] = 0.5 * (stress_old[i] + result.stress[i]);
  }
  // Multipliers and moduli scale inversely, so the stress above is the same for any stiffness.
  result.plastic_strain = elastic_strain(relaxed);
  for (double &component : result.plastic_strain)
    component /= stiffness;
  result.plastic_dissipation = energy_density(middle_stress, result.plastic_strain);
  return result;
}

} // namespace bergamo::fe
