#pragma once

#include "dem/force/contact_scene.h"
#include "dem/force/contact_turn.h"
#include "dem/geometry/turn_wear.h"

/// How a touching contact takes what its search has found.
namespace bergamo::dem
{

/// Radii of curvature seen from the frame of a tangential axis.
template <class Real>
CurvatureRadii<Real> seen_from(const Vector3<Real> &axis, const TangentFrameOf<Real> &frame,
                               const CurvatureRadii<Real> &radii)
{
  const Vector2<Real> x = in_frame(frame, axis), y(-x[1], x[0]), rx = radii * x, ry = radii * y;
  return {x.dot(rx), y.dot(ry), x.dot(ry)};
}

/// Places a contact; its tangential force turns with it: the shortest way onto the new tangent plane, magnitude kept
/// (Wellmann 3.24 ff.).
template <class Real>
void place_contact(ContactState<Real> &s, const Vector3<Real> &normal, const Vector3<Real> &point, const Real &overlap,
                   const RelativeCurvature<Real> &curvature, const ElasticPair &elastic)
{
  const Vector3<Real> old = s.tangential_force(), flat = old - normal * normal.dot(old);
  s.normal = normal;
  s.axis = curvature.major_axis;
  s.point = point;
  s.overlap = overlap;
  s.stiffness = hertz_mindlin(curvature.a, curvature.b, elastic);
  const Real length = flat.squaredNorm();
  const Real scale = math::select(length > Real(0.), Real(math::sqrt(old.squaredNorm() / length)), Real(0.));
  s.forces.tangential = {s.axis.dot(flat) * scale, s.second_axis().dot(flat) * scale};
}

/// Error that following may make of an overlap [m]. A contact for which none is allowed is searched every step, but
/// goes there by being followed: then what counts is whether the radii of a flat face would lead anywhere.
template <class Real>
Real error_of_following(const ContactParameters &parameters, const Real &overlap)
{
  constexpr double anywhere = 1e6; // overlaps
  return Real(parameters.overlap_tolerance > 0. ? parameters.overlap_tolerance : anywhere) * overlap;
}

/// @param wear1, wear2 of both bodies, see error_of_following()
template <class Real>
void give_budget(ContactState<Real> &s, const ContactParameters &parameters, const TurnWear<Real> &wear1,
                 const TurnWear<Real> &wear2)
{
  constexpr double leads_anywhere = 1e6; // [1/rad]
  const bool is_followed = parameters.overlap_tolerance > 0.;
  const auto of_flat_faces = [&](const Real &wear) -> Real
  { return math::select(wear > Real(leads_anywhere), wear, Real(0.)); };
  for (int axis = 0; axis < 2; ++axis)
  {
    s.wear1[axis] = is_followed ? wear1.tilt[axis] : of_flat_faces(wear1.tilt[axis]);
    s.wear2[axis] = is_followed ? wear2.tilt[axis] : of_flat_faces(wear2.tilt[axis]);
  }
  s.twist_wear = is_followed ? Real(wear1.twist + wear2.twist) : Real(0.);
  s.budget = Real(is_followed ? 1. : -1.);
}

/// Brings a contact that was placed to this step. One that was followed here only takes the overlap and the stiffness
/// that the search has found, and what that puts in is booked; a new one, or one that could not be followed, makes the
/// step now.
/// @param before the search; @param[in,out] losses with the weight [J]
template <class Real, class Motion>
void take_search(ContactState<Real> &s, const ContactState<Real> &before, const Motion &motion,
                 const ContactScene &scene, Losses<Real> &losses)
{
  const math::Mask<Real> is_followed = before.budget > Real(s.lost);
  const Vector3<Real> displacement = motion.displacement(s.point);
  // What the trapezoidal rule has missed so far: the force's turn, or its correction.
  const auto missed = [&] { return Real(0.5) * (s.force() - before.force()).dot(displacement); };
  ContactState<Real> stepped = s;
  if (math::any(!is_followed))
  {
    // The dashpot's force of last step stays.
    const Real old_elastic = elastic_force(s.stiffness.normal, before.root());
    s.forces.normal =
        math::select(before.overlap > Real(0.), Real(old_elastic + (before.forces.normal - before.elastic_force())),
                     before.forces.normal);
    stepped = s;
    TangentFrameOf<Real> frame;
    frame << s.axis, s.second_axis();
    const ContactMotion<Real, Vector2<Real>> seen{-s.normal.dot(displacement), in_frame(frame, displacement)};
    Losses<Real> lost;
    advance_contact(stepped, scene.law, before.overlap, seen, scene.time_step, lost);
    lost.quadrature += missed();
    ContactState<Real> stiffened = s; // at the overlap of last step
    stiffened.overlap = before.overlap;
    lost.curvature += math::select(before.overlap > Real(0.),
                                   Real(spring_energy(stiffened).sum() - spring_energy(before).sum()), Real(0.));
    losses += losses_where<Real>(!is_followed, lost);
    // What was no number and is replaced would stop the run without a name.
    stepped.forces.normal += Real(0.) * (lost.curvature + lost.quadrature);
  }
  if (math::any(is_followed))
  {
    ContactState<Real> corrected = before;
    corrected.overlap = s.overlap;
    const Real as_placed = spring_energy(s).sum();
    const Real pushing = s.elastic_force() + (before.forces.normal - before.elastic_force());
    s.forces.normal = math::select(pushing <= Real(0.), Real(0.), pushing);
    const Real limit = Real(scene.law.friction) * s.forces.normal, square = s.forces.tangential.squaredNorm();
    const math::Mask<Real> sticks = square <= limit * limit;
    s.forces.tangential *=
        math::select(sticks, Real(1.), Real(limit * math::inverse_sqrt(math::select(sticks, Real(1.), square))));
    Losses<Real> put_in;
    put_in.search =
        (spring_energy(corrected).sum() - spring_energy(before).sum()) + (spring_energy(s).sum() - as_placed);
    put_in.curvature = as_placed - spring_energy(corrected).sum();
    put_in.quadrature = -missed();
    losses += losses_where<Real>(is_followed, put_in);
    s.forces.normal += Real(0.) * (put_in.search + put_in.curvature);
  }
  s.forces.tangential = math::select<Real>(is_followed, s.forces.tangential, stepped.forces.tangential);
  s.forces.normal = math::select(is_followed, s.forces.normal, stepped.forces.normal);
}

/// Losses where a contact is found apart. @param s followed to this step, or lost and as last step left it
template <class Motion>
ContactLosses end_of(const ContactState<double> &s, const Motion &motion)
{
  if (s.budget > s.lost)
  {
    ContactLosses losses = release(s);
    losses.search = -stored_energy(s).normal;
    losses.quadrature = 0.5 * s.force().dot(motion.displacement(s.point));
    return losses;
  }
  TangentFrame frame;
  frame << s.axis, s.second_axis();
  const Vec3 displacement = motion.displacement(s.point);
  return separate(s, ContactMotion<double, Vec2>{-s.normal.dot(displacement), in_frame(frame, displacement)});
}

} // namespace bergamo::dem
