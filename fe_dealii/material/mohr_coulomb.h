#pragma once

#include "fe_dealii/material/mohr_coulomb_surface.h"
#include "fe_dealii/material/principal.h"
#include "fe_dealii/material/tensor.h"

#include <array>
#include <cmath>

namespace bergamo::fe
{

/// Elastic and strength parameters of a granular continuum. The defaults are those that Wellmann (dissertation,
/// sec. 5.4) fitted to his grains; the density has no meaningful default for another packing, so set it.
struct MohrCoulombParameters
{
  double young_modulus = 60e6;   ///< [Pa], > 0
  double poisson_ratio = 0.145;  ///< [-], in [0, 0.5)
  double friction_angle = 23.15; ///< [degrees], in [0, 90), at least dilation_angle
  double dilation_angle = 5.17;  ///< [degrees], from least_dilation_angle() to friction_angle; negative: flow contracts
  double cohesion = 15;          ///< [Pa], >= 0; not zero together with the friction angle
  double density = 1600;         ///< of the packing as a whole [kg/m³], > 0
  double reference_pressure = 0; ///< p_r at which the Young's modulus holds [Pa]; 0: it holds at any pressure
  double stiffness_exponent = 0.5; ///< m: the modulus grows as (p/p_r)^m [-], in [0, 1]
  double hardening_strain = 0;     ///< a: plastic strain that mobilises half of what friction can gain; 0: all is there
  double initial_friction_angle = 5; ///< φ0 [degrees], in (0, friction_angle], where the friction hardens

  /// Dilation angle, negative, from which on contraction takes the pressure from a stress faster than its shear, so
  /// that no flow brings it back to the yield surface [degrees].
  double least_dilation_angle() const;

  /// sin φ_cv, of steady flow, that Rowe's relation takes from both angles.
  double sine_of_steady_friction() const;

  /// Throws ConfigError that names the first value outside its range.
  void validate() const;
};

struct StressUpdate
{
  Stress stress;              ///< new stress
  Strain plastic_strain;      ///< increment
  Sector sector;              ///< where the new stress lies
  double plastic_dissipation; ///< ½(σ_old + σ_new) : Δε_p [J/m³]; closes the balance of a leapfrog exactly
};

/// Small-strain, non-associative Mohr–Coulomb law: with σ1 >= σ2 >= σ3, tension positive,
///   Φ = σ1 − σ3 + (σ1 + σ3) sin φ − 2 c cos φ <= 0,   flow along ∂Ψ/∂σ, Ψ = Φ with ψ in place of φ.
/// A negative ψ is that of loose sand, which contracts as it is sheared: at constant volume its pressure falls.
/// Implicit return in principal stresses, closed form, see MohrCoulombSurface.
///
/// Perfectly plastic without a hardening strain a. With one the friction is mobilised by the plastic strain κ, from φ0
/// on, along a hyperbola, and the dilation follows it (Rowe 1962; Vermeer and de Borst 1984, sec. 5):
///   sin φ_m = sin φ0 + (sin φ − sin φ0) κ/(a + κ),   sin ψ_m = (sin φ_m − sin φ_cv)/(1 − sin φ_m sin φ_cv),
/// with the φ_cv of steady flow for which ψ_m is ψ at φ: sand contracts at first, and dilates once its friction exceeds
/// that. κ is the sum of equivalent_strain() over the plastic increments; an increment takes both angles of its start.
///
/// With a reference pressure both moduli grow as (p/p_r)^m of the pressure p at the start of an increment, from a
/// hundredth of p_r on (Janbu 1963; m = 1/3 for Hertz contacts, about 0.5 for sands). Poisson's ratio stays. Such a law
/// has no potential: a closed loop of stress may gain or lose elastic work, see elastic_energy_density().
/// All members are pure, free of allocation, exceptions and virtual calls.
class MohrCoulomb
{
public:
  /// Throws ConfigError.
  explicit MohrCoulomb(const MohrCoulombParameters &parameters);

  /// Stress after a strain increment from an admissible stress. Works for increments of any size.
  /// @param plastic_strain κ before the increment [-]
  StressUpdate update(const Stress &stress_old, const Strain &strain_increment, double plastic_strain = 0) const;

  /// The plastic half of update(): brings an elastic trial stress back to the yield surface (or leaves it inside).
  /// `frame` is the principal frame of the trial stress, `stiffness` the factor of the moduli in this increment.
  StressUpdate return_to_surface(const Stress &stress_old, const Stress &stress_trial,
                                 const PrincipalFrame<double> &frame, double stiffness = 1,
                                 double plastic_strain = 0) const;

  /// Principal trial stresses, falling, back to the surface that a plastic strain has mobilised.
  template <class Real>
  PrincipalReturn<Real> return_principal(const Real (&trial)[3], const Real &plastic_strain = Real(0.)) const
  {
    return hardens() ? surface(plastic_strain).return_principal(trial) : surface_.return_principal(trial);
  }

  /// Derivative of update()'s stress by the strain increment; exact, since the return is linear in each sector. Not
  /// symmetric where dilation and friction angle differ.
  Moduli tangent(const Stress &stress_old, const Strain &strain_increment, double plastic_strain = 0) const;

  bool hardens() const { return parameters_.hardening_strain > 0; }
  bool depends_on_pressure() const { return parameters_.reference_pressure > 0; }

