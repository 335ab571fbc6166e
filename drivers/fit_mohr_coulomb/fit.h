#pragma once

#include "drivers/fit_mohr_coulomb/triaxial_curve.h"

#include <limits>
#include <optional>
#include <span>

namespace bergamo::driver
{

/// Which rows of a curve each parameter is fitted to. Axial strains as positive compression.
struct FitWindows
{
  double elastic_strain = 2e-4; ///< slopes of the elastic constants: from 0 to here
  double peak_average = 2e-3;   ///< width over which stresses are averaged before the largest one is sought
  double dilation_from = 0.10;  ///< constant dilation rate: from here
  double dilation_to = 0.15;    ///< to here
  double final_average = 0.01;  ///< width at the end of the shear over which the final state is averaged

  /// Throws ConfigError.
  void validate() const;
};

struct Line
{
  double slope;
  double intercept;
};

/// Line of least squares through points (x, y) with at least two different x.
Line fit_line(std::span<const double> x, std::span<const double> y);

struct ElasticFit
{
  double young_modulus; ///< [Pa]
  double poisson_ratio;
};

/// Initial slopes up to an axial compression `window`: at constant lateral pressure Hooke's law is dσ3/dε3 = E,
/// dεV/dε3 = 1 − 2ν. Lines of least squares with free intercepts, so that a jump of stress when the loading begins does
/// not count. Nothing where fewer than three rows lie in the window or they span less than 80 % of it.
std::optional<ElasticFit> elastic_fit(const TriaxialCurve &curve, double window);

/// Friction angle [degrees] of the line τ = c + σ tan φ that touches Mohr's circle between the pressures `axial` and
/// `lateral` [Pa, compression positive], c the cohesion [Pa]: with t = tan(45° + φ/2) the Mohr–Coulomb condition is
/// axial = lateral t² + 2 c t. Negative where axial < lateral + 2 c. Requires axial, lateral > 0 and c >= 0.
double friction_angle(double axial, double lateral, double cohesion);

/// Mohr's circle of a stress state, compression positive.
struct MohrCircle
{
  double centre; ///< [Pa]
  double radius; ///< [Pa]
};

struct Tangent
{
  double friction_angle; ///< [degrees]
  double cohesion;       ///< [Pa]; negative where the circles' strength grows more than in proportion to the pressure
};

/// The line τ = c + σ tan φ whose distances from the circles' rims have the least sum of squares. The distance of a
/// centre C is C sin φ + c cos φ, so this is linear regression of the radii: R = sin φ C + c cos φ. Nothing for circles
/// with fewer than two different centres (to 1e-6), or a slope outside [0, 1).
std::optional<Tangent> common_tangent(std::span<const MohrCircle> circles);

/// Dilation angle [degrees] of a dilation rate D = −dεV/dε3 in triaxial compression, D > −1.
///
/// Both lateral stresses are equal, so the stress lies on the edge of the pyramid where the planes (σ1, σ3) and
/// (σ2, σ3) meet. With tension positive and s = sin ψ, their flow directions in (ε1, ε2, ε3) are (1 + s, 0, −(1 − s))
/// and (0, 1 + s, −(1 − s)). Any non-negative multipliers a, b give dε3 = −(1 − s)(a + b) and dεV = 2 s (a + b): D =
/// 2 s/(1 − s), whatever a and b, hence sin ψ = D/(2 + D). At constant stress the elastic strain rates vanish, so
/// total rates are plastic ones.
double dilation_angle(double dilation_rate);

/// Everything that one sample tells, except its friction angle, which depends on the cohesion chosen.
struct SampleFit
{
  ElasticFit elastic;
  std::optional<ElasticFit> elastic_half;   ///< with half the window
  std::optional<ElasticFit> elastic_double; ///< with twice the window
  double peak_axial_pressure;               ///< largest [Pa], compression positive
  double peak_lateral_pressure;             ///< at the same strain [Pa]
  double peak_compression;                  ///< axial strain there
  double dilation_rate;                     ///< −dεV/dε3
  double dilation_angle;                    ///< [degrees]
  double final_stress_ratio;                ///< σ3/σ1
  double initial_solid_fraction;            ///< of the first row
  double critical_solid_fraction;           ///< at the end
  bool hardens_to_the_end;                  ///< the largest stress is that of the end

  MohrCircle peak_circle() const
  {
    return {0.5 * (peak_axial_pressure + peak_lateral_pressure), 0.5 * (peak_axial_pressure - peak_lateral_pressure)};
  }
  double peak_stress_ratio() const { return peak_axial_pressure / peak_lateral_pressure; }
};

/// Fits one sample. Throws ConfigError, without the sample's name, where a window holds too few rows, where the axial
/// pressure never exceeds the lateral one, or where a stress has the sign of tension.
SampleFit fit_sample(const TriaxialCurve &curve, const FitWindows &windows);

} // namespace bergamo::driver
