#pragma once

#include "fe_dealii/material/principal.h"
#include "fe_dealii/material/tensor.h"

#include <array>
#include <cmath>
#include <cstdint>

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

  /// Dilation angle, negative, from which on contraction takes the pressure from a stress faster than its shear, so
  /// that no flow brings it back to the yield surface [degrees].
  double least_dilation_angle() const;

  /// Throws ConfigError that names the first value outside its range.
  void validate() const;
};

/// The part of the yield surface that a stress ended on.
enum class Sector : std::uint8_t
{
  elastic,    ///< inside
  main_plane, ///< σ1 > σ2 > σ3
  right_edge, ///< σ2 = σ3, triaxial extension
  left_edge,  ///< σ1 = σ2, triaxial compression
  apex        ///< σ1 = σ2 = σ3 = c cot φ
};

struct StressUpdate
{
  Stress stress;              ///< new stress
  Strain plastic_strain;      ///< increment
  Sector sector;              ///< where the new stress lies
  double plastic_dissipation; ///< ½(σ_old + σ_new) : Δε_p [J/m³]; closes the balance of a leapfrog exactly
};

/// Principal stresses after the return, of one stress or of a pack of them.
template <class Real>
struct PrincipalReturn
{
  math::Mask<Real> yields; ///< the trial stress lies beyond the surface; else the values mean nothing
  Real value[3];           ///< on the surface, falling [Pa]
  Real sector;             ///< a Sector as a number
};

/// Small-strain, perfectly plastic, non-associative Mohr–Coulomb law: with σ1 >= σ2 >= σ3, tension positive,
///   Φ = σ1 − σ3 + (σ1 + σ3) sin φ − 2 c cos φ <= 0,   flow along ∂Ψ/∂σ, Ψ = Φ with ψ in place of φ.
/// A negative ψ is that of loose sand, which contracts as it is sheared: at constant volume its pressure falls.
/// Implicit return in principal stresses, closed form: de Souza Neto, Perić, Owen, Computational Methods for
/// Plasticity (2008), sec. 8.2.
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
  StressUpdate update(const Stress &stress_old, const Strain &strain_increment) const;

  /// The plastic half of update(): brings an elastic trial stress back to the yield surface (or leaves it inside).
  /// `frame` is the principal frame of the trial stress, `stiffness` the factor of the moduli in this increment.
  StressUpdate return_to_surface(const Stress &stress_old, const Stress &stress_trial,
                                 const PrincipalFrame<double> &frame, double stiffness = 1) const;

  /// The return by itself: principal trial stresses, falling, to new ones; the principal frame stays. Sectors are
  /// chosen by masks.
  template <class Real>
  PrincipalReturn<Real> return_principal(const Real (&trial)[3]) const;

  /// Derivative of update()'s stress by the strain increment; exact, since the return is linear in each sector. Not
  /// symmetric where dilation and friction angle differ.
  Moduli tangent(const Stress &stress_old, const Strain &strain_increment) const;

  bool depends_on_pressure() const { return parameters_.reference_pressure > 0; }

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
  auto is_surely_elastic(const Real &mean, const Real &j2) const
  {
    const Real slack = cohesion_cos_ - mean * sin_friction_;
    return (slack >= 0.) & (j2 * worst_lode_ <= slack * slack);
  }

  /// Φ [Pa].
  double yield_function(const Stress &stress) const;

  /// Largest mean stress, c cot φ; infinite without friction [Pa].
  double apex() const { return parameters_.friction_angle > 0 ? apex_ : HUGE_VAL; }
  double bulk_modulus() const { return bulk_; }          ///< K [Pa]
  double shear_modulus() const { return shear_; }        ///< G [Pa]
  double lame_modulus() const { return lame_; }          ///< λ = K − 2G/3 [Pa]
  double density() const { return parameters_.density; } ///< [kg/m³]
  const MohrCoulombParameters &parameters() const { return parameters_; }