  /// sin φ_m; `plastic_strain` κ may be a pack, here and below.
  template <class Real>
  Real sine_of_friction(const Real &plastic_strain) const
  {
    const double gain = surface_.friction - sin_initial_;
    return hardens() ? Real(sin_initial_ + gain * (plastic_strain / (parameters_.hardening_strain + plastic_strain)))
                     : Real(surface_.friction);
  }
  /// sin ψ_m of a sin φ_m.
  template <class Real>
  Real sine_of_dilation(const Real &sine_of_friction) const
  {
    return hardens() ? Real((sine_of_friction - sin_steady_) / (1. - sine_of_friction * sin_steady_))
                     : Real(surface_.dilation);
  }
  template <class Real>
  MohrCoulombSurface<Real> surface(const Real &plastic_strain) const
  {
    const Real friction = sine_of_friction(plastic_strain);
    return {friction, sine_of_dilation(friction), parameters_.cohesion, bulk_, shear_};
  }

  /// κ of the surface through a stress, which must not exceed the full strength; zero where the initial one holds it
  /// or nothing hardens. Of a stress at the full strength, which no κ mobilises, as much as leaves a millionth to gain.
  double mobilising_strain(const Stress &stress) const;

  /// Factor of the moduli at a mean stress, tension positive. `mean` may be a SIMD pack.
  template <class Real>
  Real stiffness_factor(const Real &mean) const
  {
    const Real share = mean * (-1 / parameters_.reference_pressure);
    return math::library_pow(math::select(share > least_pressure_share, share, Real(least_pressure_share)),
                             parameters_.stiffness_exponent);
  }

  /// Energy that a stress stores [J/m³]: ∫ p dp/K over the pressure, and J2/2G with the present shear modulus. Where
  /// the moduli depend on the pressure, a change of p under shear stress takes J2/2G dG/G of elastic work beside it, or
  /// gives it. @param mean mean stress, tension positive; @param j2 see second_invariant(); both may be SIMD packs
  template <class Real>
  Real elastic_energy_density(const Real &mean, const Real &j2) const
  {
    if (!depends_on_pressure())
      return mean * mean * (0.5 / bulk_) + j2 * (0.5 / shear_);
    return elastic_energy_density(mean, j2, Real(1. / stiffness_factor(mean)));
  }

  /// The same with the inverse of stiffness_factor(), where that is known.
  template <class Real>
  Real elastic_energy_density(const Real &mean, const Real &j2, const Real &softness) const
  {
    const double power = 1 / (2 - parameters_.stiffness_exponent); // of ∫ p dp/K: p² times this over K
    const double least_pressure = least_pressure_share * parameters_.reference_pressure;
    const Real square = mean * mean * softness;
    const Real volumetric = math::select(mean < -least_pressure, power * square + stored_below_, 0.5 * square);
    return volumetric * (1 / bulk_) + j2 * softness * (0.5 / shear_);
  }

  /// Elastic stress of a strain.
  Stress elastic_stress(const Strain &strain) const
  {
    const double volumetric = lame_ * (strain[0] + strain[1] + strain[2]);
    return {2 * shear_ * strain[0] + volumetric,
            2 * shear_ * strain[1] + volumetric,
            2 * shear_ * strain[2] + volumetric,
            shear_ * strain[3],
            shear_ * strain[4],
            shear_ * strain[5]};
  }

  /// Elastic strain of a stress.
  Strain elastic_strain(const Stress &stress) const
  {
    const double mean = mean_stress(stress);
    const double volumetric = mean / (3 * bulk_);
    const double deviator = 1 / (2 * shear_);
    return {(stress[0] - mean) * deviator + volumetric,
            (stress[1] - mean) * deviator + volumetric,
            (stress[2] - mean) * deviator + volumetric,
            stress[3] / shear_,
            stress[4] / shear_,
            stress[5] / shear_};
  }

  /// Sufficient for Φ <= 0, without eigenvalues. In invariants Φ/2 = sqrt(J2)(cos θ − sin θ sin φ/√3) + p̂ sin φ −
  /// c cos φ (ibid. 6.121); the bracket is at most sqrt(1 + sin²φ/3) over all Lode angles θ. `J2` may be a SIMD pack.
  template <class Real>
  auto is_surely_elastic(const Real &mean, const Real &j2, const Real &plastic_strain = Real(0.)) const
  {
    const Real friction = sine_of_friction(plastic_strain);
    const Real slack = surface_.cohesion_cos - mean * friction; // cos φ falls as φ_m grows
    return (slack >= 0.) & (j2 * (1. + friction * friction / 3.) <= slack * slack);
  }

  /// Φ of the full strength [Pa].
  double yield_function(const Stress &stress) const { return yield_function(stress, surface_); }
  /// Φ of what a plastic strain has mobilised [Pa].
  double yield_function(const Stress &stress, const double plastic_strain) const
  {
    return yield_function(stress, surface(plastic_strain));
  }

  /// Largest mean stress of the full strength, c cot φ; infinite without friction [Pa].
  double apex() const { return parameters_.friction_angle > 0 ? surface_.apex : HUGE_VAL; }
  double bulk_modulus() const { return bulk_; }          ///< K [Pa]
  double shear_modulus() const { return shear_; }        ///< G [Pa]
  double lame_modulus() const { return lame_; }          ///< λ = K − 2G/3 [Pa]
  double density() const { return parameters_.density; } ///< [kg/m³]
  const MohrCoulombParameters &parameters() const { return parameters_; }

private:
  void require_flow_to_bring_back() const;
  static double yield_function(const Stress &stress, const MohrCoulombSurface<double> &surface);

  static constexpr double least_pressure_share = 0.01; // of the reference pressure

  MohrCoulombParameters parameters_;
  double bulk_, shear_, lame_;
  MohrCoulombSurface<double> surface_; // of the full strength
  double sin_initial_, sin_steady_;    // sin φ0, sin φ_cv
  double stored_below_ = 0;            // what the energy stored is beyond power p²/K, of the constant part [Pa²]
};

} // namespace bergamo::fe
