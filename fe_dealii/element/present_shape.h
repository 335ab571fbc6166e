#pragma once

#include "fe_dealii/element/hexahedron.h"
#include "fe_dealii/material/deformation.h"

namespace bergamo::fe
{

/// A hexahedron at a displacement of its nodes.
struct PresentShape
{
  /// Gradients by the present places, and the fractions of the present volume, with which strain() and internal_force()
  /// are those of this shape; volumes are the reference's, with which Kirchhoff stresses count.
  hexahedron::Geometry geometry;
  double volume;         ///< [m³]
  double smallest_ratio; ///< least det F; not positive where the element has turned inside out
};

/// @param u of the nodes, 3*node + component [m]
inline PresentShape present_shape(const hexahedron::Geometry &reference, const double *u)
{
  Tensor3<Points> f;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      f[i][j] = Points(i == j ? 1. : 0.);
      for (int node = 0; node < hexahedron::n_nodes; ++node)
        f[i][j] += u[3 * node + i] * reference.gradient[j][node];
    }
  Tensor3<Points> inverse_transposed = cofactor(f);
  const Points ratio = determinant(f, inverse_transposed), present_volume = ratio * reference.volume;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      inverse_transposed[i][j] = inverse_transposed[i][j] / ratio;
  PresentShape shape;
  shape.volume = sum(present_volume);
  shape.smallest_ratio = least(ratio);
  shape.geometry.volume = reference.volume;
  shape.geometry.share_volume = reference.share_volume;
  shape.geometry.volume_fraction = present_volume / shape.volume;
  for (int node = 0; node < hexahedron::n_nodes; ++node)
    for (int i = 0; i < 3; ++i)
      shape.geometry.gradient[i][node] = inverse_transposed[i][0] * reference.gradient[0][node] +
                                         inverse_transposed[i][1] * reference.gradient[1][node] +
                                         inverse_transposed[i][2] * reference.gradient[2][node];
  return shape;
}

/// Axial vector of the skew part of an increment's gradient, by the places of the shape [rad].
struct Spin
{
  Points x, y, z;
};

/// @param increment of the nodes' displacements [m]
inline Spin spin(const hexahedron::Geometry &geometry, const double *increment)
{
  Spin twice{};
  for (int node = 0; node < hexahedron::n_nodes; ++node)
  {
    const Points &dx = geometry.gradient[0][node], &dy = geometry.gradient[1][node], &dz = geometry.gradient[2][node];
    const double ux = increment[3 * node], uy = increment[3 * node + 1], uz = increment[3 * node + 2];
    twice.x += uz * dy - uy * dz;
    twice.y += ux * dz - uz * dx;
    twice.z += uy * dx - ux * dy;
  }
  return {0.5 * twice.x, 0.5 * twice.y, 0.5 * twice.z};
}

/// The spin of half the rotation, see turn().
inline Spin half_of(const Spin &w)
{
  const Points factor = 1. / (1. + math::sqrt(1. + 0.25 * (w.x * w.x + w.y * w.y + w.z * w.z)));
  return {factor * w.x, factor * w.y, factor * w.z};
}

/// Turns stresses xx yy zz xy yz zx [Pa] by the rotation of which the spin in the middle of a step is the increment,
/// Q = (1 - W/2)^-1 (1 + W/2) (Hughes & Winget, 1980): for a rigid rotation exactly that.
inline void turn(const Spin &w, Points (&stress)[6])
{
  const Points square = w.x * w.x + w.y * w.y + w.z * w.z, factor = 1. / (1. + 0.25 * square), half = 0.5 * factor;
  const Points q[3][3] = {
      {1. + half * (w.x * w.x - square), half * w.x * w.y - factor * w.z, half * w.x * w.z + factor * w.y},
      {half * w.y * w.x + factor * w.z, 1. + half * (w.y * w.y - square), half * w.y * w.z - factor * w.x},
      {half * w.z * w.x - factor * w.y, half * w.z * w.y + factor * w.x, 1. + half * (w.z * w.z - square)}};
  const Points s[3][3] = {
      {stress[0], stress[3], stress[5]}, {stress[3], stress[1], stress[4]}, {stress[5], stress[4], stress[2]}};
  Points qs[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      qs[i][j] = q[i][0] * s[0][j] + q[i][1] * s[1][j] + q[i][2] * s[2][j];
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int c = 0; c < 6; ++c)
    stress[c] = qs[row[c]][0] * q[column[c]][0] + qs[row[c]][1] * q[column[c]][1] + qs[row[c]][2] * q[column[c]][2];
}

} // namespace bergamo::fe
