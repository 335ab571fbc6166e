#pragma once

#include "dem/geometry/centre_line.h"
#include "dem/geometry/common_normal.h"
#include "dem/geometry/newton_search.h"
#include "dem/geometry/pose_lanes.h"
#include "dem/geometry/turn_wear.h"

#include <array>

namespace bergamo::dem
{

/// What the search of as many pairs as Real has lanes found.
template <class Real>
struct FoundContacts
{
  Vector3<Real> normal;
  Real overlap; ///< > 0: touching; otherwise minus a lower bound of the gap [m]
  Vector3<Real> arm1, arm2;
  CurvatureRadii<Real> radii1, radii2; ///< in the frame
  TangentFrameOf<Real> frame;          ///< of the normal
  std::array<bool, width<Real>> is_undecided = {};
  int n_alone = 0;       ///< lanes that the pack left to a search of their own
  int n_evaluations = 0; ///< all lanes together
};

namespace detail
{

inline void set_lane(double &target, int, const double value)
{
  target = value;
}
inline void set_lane(Pack &target, const int k, const double value)
{
  target[static_cast<std::size_t>(k)] = value;
}
template <class Real>
void set_lane(Vector3<Real> &target, const int k, const Vec3 &value)
{
  for (int d = 0; d < 3; ++d)
    set_lane(target[d], k, value[d]);
}
template <class Real>
void set_lane(CurvatureRadii<Real> &target, const int k, const CurvatureRadii<double> &value)
{
  set_lane(target.r11, k, value.r11);
  set_lane(target.r22, k, value.r22);
  set_lane(target.r12, k, value.r12);
}
template <class Real>
void set_lane(TangentFrameOf<Real> &target, const int k, const TangentFrame &value)
{
  for (int d = 0; d < 6; ++d)
    set_lane(target(d), k, value(d));
}

template <class Real>
FoundContacts<Real> found_at(const Evaluation<Real> &e)
{
  return {e.c, e.phi, e.arm1, e.arm2, e.radii1, e.radii2, tangent_frame(e.c)};
}

/// The minimum of the second-order model at a direction near it.
template <class Real>
struct ModelMinimum
{
  FoundContacts<Real> found;
  math::Mask<Real> is_sure; ///< touching, and the model's error of the overlap is below a share of what is allowed

  static constexpr double share = 0.01;

  /// @param tolerance error allowed: of the overlap over the overlap, of the normal [rad]
  ModelMinimum(const Pose<Real> &body1, const Pose<Real> &body2, const Evaluation<Real> &e, const double tolerance)
      : found(found_at(e))
  {
    const TangentFrameOf<Real> &frame = found.frame;
    const CurvatureRadii<Real> hessian = e.radii1 + e.radii2 - e.phi;
    const Vector2<Real> gap = in_frame(frame, e.gap), tilt = hessian.solve(gap);
    found.overlap = e.phi - Real(0.5) * tilt.dot(gap);
    const Real square = tilt.squaredNorm(), length = math::sqrt(square);
    const Vector2<Real> along = tilt / math::max(length, Real(1e-150));
    const Vector3<Real> towards = from_frame(frame, along);
    const Real change1 = RadiiChange<Real>(body1, e.c, e.arm1)(towards),
               change2 = RadiiChange<Real>(body2, e.c, e.arm2)(towards);
    const Real change_of_slope = change1 * along.dot(e.radii1 * along) + change2 * along.dot(e.radii2 * along);
    is_sure = found.overlap > Real(0.) && hessian.r11 > Real(0.) &&
              hessian.r11 * hessian.r22 > hessian.r12 * hessian.r12 &&
              square * length * change_of_slope < Real(6. * share * tolerance) * found.overlap &&
              square * (change1 + change2) < Real(0.1 * tolerance);
    found.arm1 += from_frame(frame, e.radii1 * tilt);
    found.arm2 -= from_frame(frame, e.radii2 * tilt);
    const Vector3<Real> normal = e.c + from_frame(frame, tilt);
    found.normal = normal / math::sqrt(normal.squaredNorm());
    const Vector3<Real> first = frame.col(0) - found.normal * found.normal.dot(frame.col(0));
    found.frame.col(0) = first / math::sqrt(first.squaredNorm());
    found.frame.col(1) = found.normal.cross(Vector3<Real>(found.frame.col(0)));
  }
};

/// Takes lanes of another result.
template <class Real>
void replace_where(FoundContacts<Real> &found, const math::Mask<Real> &mask, const FoundContacts<Real> &other)
{
  found.overlap = math::select(mask, other.overlap, found.overlap);
  for (auto vector : {&FoundContacts<Real>::normal, &FoundContacts<Real>::arm1, &FoundContacts<Real>::arm2})
    found.*vector = math::select<Real>(mask, other.*vector, found.*vector);
  for (auto radii : {&FoundContacts<Real>::radii1, &FoundContacts<Real>::radii2})
    for (auto entry : {&CurvatureRadii<Real>::r11, &CurvatureRadii<Real>::r22, &CurvatureRadii<Real>::r12})
      found.*radii.*entry = math::select(mask, other.*radii.*entry, found.*radii.*entry);
  for (int axis = 0; axis < 2; ++axis)
    found.frame.col(axis) =
        math::select<Real>(mask, Vector3<Real>(other.frame.col(axis)), Vector3<Real>(found.frame.col(axis)));
}

} // namespace detail

/// What one evaluation at a guess says of a pack of pairs.
template <class Real>
struct FirstLook
{
  FoundContacts<Real> found;
  math::Mask<Real> is_decided; ///< apart, touching to rounding or within the tolerance; or no number

