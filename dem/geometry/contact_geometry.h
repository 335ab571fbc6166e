#pragma once

#include "dem/core/rotation_matrix.h"
#include "dem/core/tangent_frame.h"
#include "dem/core/types.h"
#include "dem/geometry/superquadric.h"
#include "dem/geometry/support.h"

/// The geometry of one contact. The sign convention of the whole program stands here:
///
///  * the contact normal c is a unit vector that points from body 1 to body 2;
///  * the overlap delta > 0 means contact, delta < 0 is minus the width of the gap along c;
///  * p1 = x1 + grad h1(c) lies on body 1 (inside body 2 when they touch), p2 = x2 + grad h2(-c) on body 2;
///    at the solution p1 - p2 = delta c;
///  * body 1 is pushed by -f_N c, body 2 by +f_N c.
///
/// c minimises phi(c) = h1(c) + h2(-c) - c.(x2 - x1) over the unit sphere, and delta = min phi:
/// the dissertation's common-normal conditions (Wellmann, eq. 3.50-3.52) without angles and poles.
///
/// Real is double or Pack: a pack holds as many independent pairs as it has lanes.
namespace bergamo::dem
{

/// A placed body, ready for support queries.
template <class Real>
struct Pose
{
  SupportShape<Real> shape; ///< body frame [m]
  Matrix3<Real> rotation;   ///< body to global
  Vector3<Real> position;   ///< centre [m]
};
using BodyPose = Pose<double>;

/// @param body the shape; @param position centre [m], global; @param orientation unit quaternion, body to global.
inline BodyPose make_pose(const Superquadric &body, const Vec3 &position, const Quaternion &orientation)
{
  return {support_shape(body), orientation.toRotationMatrix(), position};
}

/// Radii of curvature of a surface at a contact: the symmetric 2x2 tensor d p / d n in tangent_frame(normal) [m].
/// Its eigenvalues are the principal radii, its eigenvectors the principal directions.
template <class Real>
struct CurvatureRadii
{
  Real r11, r22, r12;

  CurvatureRadii operator+(const CurvatureRadii &o) const { return {r11 + o.r11, r22 + o.r22, r12 + o.r12}; }
  CurvatureRadii operator-(const Real &round) const { return {r11 - round, r22 - round, r12}; }
  Vector2<Real> operator*(const Vector2<Real> &v) const { return {r11 * v[0] + r12 * v[1], r12 * v[0] + r22 * v[1]}; }

  /// The vector that the tensor takes to this one.
  Vector2<Real> solve(const Vector2<Real> &v) const
  {
    const Real inverse = Real(1.) / (r11 * r22 - r12 * r12);
    return {(r22 * v[0] - r12 * v[1]) * inverse, (r11 * v[1] - r12 * v[0]) * inverse};
  }

