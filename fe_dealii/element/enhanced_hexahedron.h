#pragma once

#include "fe_dealii/element/stress_update.h"

#include <array>

/// Hexahedron of 8 nodes that bends: 2×2×2 points, assumed enhanced strains (Simo and Rifai, Int. J. Numer. Meth. Eng.
/// 29 (1990) 1595–1638), small strain, all geometry taken once in the reference configuration.
///
/// The nine enhanced strains are the gradients of three inner displacements a_I of the modes ½(ξ_I² − 1) (Wilson), with
/// the Jacobian of the element's middle (Taylor), so that their mean over the element vanishes and a uniform stress
/// does no work on them: inner modes count as three more nodes, of which the element finds the displacements itself,
/// those where the stresses do no work on the modes. The dilatation of all is projected on the linear functions of the
/// element, in the volume's measure: of the strains that bending needs nothing is lost, and what a trilinear
/// displacement cannot avoid at a constant volume, ξη and the like, costs no energy. Without it the element locks
/// at Poisson's ratios near 0.5 on meshes that are no bricks (Simo, Armero, Taylor, Comput. Methods Appl. Mech. Eng.
/// 110 (1993) 359–386, who add three more enhanced strains for the same).
namespace bergamo::fe::enhanced
{

inline constexpr int n_nodes = 8;
inline constexpr int n_modes = 3;                ///< vectors, three components each
inline constexpr int n_dofs = 3 * n_nodes;       ///< 3*node + component
inline constexpr int n_inner_dofs = 3 * n_modes; ///< 3*mode + component
inline constexpr int n_all_dofs = n_dofs + n_inner_dofs;
inline constexpr int n_linear = 4; ///< linear functions of the element

/// What an element is in the reference configuration.
struct Geometry
{
  Points gradient[3][n_nodes + n_modes]; ///< of the shape functions, then of the modes [1/m]
  Points volume;                         ///< weight times Jacobian determinant [m³]
  Points linear[n_linear];               ///< orthonormal: Σ volume linear_k linear_l = δ_kl [m^-3/2]
};

/// Adds modes and linear functions to the gradients and volumes of the nodes.
/// @param corner places of the nodes in deal.II's order, x fastest [m]
void add_modes(const std::array<std::array<double, 3>, n_nodes> &corner, Geometry &geometry);

/// Integral over the element of linear functions times values that count the volume.
inline void moments(const Geometry &geometry, const Points &weighted, double (&result)[n_linear])
{
  for (int k = 0; k < n_linear; ++k)
    result[k] = sum(geometry.linear[k] * weighted);
}

inline Points linear_field(const Geometry &geometry, const double (&moment)[n_linear])
{
  Points result = moment[0] * geometry.linear[0];
  for (int k = 1; k < n_linear; ++k)
    result += moment[k] * geometry.linear[k];
  return result;
}

/// Strain at all points of displacements of nodes and modes from `first` to `last` [m] (or of their increments), shears
/// as engineering strain, the dilatation projected.
template <int first = 0, int last = n_nodes + n_modes>
void strain(const Geometry &geometry, const double *u, Points (&result)[6])
{
  Points xx{}, yy{}, zz{}, xy{}, yz{}, zx{};
  for (int node = first; node < last; ++node)
  {
    const Points &dx = geometry.gradient[0][node], &dy = geometry.gradient[1][node], &dz = geometry.gradient[2][node];
    const double *const at = u + 3 * (node - first);
    xx += at[0] * dx;
    yy += at[1] * dy;
    zz += at[2] * dz;
    xy += at[0] * dy + at[1] * dx;
    yz += at[1] * dz + at[2] * dy;
    zx += at[2] * dx + at[0] * dz;
  }
  const Points dilatation = xx + yy + zz;
  double moment[n_linear];
  moments(geometry, geometry.volume * dilatation, moment);
  const Points correction = (linear_field(geometry, moment) - dilatation) / 3.;
  result[0] = xx + correction;
  result[1] = yy + correction;
  result[2] = zz + correction;
  result[3] = xy;
  result[4] = yz;
  result[5] = zx;
}

/// What the projection of the dilatation adds to the mean stress, volume included.
inline Points projection_shift(const Geometry &geometry, const Points (&stress)[6])
{
  const Points mean = geometry.volume * (stress[0] + stress[1] + stress[2]) / 3.;
  double moment[n_linear];
  moments(geometry, mean, moment);
  return geometry.volume * linear_field(geometry, moment) - mean;
}

/// Forces [N] on nodes and modes from `first` to `last`, work-conjugate to strain().
template <int first = 0, int last = n_nodes + n_modes>
void internal_force(const Geometry &geometry, const Points (&stress)[6], double *force)
{
  const Points shift = projection_shift(geometry, stress);
  const Points xx = geometry.volume * stress[0] + shift;
  const Points yy = geometry.volume * stress[1] + shift;
  const Points zz = geometry.volume * stress[2] + shift;
  const Points xy = geometry.volume * stress[3];
  const Points yz = geometry.volume * stress[4];
  const Points zx = geometry.volume * stress[5];
  for (int node = first; node < last; ++node)
  {
    const Points &dx = geometry.gradient[0][node], &dy = geometry.gradient[1][node], &dz = geometry.gradient[2][node];
    double *const at = force + 3 * (node - first);
    at[0] = sum(xx * dx + xy * dy + zx * dz);
    at[1] = sum(xy * dx + yy * dy + yz * dz);
    at[2] = sum(zx * dx + yz * dy + zz * dz);
  }
}

/// Constant forces [N] that stand for stresses at rest beside internal_force(): on the nodes ∫ ∇N · σ dV, in balance
/// with whatever load the stress field is; on the modes none. What the stresses at the start do on the modes is no
/// cause for these to move.
inline void start_force(const Geometry &geometry, const Points (&stress)[6], double *force)
{
  internal_force<n_nodes>(geometry, stress, force + n_dofs);
  for (int k = n_dofs; k < n_all_dofs; ++k)
    force[k] = -force[k];
  const Points unprojected = -projection_shift(geometry, stress);
  for (int node = 0; node < n_nodes; ++node)
    for (int i = 0; i < 3; ++i)
      force[3 * node + i] = sum(unprojected * geometry.gradient[i][node]);
}

/// Stiffness of nodes and modes from `first` to `last` [N/m], row-major. @param stress_of stress_of(strain, stress) at
/// all points: linear
template <int first = 0, int last = n_nodes + n_modes, class StressOf>
void stiffness(const Geometry &geometry, const StressOf &stress_of, double *matrix)
{
  constexpr int n = 3 * (last - first);
  for (int column = 0; column < n; ++column)
  {
    double unit[n] = {}, force[n];
    unit[column] = 1;
    Points unit_strain[6], stress[6];
    strain<first, last>(geometry, unit, unit_strain);
    stress_of(unit_strain, stress);
    internal_force<first, last>(geometry, stress, force);
    for (int row = 0; row < n; ++row)
      matrix[n * row + column] = force[row];
  }
}

/// Stiffness of the nodes with modes that follow them, row-major 24×24. @param all of nodes and modes, row-major 33×33.
/// Where the modes have none of their own, because all flows, they stay.
void condense(const double *all, double *matrix);

/// Inverse of the modes' own stiffness, both row-major 9×9.
std::array<double, n_inner_dofs * n_inner_dofs> inverse(const std::array<double, n_inner_dofs * n_inner_dofs> &matrix);

} // namespace bergamo::fe::enhanced