private:
  using PrincipalMatrix = std::array<std::array<double, 3>, 3>;
  /// Derivative of the principal stresses after the return by those of the trial stress.
  PrincipalMatrix principal_tangent(Sector sector) const;

  static constexpr double least_pressure_share = 0.01; // of the reference pressure

  MohrCoulombParameters parameters_;
  double bulk_, shear_, lame_;
  double sin_friction_, sin_dilation_, cohesion_cos_; // cohesion_cos_ = c cos φ
  double worst_lode_;                                 // 1 + sin²φ/3
  double apex_;                                       // c cot φ
  double plane_;                                      // a in the reference: ∂Φ : C : ∂Ψ of one plane with itself
  double right_, left_;                               // b: of the main plane with its neighbour across an edge
  // Stress changes per Φ on the main plane, of the middle and the most compressive component, and per Φ + Φ2 of the
  // most compressive one on the edges.
  double plane_middle_, plane_minor_, right_minor_, left_minor_;
  double stored_below_ = 0;              // what the energy stored is beyond power p²/K, of the constant part [Pa²]
  double tensile_slope_, tensile_start_; // σ1 = slope σ3 + start where Φ = 0
};

template <class Real>
PrincipalReturn<Real> MohrCoulomb::return_principal(const Real (&trial)[3]) const
{
  const Real &t1 = trial[0], &t2 = trial[1], &t3 = trial[2];
  const double f = sin_friction_, s = sin_dilation_;
  PrincipalReturn<Real> result;
  const Real phi = (1 + f) * t1 - (1 - f) * t3 - 2 * cohesion_cos_;
  result.yields = phi > 0.;

  // The most tensile stress follows from Φ = 0 and the most compressive one, so that Φ = 0 holds to rounding.
  const Real minor = t3 - plane_minor_ * phi, middle = t2 - plane_middle_ * phi,
             major = tensile_slope_ * minor + tensile_start_;
  const math::Mask<Real> on_plane = (major >= middle) & (middle >= minor);

  // The plane through the hydrostatic axis along the flow splits what goes to either edge (ibid. 8.2.3). On the side
  // chosen, the middle stress has overtaken its neighbour, so both multipliers come out positive. Only their sum,
  // (Φ + Φ2)/(a + b), enters.
  const math::Mask<Real> is_right = (1 - s) * t1 - 2. * t2 + (1 + s) * t3 >= 0.;
  const Real greater = math::select(is_right, t1, t2), smaller = math::select(is_right, t2, t3);
  const Real both = phi + ((1 + f) * greater - (1 - f) * smaller - 2 * cohesion_cos_);
  const Real on_right = 0.5 * (t2 + t3) - right_minor_ * both, on_left = t3 - left_minor_ * both;
  const Real edge_minor = math::select(is_right, on_right, on_left);
  const Real edge_major = tensile_slope_ * edge_minor + tensile_start_;

  // Beyond the apex the surface's mirror image waits. Without dilation the flow rule alone cannot lower the mean
  // stress; the apex is then the nearest admissible state. Without friction the two planes are parallel.
  const math::Mask<Real> is_apex = !(on_plane | (edge_major >= edge_minor));
  const Real apex_or(apex_);
  result.value[2] = math::select(is_apex, apex_or, math::select(on_plane, minor, edge_minor));
  result.value[0] = math::select(is_apex, apex_or, math::select(on_plane, major, edge_major));
  result.value[1] = math::select(on_plane, middle, math::select(is_right, result.value[2], result.value[0]));

  const auto number = [](const Sector sector) { return Real(static_cast<double>(sector)); };
  const Real edge = math::select(is_right, number(Sector::right_edge), number(Sector::left_edge));
  const Real beyond = math::select(is_apex, number(Sector::apex), edge);
  const Real surface = math::select(on_plane, number(Sector::main_plane), beyond);
  result.sector = math::select(result.yields, surface, number(Sector::elastic));
  return result;
}

} // namespace bergamo::fe
