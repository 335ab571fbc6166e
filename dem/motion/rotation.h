#pragma once

#include "dem/core/pack.h"
#include "dem/core/rotation_matrix.h"

namespace bergamo::dem
{

/// Orientation as the numbers (x, y, z, w) of a unit quaternion; Real is double or Pack.
template <class Real>
struct Orientation
{
  Real x, y, z, w;

  Matrix3<Real> matrix() const { return rotation_matrix(x, y, z, w); }
};

namespace detail
{

/// sin(a)/a and (1 - cos(a))/a^2 of an angle a given by its square. Series below half a radian, where their next terms
/// are below 1e-16, else closed forms.
template <class Real>
struct RotationFactors
{
  Real sine, cosine;

  explicit RotationFactors(const Real &square)
  {
    const Real one(1.);
    const auto series = [&](const auto &...divisors)
    {
      Real sum = one;
      ((sum = one - square * Real(1. / divisors) * sum), ...);
      return sum;
    };
    sine = series(156., 110., 72., 42., 20., 6.);
    cosine = Real(0.5) * series(182., 132., 90., 56., 30., 12.);
    const auto is_large = square > Real(0.25);
    if (math::any(is_large))
    {
      const Real angle = math::sqrt(math::max(square, Real(0.25)));
      sine = math::select(is_large, Real(math::map(angle, [](const double a) { return std::sin(a) / a; })), sine);
      cosine = math::select(
          is_large, Real(math::map(angle, [](const double a) { return (1. - std::cos(a)) / (a * a); })), cosine);
    }
  }
};

/// v turned by the rotation vector theta [rad] (Rodrigues).
template <class Real>
Vector3<Real> turned(const Vector3<Real> &v, const Vector3<Real> &theta, const RotationFactors<Real> &f)
{
  const Vector3<Real> cross = theta.cross(v);
  return v + cross * f.sine + theta.cross(cross) * f.cosine;
}

} // namespace detail

/// Orientation turned by the rotation vector theta [rad], of length one again.
template <class Real>
Orientation<Real> turned(const Orientation<Real> &q, const Vector3<Real> &theta)
{
  const Real square = Real(0.25) * theta.squaredNorm();
  const detail::RotationFactors<Real> half(square);
  const Vector3<Real> r = theta * (Real(0.5) * half.sine);
  const Real c = Real(1.) - square * half.cosine;
  const Orientation<Real> p{
      c * q.x + r[0] * q.w + r[1] * q.z - r[2] * q.y, c * q.y + r[1] * q.w + r[2] * q.x - r[0] * q.z,
      c * q.z + r[2] * q.w + r[0] * q.y - r[1] * q.x, c * q.w - r[0] * q.x - r[1] * q.y - r[2] * q.z};
  const Real scale = math::inverse_sqrt(Real(p.x * p.x + p.y * p.y + p.z * p.z + p.w * p.w));
  return {p.x * scale, p.y * scale, p.z * scale, p.w * scale};
}

namespace detail
{

/// T diag(inverse inertia) T^T H
template <class Real>
Vector3<Real> spin_of(const Matrix3<Real> &matrix, const Vector3<Real> &inverse_inertia, const Vector3<Real> &momentum)
{
  const Vector3<Real> body = turn_back(matrix, momentum);
  return turn(matrix,
              Vector3<Real>(body[0] * inverse_inertia[0], body[1] * inverse_inertia[1], body[2] * inverse_inertia[2]));
}

} // namespace detail

/// omega = T I^-1 T^T H [1/s]. @param matrix T, body to global; @param inertia principal moments [kg m^2]
inline Vec3 angular_velocity(const Mat3 &matrix, const Vec3 &inertia, const Vec3 &angular_momentum)
{
  return detail::spin_of(matrix, Vec3(inertia.cwiseInverse()), angular_momentum);
}

/// Mean angular velocity over one step with the angular momentum H held: four evaluations averaged as in the classical
/// Runge-Kutta formula (Wellmann 3.40-3.44, after Munjiza et al. 2003), with the two commutators that rotations, which
/// do not commute, need for fourth order (Munthe-Kaas 1999; without them it is of second). Turning by it keeps H
/// exactly. Bodies of three equal moments take H / I.
/// @param orientation at the beginning of the step; @param inertia principal moments in the body frame [kg m^2]
template <class Real>
Vector3<Real> mean_angular_velocity(const Orientation<Real> &orientation, const Vector3<Real> &inertia,
                                    const Vector3<Real> &angular_momentum, const double time_step)
{
  const Real of_first = Real(1.) / inertia[0];
  const auto round = [&]() -> Vector3<Real> { return angular_momentum * of_first; };
  const auto is_round = inertia[0] == inertia[1] && inertia[1] == inertia[2];
  if (!math::any(!is_round))
    return round();
  const Vector3<Real> inverse(of_first, Real(1.) / inertia[1], Real(1.) / inertia[2]);
  const Matrix3<Real> matrix = orientation.matrix();
  const Vector3<Real> w1 = detail::spin_of(matrix, inverse, angular_momentum);
  // A body turned by theta sees the momentum turned back by it.
  const auto velocity_after = [&](const Vector3<Real> &w, const double dt) -> Vector3<Real>
  {
    const Vector3<Real> theta = w * Real(dt);
    const detail::RotationFactors<Real> f(theta.squaredNorm());
    const Vector3<Real> seen = detail::turned<Real>(angular_momentum, -theta, f);
    return detail::turned<Real>(detail::spin_of(matrix, inverse, seen), theta, f);
  };
  const Vector3<Real> w2 = velocity_after(w1, 0.5 * time_step);
  const Vector3<Real> w3 = velocity_after(w2 - w1.cross(w2) * Real(0.25 * time_step), 0.5 * time_step);
  const Vector3<Real> w4 = velocity_after(w3, time_step);
  const Vector3<Real> mean = (w1 + (w2 + w3) * Real(2.) + w4) * Real(1. / 6.) - w1.cross(w4) * Real(time_step / 12.);
  return math::select<Real>(is_round, round(), mean);
}

} // namespace bergamo::dem
