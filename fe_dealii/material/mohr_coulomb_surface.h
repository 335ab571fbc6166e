#pragma once

#include "dem/core/pack.h"

#include <cstdint>

namespace bergamo::fe
{

/// The part of the yield surface that a stress ended on.
enum class Sector : std::uint8_t
{
  elastic,    ///< inside
  main_plane, ///< σ1 > σ2 > σ3
  right_edge, ///< σ2 = σ3, triaxial extension
  left_edge,  ///< σ1 = σ2, triaxial compression
  apex        ///< σ1 = σ2 = σ3 = c cot φ
};

/// Principal stresses after the return, of one stress or of a pack of them.
template <class Real>
struct PrincipalReturn
{
  math::Mask<Real> yields; ///< the trial stress lies beyond the surface; else the values mean nothing
  Real value[3];           ///< on the surface, falling [Pa]
  Real sector;             ///< a Sector as a number
};

/// A surface Φ = 0 of Mohr and Coulomb with its flow, see MohrCoulomb, at one friction and dilation angle; of a pack of
/// points with an angle each, where these have hardened differently.
/// @tparam Angle double, or a pack
template <class Angle>
struct MohrCoulombSurface
{
  /// @param sine_of_friction in [0, 1); @param sine_of_dilation at most that; @param cohesion c [Pa]; @param bulk,
  /// shear moduli [Pa]: only their ratio enters where a stress goes back to
  MohrCoulombSurface(const Angle &sine_of_friction, const Angle &sine_of_dilation, double cohesion, double bulk,
                     double shear);

  /// Whether flow brings back every stress: contraction takes the pressure from a stress beyond the surface, and must
  /// take its shear faster, on the plane and on both edges.
  bool brings_back() const { return plane > 0 && plane + right > 0 && plane + left > 0; }

  /// Brings principal trial stresses, falling, back to the surface; the principal frame stays. Sectors are chosen by
  /// masks. de Souza Neto, Perić, Owen, Computational Methods for Plasticity (2008), sec. 8.2.
  /// @tparam Real Angle, or a pack of stresses for one surface
  template <class Real>
  PrincipalReturn<Real> return_principal(const Real (&trial)[3]) const;

  Angle friction, dilation; // sin φ, sin ψ
  Angle cohesion_cos;       // c cos φ
  Angle apex;               // c cot φ
  // Of ∂Φ : C : ∂Ψ: a in the reference, of one plane with itself, and b, of the main plane with its neighbour across an
  // edge.
  Angle plane, right, left;
  // Stress changes per Φ on the main plane, of the middle and the most compressive component, and per Φ + Φ2 of the
  // most compressive one on the edges.
  Angle plane_middle, plane_minor, right_minor, left_minor;
  Angle tensile_slope, tensile_start; // σ1 = slope σ3 + start where Φ = 0
};

template <class Angle>
MohrCoulombSurface<Angle>::MohrCoulombSurface(const Angle &sine_of_friction, const Angle &sine_of_dilation,
                                              const double cohesion, const double bulk, const double shear)
    : friction(sine_of_friction), dilation(sine_of_dilation)
{
  cohesion_cos = cohesion * math::sqrt(Angle(1. - friction * friction));
  apex = math::select(friction > 0., Angle(cohesion_cos / math::select(friction > 0., friction, Angle(1.))), Angle(0.));
  const Angle product = friction * dilation, sum = friction + dilation;
  plane = 4 * shear * (1. + product / 3.) + 4 * bulk * product;
  right = 2 * shear * (1. + sum - product / 3.) + 4 * bulk * product;
  left = 2 * shear * (1. - sum - product / 3.) + 4 * bulk * product;
  const Angle middle = (2 * bulk - 4 * shear / 3) * dilation, minor = middle - 2 * shear * (1. - dilation);
  plane_middle = middle / plane;
  plane_minor = minor / plane;
  right_minor = 0.5 * (middle + minor) / (plane + right);
  left_minor = minor / (plane + left);
  tensile_slope = (1. - friction) / (1. + friction);
  tensile_start = 2. * cohesion_cos / (1. + friction);
}

template <class Angle>
template <class Real>
PrincipalReturn<Real> MohrCoulombSurface<Angle>::return_principal(const Real (&trial)[3]) const
{
  const Real &t1 = trial[0], &t2 = trial[1], &t3 = trial[2];
  const Angle &f = friction, &s = dilation;
  PrincipalReturn<Real> result;
  const Real phi = (1. + f) * t1 - (1. - f) * t3 - 2. * cohesion_cos;
  result.yields = phi > 0.;

  // The most tensile stress follows from Φ = 0 and the most compressive one, so that Φ = 0 holds to rounding.
  const Real minor = t3 - plane_minor * phi, middle = t2 - plane_middle * phi,
             major = tensile_slope * minor + tensile_start;
  const math::Mask<Real> on_plane = (major >= middle) & (middle >= minor);

  // The plane through the hydrostatic axis along the flow splits what goes to either edge (ibid. 8.2.3). On the side
  // chosen, the middle stress has overtaken its neighbour, so both multipliers come out positive. Only their sum,
  // (Φ + Φ2)/(a + b), enters.
  const math::Mask<Real> is_right = (1. - s) * t1 - 2. * t2 + (1. + s) * t3 >= 0.;
  const Real greater = math::select(is_right, t1, t2), smaller = math::select(is_right, t2, t3);
  const Real both = phi + ((1. + f) * greater - (1. - f) * smaller - 2. * cohesion_cos);
  const Real on_right = 0.5 * (t2 + t3) - right_minor * both, on_left = t3 - left_minor * both;
  const Real edge_minor = math::select(is_right, on_right, on_left);
  const Real edge_major = tensile_slope * edge_minor + tensile_start;

  // Beyond the apex the surface's mirror image waits. Without dilation the flow rule alone cannot lower the mean
  // stress; the apex is then the nearest admissible state. Without friction the two planes are parallel.
  const math::Mask<Real> is_apex = !(on_plane | (edge_major >= edge_minor));
  const Real apex_or(apex);
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
