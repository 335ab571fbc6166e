#pragma once

#include "fe_dealii/element/difference_tangent.h"
#include "fe_dealii/element/enhanced_hexahedron.h"
#include "fe_dealii/material/hyperelastic.h"

#include <algorithm>
#include <array>
#include <cmath>

/// Hexahedron of 8 nodes at large strain that bends: its law is asked once, at the mean deformation gradient, and what
/// the nodes move beyond that, the four hourglass modes, has the stiffness of enhanced strains (Puso, Int. J. Numer.
/// Meth. Eng. 49 (2000) 1029–1064; Belytschko and Bindeman, Comput. Methods Appl. Mech. Eng. 105 (1993) 225–260).
///
/// The displacements of the nodes are u = c + (F̄ − 1) X + Σ h_α φ_α: F̄ is the mean of F over the reference volume, the
/// modes φ_α have gradients without a mean. The energy is V (W + U)(F̄) + ½ q·K q with the amplitudes q_α = F̄ᵀ h_α,
/// drawn back to the reference frame. K is the stiffness of enhanced_hexahedron.h for them, inner modes condensed, with
/// the moduli at no strain. So at small strain it is that element to the last digit; a rotation changes nothing; no
/// element locks; and K stays positive whatever the deformation, where enhanced strains with the law at each point
/// lose their stiffness against hourglasses under large compression (Wriggers and Reese, Comput. Methods Appl. Mech.
/// Eng. 135 (1996) 201–209). The price: where strains differ much within an element, this difference is taken as
/// linear.
namespace bergamo::fe::stabilized
{

inline constexpr int n_nodes = 8;
inline constexpr int n_modes = 4;
inline constexpr int n_dofs = 3 * n_nodes;
inline constexpr int n_amplitudes = 3 * n_modes; ///< 3*mode + component

/// What an element is in the reference configuration.
struct Geometry
{
  double volume;                                ///< [m³]
  double mean_gradient[3][n_nodes];             ///< mean of ∂N_node/∂X_component [1/m]
  double amplitude[n_modes][n_nodes];           ///< of each mode by the displacements of the nodes
  double stiffness[n_amplitudes][n_amplitudes]; ///< of the amplitudes [N/m]
  Points mode_gradient[3][n_modes];             ///< ∂φ_mode/∂X_component at the points [1/m]
};

/// @param corner places of the nodes in deal.II's order, x fastest [m]
/// @param bulk_modulus, shear_modulus at small strain [Pa]
Geometry make_geometry(const std::array<std::array<double, 3>, n_nodes> &corner, const enhanced::Geometry &enhanced,
                       double bulk_modulus, double shear_modulus);

/// What a configuration of an element gives beside its forces.
struct Response
{
  double energy = 0.;         ///< [J]
  double smallest_ratio = 0.; ///< least det F, at the mean or any point; <= 0 where the element has turned inside out
};

/// What the displacements of an element are made of. @param u displacements, 3*node + component [m]
struct Motion
{
  Tensor3<double> f;            ///< mean deformation gradient
  double hourglass[n_modes][3]; ///< h [m]

  Motion(const Geometry &geometry, const double *u)
  {
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        f[i][j] = i == j;
        for (int node = 0; node < n_nodes; ++node)
          f[i][j] += u[3 * node + i] * geometry.mean_gradient[j][node];
      }
      for (int mode = 0; mode < n_modes; ++mode)
      {
        hourglass[mode][i] = 0;
        for (int node = 0; node < n_nodes; ++node)
          hourglass[mode][i] += u[3 * node + i] * geometry.amplitude[mode][node];
      }
    }
  }
};

/// Least det F at the points.
inline double smallest_ratio(const Geometry &geometry, const Motion &motion)
{
  Tensor3<Points> f;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      f[i][j] = motion.f[i][j];
      for (int mode = 0; mode < n_modes; ++mode)
        f[i][j] += motion.hourglass[mode][i] * geometry.mode_gradient[j][mode];
    }
  return least(determinant(f, cofactor(f)));
}

/// Internal forces, the derivative of the energy by the displacements.
/// @param u displacements, 3*node + component [m]; @param force on the nodes, the same order [N]; where the smallest
///        ratio is not positive the forces may be no numbers
template <class Law>
Response internal_force(const Law &law, const Geometry &geometry, const double *u, double *force)
{
  const Motion motion(geometry, u);
  const Tensor3<double> minors = cofactor(motion.f);
  const double ratio = determinant(motion.f, minors);
  const PointResponse<double> of_law = law.respond(motion.f, minors, ratio);
  const VolumetricEnergy volumetric = law.volumetric();
  const double pressure = volumetric.pressure(ratio);

  double q[n_amplitudes], s[n_amplitudes], energy = 0;
  for (int mode = 0; mode < n_modes; ++mode)
    for (int j = 0; j < 3; ++j)
    {
      q[3 * mode + j] = 0;
      for (int i = 0; i < 3; ++i)
        q[3 * mode + j] += motion.f[i][j] * motion.hourglass[mode][i];
    }
  for (int k = 0; k < n_amplitudes; ++k)
  {
    s[k] = 0;
    for (int l = 0; l < n_amplitudes; ++l)
      s[k] += geometry.stiffness[k][l] * q[l];
    energy += 0.5 * q[k] * s[k];
  }
  for (int i = 0; i < 3; ++i)
  {
    double of_mean[3], of_mode[n_modes]; // derivatives of the energy by a row of F̄ and by a component of h
    for (int j = 0; j < 3; ++j)
    {
      of_mean[j] = geometry.volume * (of_law.stress[i][j] + pressure * minors[i][j]);
      for (int mode = 0; mode < n_modes; ++mode)
        of_mean[j] += motion.hourglass[mode][i] * s[3 * mode + j];
    }
    for (int mode = 0; mode < n_modes; ++mode)
      of_mode[mode] =
          motion.f[i][0] * s[3 * mode] + motion.f[i][1] * s[3 * mode + 1] + motion.f[i][2] * s[3 * mode + 2];
    for (int node = 0; node < n_nodes; ++node)
    {
      double sum = 0;
      for (int j = 0; j < 3; ++j)
        sum += of_mean[j] * geometry.mean_gradient[j][node];
      for (int mode = 0; mode < n_modes; ++mode)
        sum += of_mode[mode] * geometry.amplitude[mode][node];
      force[3 * node + i] = sum;
    }
  }
  return {energy + geometry.volume * (of_law.energy + volumetric.energy(ratio)),
          std::min(ratio, smallest_ratio(geometry, motion))};
}

/// Tangent stiffness, see difference_tangent() [N/m].
template <class Law>
void tangent_stiffness(const Law &law, const Geometry &geometry, const double *u, double *stiffness)
{
  difference_tangent<n_dofs>([&](const double *moved, double *force) { internal_force(law, geometry, moved, force); },
                             u, 1e-5 * std::cbrt(geometry.volume), stiffness);
}

} // namespace bergamo::fe::stabilized
