#pragma once

#include "dem/core/pack_vectors.h"
#include "dem/geometry/contact_geometry.h"

namespace bergamo::dem
{
namespace detail
{

/// A pose whose numbers are those of another one, each converted: from double to Pack or back.
template <class To, class From, class Convert>
Pose<To> convert_pose(const Pose<From> &body, const Convert &convert)
{
  const To one(1.);
  Pose<To> result{{one, one, one, one, one}, {}, {}};
  const SupportShape<From> &s = body.shape;
  SupportShape<To> &t = result.shape;
  t.r1 = convert(s.r1);
  t.r2 = convert(s.r2);
  t.r3 = convert(s.r3);
  t.q1 = convert(s.q1);
  t.q2 = convert(s.q2);
  t.q2_over_q1 = convert(s.q2_over_q1);
  t.one_over_q2 = convert(s.one_over_q2);
  for (int i = 0; i < 3; ++i)
  {
    result.position[i] = convert(body.position[i]);
    for (int j = 0; j < 3; ++j)
      result.rotation(i, j) = convert(body.rotation(i, j));
  }
  return result;
}

} // namespace detail

/// A body of its own in every lane. @param body body(lane): const BodyPose &
template <class Body>
Pose<Pack> gather_poses(const Body &body)
{
  Pose<Pack> packed = detail::convert_pose<Pack>(body(0), [](const double x) { return Pack(x); });
  const auto load = [&](const auto &number)
  { return math::generate<Pack>([&](const int lane) -> double { return number(body(lane)); }); };
  SupportShape<Pack> &s = packed.shape;
  s.r1 = load([](const BodyPose &b) { return b.shape.r1; });
  s.r2 = load([](const BodyPose &b) { return b.shape.r2; });
  s.r3 = load([](const BodyPose &b) { return b.shape.r3; });
  s.q1 = load([](const BodyPose &b) { return b.shape.q1; });
  s.q2 = load([](const BodyPose &b) { return b.shape.q2; });
  s.q2_over_q1 = load([](const BodyPose &b) { return b.shape.q2_over_q1; });
  s.one_over_q2 = load([](const BodyPose &b) { return b.shape.one_over_q2; });
  for (int i = 0; i < 3; ++i)
  {
    packed.position[i] = load([i](const BodyPose &b) { return b.position[i]; });
    for (int j = 0; j < 3; ++j)
      packed.rotation(i, j) = load([i, j](const BodyPose &b) { return b.rotation(i, j); });
  }
  return packed;
}

/// The same body in every lane.
inline Pose<Pack> in_every_lane(const BodyPose &body)
{
  return detail::convert_pose<Pack>(body, [](const double x) { return Pack(x); });
}

/// The body of one lane.
template <class Real>
BodyPose lane(const Pose<Real> &body, const int k)
{
  return detail::convert_pose<double>(body, [k](const Real &x) { return math::lane(x, k); });
}

} // namespace bergamo::dem
