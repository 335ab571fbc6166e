#pragma once

#include "dem/core/types.h"
#include "dem/shape/superquadric.h"
#include "dem/shape/support.h"

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
namespace bergamo::dem
{

/// A placed body, ready for support queries.
struct BodyPose
{
  SupportShape<double> shape; ///< body frame [m]
  Mat3 rotation;              ///< body to global
  Vec3 position;              ///< centre [m]
};

/// @param body the shape; @param position centre [m], global; @param orientation unit quaternion, body to global.
inline BodyPose make_pose(const Superquadric &body, const Vec3 &position, const Quaternion &orientation)
{
  return {{body.half_axes[0], body.half_axes[1], body.half_axes[2], 2. / (2. - body.eps1), 2. / (2. - body.eps2)},
          orientation.toRotationMatrix(),
          position};
}

/// Support of a placed body: everything in the global frame.
struct GlobalSupport
{
  double height; ///< h(n) measured from the centre [m]
  Vec3 arm;      ///< surface point minus centre [m]
  Mat3 hessian;  ///< d arm / d n [m]; its tangential part holds the radii of curvature
};

inline GlobalSupport support(const BodyPose &body, const Vec3 &normal)
{
  const Vec3 n = body.rotation.transpose() * normal;
  const Support<double> s = support(body.shape, n[0], n[1], n[2]);
  Mat3 h;
  h << s.h11, s.h12, s.h13, s.h12, s.h22, s.h23, s.h13, s.h23, s.h33;
  return {s.h, body.rotation * Vec3(s.x1, s.x2, s.x3), body.rotation * h * body.rotation.transpose()};
}

enum class ContactStatus
{
  touching,  ///< delta >= 0, the common normal is converged
  separated, ///< a separating direction is known; delta < 0 is minus a lower bound of the gap
  undecided  ///< no converged minimum found; the best direction is returned and the caller counts it
};

/// Result of a contact search.
struct ContactGeometry
{
  ContactStatus status = ContactStatus::undecided;
  Vec3 normal;             ///< c
  double overlap = 0.;     ///< delta [m]
  Vec3 arm1, arm2;         ///< p1 - x1 and p2 - x2 [m], global frame
  Mat3 hessian1, hessian2; ///< d p / d n of both surfaces at the contact [m], global frame
  int n_evaluations = 0;   ///< support evaluations of the pair
};

} // namespace bergamo::dem