  /// Frobenius norm [m].
  Real norm() const
  {
    const Real twice = r12 + r12;
    return math::sqrt(r11 * r11 + r22 * r22 + twice * r12);
  }
};

template <class Real>
CurvatureRadii<double> lane(const CurvatureRadii<Real> &radii, const int k)
{
  return {math::lane(radii.r11, k), math::lane(radii.r22, k), math::lane(radii.r12, k)};
}

/// Support of a placed body in the global frame.
template <class Real>
struct PlacedSupport
{
  Real height;                ///< h(n) measured from the centre [m]
  Vector3<Real> arm;          ///< surface point minus centre [m]
  CurvatureRadii<Real> radii; ///< in the given tangent frame
};

namespace detail
{

/// Bounds the curvature of a flat face. In its middle radii are 1e95 and more: projected on the tangent frame they
/// would drown the others in rounding. What is bounded is the tensor, D H D plus what its diagonal then lacks, D =
/// min(1, flattest / H_ii): it stays positive semidefinite and continuous, and where two radii of one face go to
/// infinity together their coupling H_ij goes to zero. So in the middle of a face both radii are at the bound in any
/// direction, the limit of all tilts. Entries that are no larger than the bound keep their bits.
template <class Real>
void bound_flat_radii(Support<Real> &s)
{
  const Real flattest = Real(1e12) * s.h;
  const auto is_flat = math::max(math::max(s.h11, s.h22), s.h33) > flattest;
  if (!math::any(is_flat)) // mostly
    return;
  const auto share = [&](const Real &radius) -> Real { return flattest / math::max(radius, flattest); };
  const Real d1 = share(s.h11), d2 = share(s.h22), d3 = share(s.h33);
  s.h12 *= d1 * d2;
  s.h13 *= d1 * d3;
  s.h23 *= d2 * d3;
  s.h11 = math::min(s.h11, flattest);
  s.h22 = math::min(s.h22, flattest);
  s.h33 = math::min(s.h33, flattest);
}

} // namespace detail

/// @param normal unit vector, global; @param frame tangent_frame(normal), or of -normal: the radii are even in it.
template <class Real>
[[gnu::flatten]] PlacedSupport<Real> support(const Pose<Real> &body, const Vector3<Real> &normal,
                                             const TangentFrameOf<Real> &frame)
{
  const Matrix3<Real> &r = body.rotation;
  const Vector3<Real> n = turn_back(r, normal), t1 = turn_back<Real>(r, frame.col(0)),
                      t2 = turn_back<Real>(r, frame.col(1));
  Support<Real> s = support(body.shape, n[0], n[1], n[2]);
  detail::bound_flat_radii(s);
  const auto times_hessian = [&](const Vector3<Real> &t) -> Vector3<Real>
  {
    return {s.h11 * t[0] + s.h12 * t[1] + s.h13 * t[2], s.h12 * t[0] + s.h22 * t[1] + s.h23 * t[2],
            s.h13 * t[0] + s.h23 * t[1] + s.h33 * t[2]};
  };
  const Vector3<Real> h1 = times_hessian(t1), h2 = times_hessian(t2);
  return {s.h, turn(r, Vector3<Real>(s.x1, s.x2, s.x3)), {t1.dot(h1), t2.dot(h2), t1.dot(h2)}};
}

inline PlacedSupport<double> support(const BodyPose &body, const Vec3 &normal)
{
  return support(body, normal, tangent_frame(normal));
}

/// Product of both principal radii of a body's surface where its outward normal is n [m^2]. From the body's own axes,
/// along which flat faces and ridges lie: it keeps a small radius beside a huge one, which the tensor in a tangent
/// frame loses. The sum of the principal minors of dX/dN, since N is in its kernel.
/// @param normal unit vector, global
template <class Real>
Real product_of_radii(const Pose<Real> &body, const Vector3<Real> &normal)
{
  const Vector3<Real> n = turn_back(body.rotation, normal);
  Support<Real> s = support(body.shape, n[0], n[1], n[2]);
  detail::bound_flat_radii(s);
  return (s.h11 * s.h22 - s.h12 * s.h12) + (s.h11 * s.h33 - s.h13 * s.h13) + (s.h22 * s.h33 - s.h23 * s.h23);
}

enum class ContactStatus
{
  touching,  ///< delta >= 0, the common normal is converged or, at a kink, proven
  separated, ///< a separating direction is known; delta < 0 is minus a lower bound of the gap
  undecided  ///< no converged minimum found; the best direction is returned and the caller counts it
};

/// Result of a contact search.
struct ContactGeometry
{
  ContactStatus status = ContactStatus::undecided;
  Vec3 normal;                           ///< c
  double overlap = 0.;                   ///< delta [m]
  Vec3 arm1, arm2;                       ///< p1 - x1 and p2 - x2 [m], global frame
  CurvatureRadii<double> radii1, radii2; ///< of both surfaces at the contact, in tangent_frame(normal)
  int n_evaluations = 0;                 ///< support evaluations of the pair
};

} // namespace bergamo::dem
