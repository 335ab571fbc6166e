#include "dem/contact/common_normal.h"

#include "dem/contact/newton_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace bergamo::dem
{
namespace
{

/// @param centre_line x2 - x1 [m]
ContactGeometry finish(NewtonSearch<double> &search, const Vec3 &centre_line)
{
  constexpr int max_evaluations = 250;
  search.run(max_evaluations);
  const Evaluation<double> &e = search.best;
  const ContactStatus status = e.phi < 0.       ? ContactStatus::separated
                               : search.is_open ? ContactStatus::undecided
                                                : ContactStatus::touching;
  return {status, e.c, e.phi, e.arm1, e.arm1 + e.gap - centre_line, e.radii1, e.radii2, search.n_evaluations};
}

ContactGeometry minimise(const BodyPose &body1, const BodyPose &body2, const Vec3 &start)
{
  NewtonSearch<double> search(body1, body2, start);
  return finish(search, body2.position - body1.position);
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

/// Search from many starts; the converged minimum with the smallest phi wins.
ContactGeometry search_globally(const BodyPose &body1, const BodyPose &body2, const ContactGeometry &first)
{
  constexpr int n_directions = 128, n_starts = 8;
  static const auto directions = spread_directions<n_directions>();

  std::array<std::pair<double, int>, n_directions> ranking;
  for (int i = 0; i < n_directions; ++i)
    ranking[i] = {Evaluation<double>(body1, body2, directions[i]).phi, i};
  std::partial_sort(ranking.begin(), ranking.begin() + n_starts, ranking.end());

  ContactGeometry best = first;
  int n_evaluations = first.n_evaluations + n_directions;
  for (int k = 0; k < n_starts; ++k)
  {
    const ContactGeometry candidate = minimise(body1, body2, directions[ranking[k].second]);
    n_evaluations += candidate.n_evaluations;
    const bool first_decision = best.status == ContactStatus::undecided && candidate.status != ContactStatus::undecided;
    const bool lower = candidate.overlap < best.overlap &&
                       (candidate.status != ContactStatus::undecided || best.status == ContactStatus::undecided);
    if (first_decision || lower)
      best = candidate;
    if (best.status == ContactStatus::separated)
      break;
  }
  best.n_evaluations = n_evaluations;
  return best;
}

} // namespace

ContactGeometry find_contact(const BodyPose &body1, const BodyPose &body2)
{
  const Vec3 centre_line = body2.position - body1.position;
  NewtonSearch<double> search(body1, body2, centre_line.normalized());
  const ContactGeometry result = finish(search, body2.position - body1.position);
  return result.status == ContactStatus::undecided || is_suspicious(search) ? search_globally(body1, body2, result)
                                                                            : result;
}

ContactGeometry update_contact(const BodyPose &body1, const BodyPose &body2, const Vec3 &guess)
{
  const ContactGeometry result = minimise(body1, body2, guess);
  if (result.status == ContactStatus::undecided)
    return find_contact(body1, body2);
  return result;
}

} // namespace bergamo::dem
