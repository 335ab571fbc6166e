#pragma once

#include "dem/core/pack.h"

#include <array>

namespace bergamo::dem
{

/// Motion of the material of a feature of a surface over a step: each of its points, and what is straight above it,
/// moves with its nodes and turns with its face. Real is double or Pack.
template <class Real>
struct FeatureField
{
  Vector3<Real> node, velocity; ///< place and velocity of one of its nodes [m], [m/s]
  Vector3<Real> spin;           ///< of the feature's face, or of one of its faces [1/s]
  Matrix3<Real> gradient;       ///< of the velocity, by place [1/s]

  /// @param point on or above the feature [m]
  Vector3<Real> velocity_at(const Vector3<Real> &point) const
  {
    const Vector3<Real> arm = point - node;
    return velocity + gradient.col(0) * arm[0] + gradient.col(1) * arm[1] + gradient.col(2) * arm[2];
  }
};

/// The plane of a triangle, what its motion does to points above it, and, as the transpose, what a force there does to
/// its nodes. Real is double or Pack.
template <class Real>
struct FacePlane
{
  Vector3<Real> normal;              ///< unit vector
  Vector3<Real> of_second, of_third; ///< gradients of the shares of the second and third node in the plane [1/m]

  /// @param node by place in the triangle [m]
  explicit FacePlane(const std::array<Vector3<Real>, 3> &node)
  {
    const Vector3<Real> a = node[1] - node[0], b = node[2] - node[0], area = a.cross(b);
    const Real inverse_root = math::inverse_sqrt(Real(area.squaredNorm()));
    normal = area * inverse_root;
    const Vector3<Real> inverse = normal * inverse_root;
    of_second = b.cross(inverse);
    of_third = inverse.cross(a);
  }

  /// The face turns with its normal, and about it by the mean of what turns the plane in itself.
  /// @param node places; @param velocity of the nodes [m/s]
  FeatureField<Real> field(const std::array<Vector3<Real>, 3> &node, const std::array<Vector3<Real>, 3> &velocity) const
  {
    const Vector3<Real> va = velocity[1] - velocity[0], vb = velocity[2] - velocity[0];
    const Vector3<Real> of_normal = -(of_second * va.dot(normal) + of_third * vb.dot(normal)); // its rate
    FeatureField<Real> field{node[0], velocity[0], {}, {}};
    field.spin = normal.cross(of_normal) + normal * (Real(0.5) * normal.dot(of_second.cross(va) + of_third.cross(vb)));
    for (int d = 0; d < 3; ++d)
      field.gradient.col(d) = va * of_second[d] + vb * of_third[d] + of_normal * normal[d];
    return field;
  }

  /// Forces on the nodes that do the work of a force along field(), with its moment.
  /// @param arm of the force from the first node [m]; @param force [N]
  std::array<Vector3<Real>, 3> forces(const Vector3<Real> &arm, const Vector3<Real> &force) const
  {
    const Vector3<Real> tilting = normal * arm.dot(normal);
    const Vector3<Real> on_second = force * of_second.dot(arm) - tilting * of_second.dot(force),
                        on_third = force * of_third.dot(arm) - tilting * of_third.dot(force);
    return {force - on_second - on_third, on_second, on_third};
  }
};

} // namespace bergamo::dem
