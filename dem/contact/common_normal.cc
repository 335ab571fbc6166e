#include "dem/contact/common_normal.h"

#include "dem/contact/newton_search.h"
#include "dem/contact/pose_lanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace bergamo::dem
{
namespace
{

constexpr int max_evaluations = 250;

template <class Real>
ContactGeometry result_of(const NewtonSearch<Real> &search, const int k)
{
  const Evaluation<Real> &e = search.best;
  const double phi = math::lane(e.phi, k);
  const ContactStatus status = phi < 0.                        ? ContactStatus::separated
                               : math::lane(search.is_open, k) ? ContactStatus::undecided
                                                               : ContactStatus::touching;
  return {status,
          math::lane(e.c, k),
          phi,
          math::lane(e.arm1, k),
          math::lane(e.arm2, k),
          lane(e.radii1, k),
          lane(e.radii2, k),
          search.n_evaluations};
}

/// Directions spread evenly over the sphere (Fibonacci lattice).
template <int n>
std::array<Vec3, n> spread_directions()
{
  std::array<Vec3, n> directions;
  const double golden_angle = std::numbers::pi * (3. - std::sqrt(5.));
  for (int i = 0; i < n; ++i)
  {
    const double z = 1. - (2. * i + 1.) / n;
    const double r = std::sqrt(1. - z * z);
    directions[i] = Vec3(r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z);
  }
  return directions;
}

/// Search from many starts, in packs of directions; the converged minimum with the smallest phi wins.
ContactGeometry search_globally(const BodyPose &body1, const BodyPose &body2, const ContactGeometry &first)
{
  constexpr int n_directions = 256, n_starts = 32;
  static_assert(n_starts % pack_width == 0 && n_directions % pack_width == 0);
  static const auto directions = spread_directions<n_directions>();
  const Pose<Pack> bodies1 = in_every_lane(body1), bodies2 = in_every_lane(body2);
  const auto pack_of = [](const auto &direction)
  {
    return math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return direction(lane); });
  };

  std::array<std::pair<double, int>, n_directions> ranking;
  for (int i = 0; i < n_directions; i += pack_width)
  {
    const Vector3<Pack> c = pack_of([&](const int lane) -> const Vec3 & { return directions[i + lane]; });
    const Pack phi = Evaluation<Pack>(bodies1, bodies2, c).phi;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      const double height = math::lane(phi, lane);
      ranking[i + lane] = {std::isnan(height) ? std::numeric_limits<double>::infinity() : height, i + lane};
    }
  }
  std::partial_sort(ranking.begin(), ranking.begin() + n_starts, ranking.end());

  ContactGeometry best = first;
  best.n_evaluations += n_directions;
  for (int k = 0; k < n_starts && best.status != ContactStatus::separated; k += pack_width)
  {
    const Vector3<Pack> starts =
        pack_of([&](const int lane) -> const Vec3 & { return directions[ranking[k + lane].second]; });
    NewtonSearch<Pack> search(bodies1, bodies2, starts);
    search.run(max_evaluations);
    const int n_evaluations = best.n_evaluations + search.n_evaluations * pack_width;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      const ContactGeometry candidate = result_of(search, lane);
      const bool is_open = candidate.status == ContactStatus::undecided;
      const bool was_open = best.status == ContactStatus::undecided;
      if ((was_open && !is_open) || (candidate.overlap < best.overlap && (!is_open || was_open)))
        best = candidate;
    }
    best.n_evaluations = n_evaluations;
  }
  return best;
}

} // namespace

ContactGeometry find_contact(const BodyPose &body1, const BodyPose &body2)
{
  NewtonSearch<double> search(body1, body2, (body2.position - body1.position).normalized());
  search.run(max_evaluations);
  const ContactGeometry result = result_of(search, 0);
  return result.status == ContactStatus::undecided || is_suspicious(search) ? search_globally(body1, body2, result)
                                                                            : result;
}

ContactGeometry update_contact(const BodyPose &body1, const BodyPose &body2, const Vec3 &guess)
{
  NewtonSearch<double> search(body1, body2, guess);
  search.run(max_evaluations);
  const ContactGeometry result = result_of(search, 0);
  if (result.status == ContactStatus::undecided || is_saddle(search))
    return find_contact(body1, body2);
  return result;
}

} // namespace bergamo::dem
