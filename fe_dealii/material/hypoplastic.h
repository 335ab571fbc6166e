#pragma once

#include "fe_dealii/material/hypoplastic_parameters.h"
#include "fe_dealii/material/limit_void_ratios.h"
#include "fe_dealii/material/tensor.h"

namespace bergamo::fe
{

/// What a point of sand remembers.
struct SandState
{
  Stress stress{};       ///< Cauchy [Pa]
  double void_ratio = 0; ///< e, volume of the voids over that of the grains [-]
};

/// The equation at one state: the rate of stress is that of linear() plus flow ‖D‖, homogeneous of degree one in D.
struct HypoplasticResponse
{
  double shear;  ///< f_s F² [Pa]
  double volume; ///< f_s a² [Pa]
  Stress ratio;  ///< T̂ [-]
  Stress flow;   ///< N = f_s f_d a F (T̂ + T̂*) [Pa]

  /// Rate of stress [Pa/s] for a rate of strain D [1/s]; increments of both serve as well.
  Stress rate(const Strain &strain_rate) const;
  /// No tangent is stiffer: an upper bound of ‖rate(D)‖/‖D‖ over all D [Pa].
  double greatest_modulus() const;
  /// Derivative of rate() by D; where D is zero there is none, and this is the linear part.
  Moduli tangent(const Strain &strain_rate) const;
};

/// Hypoplasticity of sand (von Wolffersdorff, Mech. Cohes.-Frict. Mater. 1 (1996) 251-271): no yield surface and no
/// split of the strain, one tensor equation
///   T̊ = f_s [F² D + a² T̂ (T̂:D) + f_d a F (T̂ + T̂*) ‖D‖],   T̂ = T/tr T,   T̂* its deviator,
///   f_d = ((e − e_d)/(e_c − e_d))^α,
///   f_s = (h_s/n) (e_c/e)^β (1 + e_i)/e_i (e_i0/e_c0)^β (3p/h_s)^(1−n)
///         / ([3 + a² − √3 a ((e_i0 − e_d0)/(e_c0 − e_d0))^α] T̂:T̂),
/// F of matsuoka_nakai_factor(), e_d, e_c, e_i of LimitVoidRatios. The paper's T is tension positive, as everywhere
/// here; texts that count pressure positive change signs. Void ratio: ė = (1 + e) tr D.
/// T̊ is an objective rate; strains are small here, their axes those of the stress, and who has large rotations turns
/// the stress along. Stress and void ratio are the whole memory: small cycles ratchet, for want of intergranular
/// strain.
///
/// Stated for pressures above zero and e_d <= e <= e_i. Beyond that:
/// - Below `least_pressure` the equation is evaluated with that mean pressure, and the deviator as it is.
///   The stiffness would vanish with the pressure and T̂ have no limit; a free surface then could bear nothing, and an
///   increment would never be small enough.
/// - No principal stress exceeds zero: sand has no tension, and what an increment would make of it is cut off. Grains
///   that have parted bear load again as soon as the strain turns back, however far they are.
/// - Denser than e_d, f_d and (e_c/e)^β are those of e_d; looser than e_i those of e_i. Dilation ends at f_d = 0
///   (Niemunis 2003 shows that the equation itself may go there), and compression always stiffens.
/// All members but the constructor are pure, free of allocation, exceptions and virtual calls.
class HypoplasticSand
{
public:
  /// Throws ConfigError.
  explicit HypoplasticSand(const HypoplasticParameters &parameters);

  HypoplasticResponse response(const SandState &state) const;

  /// @param pressure p >= 0 [Pa]
  LimitVoidRatios limit_void_ratios(double pressure) const;

  /// @name An elastic solid that is nowhere softer, for stable steps and preconditioners: without lateral stiffness,
  /// 2G = HypoplasticResponse::greatest_modulus(). These are of no stress and the void ratio of the start.
  /// @{
  double shear_modulus() const { return 0.5 * modulus_; } ///< G [Pa]
  double bulk_modulus() const { return modulus_ / 3; }    ///< K [Pa]
  double lame_modulus() const { return 0; }               ///< λ [Pa]
  double stiffness_factor(const SandState &state) const   ///< of those moduli in a state [-]
  {
    return response(state).greatest_modulus() / modulus_;
  }
  /// @}

  double density() const { return p_.density; } ///< at the start [kg/m³]
  const HypoplasticParameters &parameters() const { return p_; }

private:
  /// (3p/h_s)^n [-]
  double compression_power(double pressure) const;
  LimitVoidRatios limits_at(double compression_power) const;

  HypoplasticParameters p_;
  double a_;         // strength_factor()
  double stiffness_; // factors of f_s that no state changes [Pa]
  double modulus_;   // greatest_modulus() without stress, at the void ratio of the start
};

/// Takes principal stresses above zero to zero. @return whether there were any
bool cut_tension(Stress &stress);

} // namespace bergamo::fe
