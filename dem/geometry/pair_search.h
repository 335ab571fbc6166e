#pragma once

#include "dem/geometry/centre_line.h"
#include "dem/geometry/common_normal.h"
#include "dem/geometry/newton_search.h"
#include "dem/geometry/pose_lanes.h"

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
  CurvatureRadii<Real> radii1, radii2; ///< in tangent_frame(normal)
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

} // namespace detail

/// Searches a pack of pairs: all lanes together at first, then one by one those that are still open, or where the
/// minimum found may be the wrong one. Each lane's result is find_contact's or update_contact's, to rounding.
/// @param guess normals of earlier, nearby configurations, of any length; zero for a pair without
/// @param n lanes that count, from the first; the others must hold valid bodies
template <class Real>
FoundContacts<Real> search_pairs(const Pose<Real> &body1, const Pose<Real> &body2, const Vector3<Real> &guess,
                                 const int n)
{
  constexpr int max_evaluations = 12; // together: more would wait for the last lanes
  const Vector3<Real> centre_line = body2.position - body1.position;
  const Real guess_square = guess.squaredNorm();
  const math::Mask<Real> is_known = guess_square > Real(0.);
  const Vector3<Real> start =
      math::select<Real>(is_known, Vector3<Real>(guess / math::sqrt(guess_square)), centre_direction(centre_line));
  NewtonSearch<Real> search(body1, body2, start);
  search.run(max_evaluations);

  const Evaluation<Real> &e = search.best;
  FoundContacts<Real> found{e.c, e.phi, e.arm1, e.arm2, e.radii1, e.radii2};
  found.n_evaluations = search.n_evaluations * n;
  const math::Mask<Real> is_number = e.phi == e.phi; // a state that is none stops the run elsewhere
  math::Mask<Real> is_doubtful = search.is_open || is_saddle(search);
  if (math::any(!is_known))
    is_doubtful = is_doubtful || (!is_known && is_suspicious(search));
  is_doubtful = is_doubtful && is_number;
  if (math::any(!is_number))
    for (int k = 0; k < n; ++k)
      found.is_undecided[k] = !math::lane(is_number, k);
  if (!math::any(is_doubtful))
    return found;
  for (int k = 0; k < n; ++k)
    if (math::lane(is_doubtful, k))
    {
      const BodyPose alone1 = lane(body1, k), alone2 = lane(body2, k);
      const ContactGeometry g = math::lane(is_known, k) ? update_contact(alone1, alone2, math::lane<Real>(start, k))
                                                        : find_contact(alone1, alone2);
      detail::set_lane(found.normal, k, g.normal);
      detail::set_lane(found.overlap, k, g.overlap);
      detail::set_lane(found.arm1, k, g.arm1);
      detail::set_lane(found.arm2, k, g.arm2);
      detail::set_lane(found.radii1, k, g.radii1);
      detail::set_lane(found.radii2, k, g.radii2);
      found.is_undecided[k] = g.status == ContactStatus::undecided;
      ++found.n_alone;
      found.n_evaluations += g.n_evaluations;
    }
  return found;
}

} // namespace bergamo::dem
