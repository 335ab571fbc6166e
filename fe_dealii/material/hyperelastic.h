#pragma once

#include "dem/core/pack.h"
#include "fe_dealii/material/deformation.h"

/// Hyperelastic laws: energies of the deformation gradient F, of large strain and rotation.
///
/// Each law is a class with
///   PointResponse<Real> respond(F, cof F, J)  to the part W(F); both figures share most of their terms
///   volumetric()                              the part U(J) that an element may take at its mean volume ratio
///   shear_modulus(), bulk_modulus()           at small strain [Pa]; density() of the reference state [kg/m³]
/// for Real a double or a pack of them. The whole energy is W(F) + U(J), the stress that of W plus U'(J) cof F. Where U
/// is taken at the mean ratio of an element, v/V, the element does not lock at nearly constant volume (Simo, Taylor,
/// Pister, Comput. Methods Appl. Mech. Eng. 51 (1985) 177-208).
namespace bergamo::fe
{

/// U(J) = k/4 (J² − 1 − 2 ln J): convex, without a bound in both directions, U'' = k at J = 1.
struct VolumetricEnergy
{
  double modulus; ///< k [Pa]

  template <class Real>
  Real energy(const Real &ratio) const
  {
    return (0.25 * modulus) * (ratio * ratio - 1. - 2. * math::library_log(ratio));
  }

  /// U'(J), tension positive [Pa].
  template <class Real>
  Real pressure(const Real &ratio) const
  {
    return (0.5 * modulus) * (ratio - 1. / ratio);
  }

  /// U''(J) [Pa].
  double slope(const double ratio) const { return (0.5 * modulus) * (1. + 1. / (ratio * ratio)); }
};

/// What a deformation gradient gives at a point.
template <class Real>
struct PointResponse
{
  Tensor3<Real> stress; ///< first Piola-Kirchhoff [Pa]
  Real energy;          ///< per reference volume [J/m³]
};

/// Stress of a law at one point alone, or at several points without any mean: first Piola-Kirchhoff [Pa].
template <class Law, class Real>
Tensor3<Real> first_piola(const Law &law, const Tensor3<Real> &f)
{
  const Tensor3<Real> minors = cofactor(f);
  const Real ratio = determinant(f, minors);
  Tensor3<Real> stress = law.respond(f, minors, ratio).stress;
  const Real pressure = law.volumetric().pressure(ratio);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      stress[i][j] += pressure * minors[i][j];
  return stress;
}

/// Energy of a law at one point [J per m³ of the reference state].
template <class Law, class Real>
Real energy_density(const Law &law, const Tensor3<Real> &f)
{
  const Tensor3<Real> minors = cofactor(f);
  const Real ratio = determinant(f, minors);
  return law.respond(f, minors, ratio).energy + law.volumetric().energy(ratio);
}

} // namespace bergamo::fe