  /// As search_pairs() below.
  FirstLook(const Pose<Real> &body1, const Pose<Real> &body2, const Vector3<Real> &guess, const double tolerance)
      : FirstLook(NewtonSearch<Real>(body1, body2, start_of(body1, body2, guess)), guess.squaredNorm() > Real(0.))
  {
    if (!(tolerance > 0.))
      return;
    const detail::ModelMinimum<Real> model(body1, body2, search.best, tolerance);
    is_sure = is_known && model.is_sure;
    is_decided = is_decided || is_sure;
    detail::replace_where(found, is_sure, model.found);
  }

  /// Where the search begins: at the guess, or along the line of the centres.
  static Vector3<Real> start_of(const Pose<Real> &body1, const Pose<Real> &body2, const Vector3<Real> &guess)
  {
    const Real square = guess.squaredNorm();
    return math::select<Real>(square > Real(0.), Vector3<Real>(guess / math::sqrt(square)),
                              centre_direction<Real>(body2.position - body1.position));
  }

  NewtonSearch<Real> search;
  Vector3<Real> next;                                 ///< direction from which to go on
  math::Mask<Real> is_known;                          ///< had a guess
  math::Mask<Real> is_sure = math::Mask<Real>(false); ///< the model's minimum was taken

private:
  FirstLook(const NewtonSearch<Real> &search, const math::Mask<Real> &is_known)
      : found(detail::found_at(search.best)), search(search), next(search.next()), is_known(is_known)
  {
    const math::Mask<Real> is_number = found.overlap == found.overlap; // a state that is none stops the run elsewhere
    math::Mask<Real> is_doubtful = search.is_open || is_saddle(search);
    if (math::any(!is_known))
      is_doubtful = is_doubtful || (!is_known && is_suspicious(search));
    is_decided = !is_number || !is_doubtful;
    for (int k = 0; k < width<Real>; ++k)
      found.is_undecided[k] = !math::lane(is_number, k);
  }
};

/// Searches a pack of pairs: by one evaluation where the guess is so good that this is enough; then all other lanes
/// together; then one by one those that are still open, or where the minimum found may be the wrong one. Each lane's
/// result is find_contact's or update_contact's, to rounding or within the tolerance.
/// @param guess normals of earlier, nearby configurations, of any length; zero for a pair without
/// @param n lanes that count, from the first; the others must hold valid bodies
/// @param tolerance error that is allowed, of the overlap over the overlap, of the normal [rad]: one evaluation may
///        leave a hundredth of it; 0: none
template <class Real>
FoundContacts<Real> search_pairs(const Pose<Real> &body1, const Pose<Real> &body2, const Vector3<Real> &guess,
                                 const int n, const double tolerance = 0.)
{
  constexpr int max_evaluations = 12; // together: more would wait for the last lanes
  FirstLook<Real> look(body1, body2, guess, tolerance);
  look.found.n_evaluations = n;
  if (!math::any(!look.is_decided))
    return look.found;
  NewtonSearch<Real> &search = look.search;
  search.close(look.is_decided);
  FoundContacts<Real> found = look.found;
  math::Mask<Real> is_found = look.is_decided;
  search.run(max_evaluations,
             [&]
             {
               const math::Mask<Real> is_asked = look.is_known && search.is_open && search.best.phi > Real(0.);
               if (!(tolerance > 0.) || !math::any(is_asked))
                 return;
               const detail::ModelMinimum<Real> model(body1, body2, search.best, tolerance);
               const math::Mask<Real> is_sure = is_asked && model.is_sure;
               detail::replace_where(found, is_sure, model.found);
               search.close(is_sure);
               is_found = is_found || is_sure;
             });
  detail::replace_where<Real>(found, !is_found, detail::found_at(search.best));
  found.is_undecided = look.found.is_undecided;
  found.n_evaluations = search.n_evaluations * n;
  math::Mask<Real> is_doubtful = search.is_open || is_saddle(search);
  if (math::any(!look.is_known))
    is_doubtful = is_doubtful || (!look.is_known && is_suspicious(search));
  is_doubtful = is_doubtful && !is_found;
  if (!math::any(is_doubtful))
    return found;
  const Vector3<Real> start = FirstLook<Real>::start_of(body1, body2, guess);
  for (int k = 0; k < n; ++k)
    if (math::lane(is_doubtful, k))
    {
      const BodyPose alone1 = lane(body1, k), alone2 = lane(body2, k);
      const ContactGeometry g = math::lane(look.is_known, k)
                                    ? update_contact(alone1, alone2, math::lane<Real>(start, k))
                                    : find_contact(alone1, alone2);
      detail::set_lane(found.normal, k, g.normal);
      detail::set_lane(found.overlap, k, g.overlap);
      detail::set_lane(found.arm1, k, g.arm1);
      detail::set_lane(found.arm2, k, g.arm2);
      detail::set_lane(found.radii1, k, g.radii1);
      detail::set_lane(found.radii2, k, g.radii2);
      detail::set_lane(found.frame, k, tangent_frame(g.normal));
      found.is_undecided[k] = g.status == ContactStatus::undecided;
      ++found.n_alone;
      found.n_evaluations += g.n_evaluations;
    }
  return found;
}

} // namespace bergamo::dem
