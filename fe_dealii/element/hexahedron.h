#pragma once

#include "fe_dealii/element/stress_update.h"

/// Trilinear hexahedron with 2×2×2 points and a mean dilatation (B-bar: Hughes, Generalization of selective
/// integration procedures, Int. J. Numer. Meth. Eng. 15 (1980) 1413–1418), small strain, all geometry taken once in
/// the reference configuration. Nodes and points are in deal.II's lexicographic order, x fastest. The eight points of
/// an element are the eight lanes of one SIMD register, so no loop over points appears.
namespace bergamo::fe::hexahedron
{

inline constexpr int n_nodes = 8;
inline constexpr int n_points = 8;
inline constexpr int n_dofs = 24; ///< 3*node + component

/// What an element is in the reference configuration.
struct Geometry
{
  Points gradient[3][n_nodes]; ///< ∂N_node/∂x_component [1/m]
  Points volume;               ///< weight times Jacobian determinant [m³]
  Points share_volume;         ///< volume times the continuum's share there [m³]
  Points volume_fraction;      ///< volume over the element's volume [-]
};

/// N_node at a point, trilinear, 2×2×2 Gauss: one factor (1 ± 1/√3)/2 per axis.
inline double shape_value(const int node, const int point)
{
  constexpr double near = 0.78867513459481288225, far = 0.21132486540518711775;
  double value = 1;
  for (int axis = 0; axis < 3; ++axis)
    value *= ((node >> axis) & 1) == ((point >> axis) & 1) ? near : far;
  return value;
}

/// Strain of nodal displacements u[24] [m] (or of their increments) at all points, shears as engineering strain, the
/// dilatation replaced by its mean over the element.
inline void strain(const Geometry &geometry, const double *u, Points (&result)[6])
{
  Points xx{}, yy{}, zz{}, xy{}, yz{}, zx{};
  for (int node = 0; node < n_nodes; ++node)
  {
    const Points &dx = geometry.gradient[0][node], &dy = geometry.gradient[1][node], &dz = geometry.gradient[2][node];
    const double ux = u[3 * node], uy = u[3 * node + 1], uz = u[3 * node + 2];
    xx += ux * dx;
    yy += uy * dy;
    zz += uz * dz;
    xy += ux * dy + uy * dx;
    yz += uy * dz + uz * dy;
    zx += uz * dx + ux * dz;
  }
  const Points dilatation = xx + yy + zz;
  const Points correction = (sum(geometry.volume_fraction * dilatation) - dilatation) / 3.;
  result[0] = xx + correction;
  result[1] = yy + correction;
  result[2] = zz + correction;
  result[3] = xy;
  result[4] = yz;
  result[5] = zx;
}

/// Nodal forces [N] work-conjugate to strain(): force · u = Σ share_volume stress : strain(u).
inline void internal_force(const Geometry &geometry, const Points (&stress)[6], double *force)
{
  // Only the mean stress of the whole element works on the mean dilatation.
  const Points mean = geometry.share_volume * (stress[0] + stress[1] + stress[2]) / 3.;
  const Points shift = sum(mean) * geometry.volume_fraction - mean;
  const Points xx = geometry.share_volume * stress[0] + shift;
  const Points yy = geometry.share_volume * stress[1] + shift;
  const Points zz = geometry.share_volume * stress[2] + shift;
  const Points xy = geometry.share_volume * stress[3];
  const Points yz = geometry.share_volume * stress[4];
  const Points zx = geometry.share_volume * stress[5];
  for (int node = 0; node < n_nodes; ++node)
  {
    const Points &dx = geometry.gradient[0][node], &dy = geometry.gradient[1][node], &dz = geometry.gradient[2][node];
    force[3 * node] = sum(xx * dx + xy * dy + zx * dz);
    force[3 * node + 1] = sum(xy * dx + yy * dy + yz * dz);
    force[3 * node + 2] = sum(zx * dx + yz * dy + zz * dz);
  }
}

/// Nodal forces [N] of what the mean stresses of the points have beyond that of the element: internal_force() plus
/// these is ∫ ∇N · σ dV, in balance with whatever load the stress field is.
inline void unevenness_force(const Geometry &geometry, const Points (&stress)[6], double *force)
{
  const Points mean = geometry.share_volume * (stress[0] + stress[1] + stress[2]) / 3.;
  const Points uneven = mean - sum(mean) * geometry.volume_fraction;
  for (int node = 0; node < n_nodes; ++node)
    for (int i = 0; i < 3; ++i)
      force[3 * node + i] = sum(uneven * geometry.gradient[i][node]);
}

/// Stiffness [N/m], row-major 24×24, share included. @param stress_of stress_of(strain, stress) at all points: linear
template <class StressOf>
void stiffness(const Geometry &geometry, const StressOf &stress_of, double *matrix)
{
  for (int column = 0; column < n_dofs; ++column)
  {
    double unit[n_dofs] = {}, force[n_dofs];
    unit[column] = 1;
    Points unit_strain[6], stress[6];
    strain(geometry, unit, unit_strain);
    stress_of(unit_strain, stress);
    internal_force(geometry, stress, force);
    for (int row = 0; row < n_dofs; ++row)
      matrix[n_dofs * row + column] = force[row];
  }
}

/// Lumped mass per node [kg]: ∫ N_node ρ share dV, positive since the shape functions are.
inline void lumped_mass(const double density, const Geometry &geometry, double *mass)
{
  for (int node = 0; node < n_nodes; ++node)
  {
    mass[node] = 0;
    for (int point = 0; point < n_points; ++point)
      mass[node] += density * shape_value(node, point) * geometry.share_volume[point];
  }
}

} // namespace bergamo::fe::hexahedron
