#pragma once

#include "fe_dealii/element/points.h"
#include "fe_dealii/material/deformation.h"

/// Hexahedron of 8 nodes that bends: its law is asked once, at the mean of the deformation gradient, and what the nodes
/// move beyond that, the four hourglass modes, has the stiffness that enhanced strains give them (Puso, Int. J. Numer.
/// Meth. Eng. 49 (2000) 1029–1064; Belytschko and Bindeman, Comput. Methods Appl. Mech. Eng. 105 (1993) 225–260). Small
/// and large strain, all geometry taken once in the reference configuration. Nodes are in deal.II's lexicographic
/// order, x fastest.
///
/// The displacements of the nodes are u = c + H X + Σ h_α φ_α: H is the mean of ∂u/∂X over the volume, the modes φ_α
/// have gradients without a mean. A uniform strain moves no mode, whatever the element's form. Real is a double for one
/// element, or Points for eight of them, an element a lane: so the law of eight elements is one call.
namespace bergamo::fe::bending
{

inline constexpr int n_nodes = 8;
inline constexpr int n_points = 8; ///< where the reference configuration is integrated
inline constexpr int n_dofs = 3 * n_nodes;
inline constexpr int n_modes = 4;
inline constexpr int n_amplitudes = 3 * n_modes; ///< 3*mode + component

/// Place of an entry of a symmetric matrix, row >= column, in its lower triangle row by row.
constexpr int packed(const int row, const int column)
{
  return row * (row + 1) / 2 + column;
}

/// What an element is in the reference configuration.
template <class Real>
struct Geometry
{
  Real volume;                             ///< with the continuum's share [m³]
  Real gradient[3][n_nodes];               ///< mean of ∂N_node/∂X_component [1/m]
  Real amplitude[n_modes][n_nodes];        ///< of each mode by the displacements of the nodes
  Real stiffness[packed(n_amplitudes, 0)]; ///< of the amplitudes, at no strain, share included; see packed() [N/m]
};

/// What displacements of the nodes, or increments of them, are made of.
template <class Real>
struct Motion
{
  Tensor3<Real> gradient;     ///< H
  Real amplitude[n_modes][3]; ///< h [m]
};

/// @param u 3*node + component [m]
template <class Real>
BERGAMO_INLINE Motion<Real> motion_of(const Geometry<Real> &geometry, const Real (&u)[n_dofs])
{
  Motion<Real> motion;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      motion.gradient[i][j] = u[i] * geometry.gradient[j][0];
      for (int node = 1; node < n_nodes; ++node)
        motion.gradient[i][j] += u[3 * node + i] * geometry.gradient[j][node];
    }
    for (int mode = 0; mode < n_modes; ++mode)
    {
      motion.amplitude[mode][i] = u[i] * geometry.amplitude[mode][0];
      for (int node = 1; node < n_nodes; ++node)
        motion.amplitude[mode][i] += u[3 * node + i] * geometry.amplitude[mode][node];
    }
  }
  return motion;
}

/// Nodal forces [N] of what works on the motion: force · u = of_gradient : H + Σ of_amplitude · h.
template <class Real>
BERGAMO_INLINE void nodal_force(const Geometry<Real> &geometry, const Tensor3<Real> &of_gradient,
                                const Real (&of_amplitude)[n_modes][3], Real (&force)[n_dofs])
{
  for (int node = 0; node < n_nodes; ++node)
    for (int i = 0; i < 3; ++i)
    {
      Real sum = of_gradient[i][0] * geometry.gradient[0][node];
      for (int j = 1; j < 3; ++j)
        sum += of_gradient[i][j] * geometry.gradient[j][node];
      for (int mode = 0; mode < n_modes; ++mode)
        sum += of_amplitude[mode][i] * geometry.amplitude[mode][node];
      force[3 * node + i] = sum;
    }
}

/// What works on the amplitudes q by the hourglass stiffness [N]. @return their energy ½ q·K q [J]
template <class Real>
BERGAMO_INLINE Real hourglass_force(const Geometry<Real> &geometry, const Real (&q)[n_modes][3],
                                    Real (&force)[n_modes][3])
{
  Real energy(0.);
  for (int k = 0; k < n_amplitudes; ++k)
  {
    Real sum(0.);
    for (int l = 0; l < n_amplitudes; ++l)
      sum += geometry.stiffness[k < l ? packed(l, k) : packed(k, l)] * q[l / 3][l % 3];
    force[k / 3][k % 3] = sum;
    energy += 0.5 * (q[k / 3][k % 3] * sum);
  }
  return energy;
}

/// Small strain xx yy zz xy yz zx, engineering shears.
template <class Real>
BERGAMO_INLINE void small_strain(const Tensor3<Real> &gradient, Real (&strain)[6])
{
  for (int i = 0; i < 3; ++i)
    strain[i] = gradient[i][i];
  strain[3] = gradient[0][1] + gradient[1][0];
  strain[4] = gradient[1][2] + gradient[2][1];
  strain[5] = gradient[2][0] + gradient[0][2];
}

/// What a stress of small strain, xx yy zz xy yz zx, does on the mean gradient [J].
template <class Real>
BERGAMO_INLINE Tensor3<Real> work_on_gradient(const Geometry<Real> &geometry, const Real (&stress)[6])
{
  constexpr int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  Tensor3<Real> result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i][j] = geometry.volume * stress[component[i][j]];
  return result;
}

} // namespace bergamo::fe::bending
