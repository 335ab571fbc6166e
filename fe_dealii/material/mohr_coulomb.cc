#include "fe_dealii/material/mohr_coulomb.h"

#include "fe_dealii/material/elastic_parameters.h"

#include <algorithm>
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

double MohrCoulombParameters::least_dilation_angle() const
{
  // Contraction takes the pressure from a stress beyond the surface; it must take its shear faster, on the plane and on
  // both edges: plane_, plane_ + right_ and plane_ + left_ of MohrCoulomb are positive.
  const double f = std::sin(friction_angle * std::numbers::pi / 180);
  const double bulk_over_shear = 2 * (1 + poisson_ratio) / (3 * (1 - 2 * poisson_ratio));
  const double on_plane = f * (1. / 3 + bulk_over_shear), on_edge = f * (1. / 3 + 4 * bulk_over_shear);
  double least = -1.; // of sin ψ
  if (on_plane > 0)
    least = std::max(least, -1 / on_plane);
  if (on_edge > 1)
    least = std::max(least, (f - 3) / (on_edge - 1));
  least = std::max(least, -(3 + f) / (1 + on_edge));
  return std::asin(least) * 180 / std::numbers::pi;
}

void MohrCoulombParameters::validate() const
{
  // Written so that NaN fails every one.
  require(young_modulus > 0 && std::isfinite(young_modulus), "young_modulus [Pa]", young_modulus,
          "give a positive number");
  require(poisson_ratio >= 0 && poisson_ratio < 0.5, "poisson_ratio", poisson_ratio, "choose it in [0, 0.5)");
  require(friction_angle >= 0 && friction_angle < 90, "friction_angle [degrees]", friction_angle,
          "choose it in [0, 90)");
  require(dilation_angle <= friction_angle, "dilation_angle [degrees]", dilation_angle,
          "choose at most the friction angle; above it, flow would create energy");
  require(dilation_angle > least_dilation_angle(), "dilation_angle [degrees]", dilation_angle,
          "give it less contraction: with this much, no flow brings a stress back to the yield surface");
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
  const double middle = (2 * bulk_ - 4 * shear_ / 3) * sin_dilation_, minor = middle - 2 * shear_ * (1 - sin_dilation_);
  plane_middle_ = middle / plane_;
  plane_minor_ = minor / plane_;
  right_minor_ = 0.5 * (middle + minor) / (plane_ + right_);
  left_minor_ = minor / (plane_ + left_);
  tensile_slope_ = (1 - sin_friction_) / (1 + sin_friction_);
  tensile_start_ = 2 * cohesion_cos_ / (1 + sin_friction_);
  if (depends_on_pressure())
  {
    const double least_pressure = least_pressure_share * parameters_.reference_pressure;
    stored_below_ = least_pressure * least_pressure * (0.5 - 1 / (2 - parameters_.stiffness_exponent)) /
                    stiffness_factor(-least_pressure);
  }
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
  const PrincipalReturn<double> returned = return_principal(frame.value);
  if (!returned.yields) // a NaN stays in the stress, where it is seen
    return {stress_trial, {}, Sector::elastic, 0};

  StressUpdate result;
  result.sector = static_cast<Sector>(returned.sector);
  result.stress = from_principal(returned.value, frame.direction);
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
