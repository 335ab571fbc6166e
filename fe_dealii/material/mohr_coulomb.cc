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

double sine(const double degrees)
{
  return std::sin(degrees * std::numbers::pi / 180);
}

} // namespace

double MohrCoulombParameters::least_dilation_angle() const
{
  // MohrCoulombSurface::brings_back(), solved for sin ψ.
  const double f = sine(friction_angle);
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

double MohrCoulombParameters::sine_of_steady_friction() const
{
  const double f = sine(friction_angle), s = sine(dilation_angle);
  return (f - s) / (1 - f * s);
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
  require(hardening_strain >= 0 && std::isfinite(hardening_strain), "hardening_strain", hardening_strain,
          "give a positive number, some 0.001 for sand, or zero for a friction that is there at once");
  if (hardening_strain > 0)
    require(initial_friction_angle > 0 && initial_friction_angle <= friction_angle, "initial_friction_angle [degrees]",
            initial_friction_angle, "choose it above 0, at most the friction angle");
  require(density > 0 && std::isfinite(density), "density [kg/m^3]", density, "give a positive number");
}

MohrCoulomb::MohrCoulomb(const MohrCoulombParameters &parameters)
    : parameters_((parameters.validate(), parameters)),
      bulk_(parameters.young_modulus / (3 * (1 - 2 * parameters.poisson_ratio))),
      shear_(parameters.young_modulus / (2 * (1 + parameters.poisson_ratio))), lame_(bulk_ - 2 * shear_ / 3),
      surface_(sine(parameters.friction_angle), sine(parameters.dilation_angle), parameters.cohesion, bulk_, shear_),
      sin_initial_(sine(parameters.initial_friction_angle)), sin_steady_(parameters.sine_of_steady_friction())
{
  require_flow_to_bring_back();
  if (depends_on_pressure())
  {
    const double least_pressure = least_pressure_share * parameters_.reference_pressure;
    stored_below_ = least_pressure * least_pressure * (0.5 - 1 / (2 - parameters_.stiffness_exponent)) /
                    stiffness_factor(-least_pressure);
  }
}

void MohrCoulomb::require_flow_to_bring_back() const
{
  // Between both ends of the hardening, where the product of both sines is least; validate() has looked at its end.
  constexpr int steps = 64;
  for (int step = 0; hardens() && step < steps; ++step)
  {
    const double friction = sin_initial_ + (surface_.friction - sin_initial_) * step / steps;
    const MohrCoulombSurface<double> surface(friction, sine_of_dilation(friction), parameters_.cohesion, bulk_, shear_);
    require(surface.brings_back(), "dilation_angle [degrees]", parameters_.dilation_angle,
            "raise it or the initial friction angle: on the way to the full friction this much contraction lets no "
            "flow bring a stress back to the yield surface");
  }
}

double MohrCoulomb::yield_function(const Stress &stress, const MohrCoulombSurface<double> &surface)
{
  const PrincipalFrame<double> frame = principal_frame(stress);
  return frame.value[0] - frame.value[2] + (frame.value[0] + frame.value[2]) * surface.friction -
         2 * surface.cohesion_cos;
}

double MohrCoulomb::mobilising_strain(const Stress &stress) const
{
  if (!hardens() || yield_function(stress, 0) <= 0)
    return 0;
  // Φ = d + s sin φ_m − 2 c cos φ_m falls with φ_m for a stress within the full strength, so bisection holds its root.
  double inside = 1 - 1e-6, beyond = 0; // shares κ/(a + κ) of the gain
  const auto strain_of = [&](const double share) { return parameters_.hardening_strain * share / (1 - share); };
  for (int halving = 0; halving < 60; ++halving)
  {
    const double middle = 0.5 * (inside + beyond);
    (yield_function(stress, strain_of(middle)) <= 0 ? inside : beyond) = middle;
  }
  return strain_of(inside);
}

StressUpdate MohrCoulomb::update(const Stress &stress_old, const Strain &strain_increment,
                                 const double plastic_strain) const
{
  const double stiffness = depends_on_pressure() ? stiffness_factor(mean_stress(stress_old)) : 1;
  Stress trial = elastic_stress(strain_increment);
  for (int i = 0; i < 6; ++i)
    trial[i] = stress_old[i] + stiffness * trial[i];
  if (is_surely_elastic(mean_stress(trial), second_invariant(trial), plastic_strain))
    return {trial, {}, Sector::elastic, 0};
  return return_to_surface(stress_old, trial, principal_frame(trial), stiffness, plastic_strain);
}

StressUpdate MohrCoulomb::return_to_surface(const Stress &stress_old, const Stress &stress_trial,
                                            const PrincipalFrame<double> &frame, const double stiffness,
                                            const double plastic_strain) const
{
  const PrincipalReturn<double> returned = return_principal(frame.value, plastic_strain);
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
