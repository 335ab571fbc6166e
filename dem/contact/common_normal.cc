#include "dem/contact/common_normal.h"

#include "dem/core/tangent_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace bergamo::dem
{
namespace
{

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

/// phi and its parts at one direction.
struct Evaluation
{
  Vec3 c;
  double phi;
  Vec3 gap; ///< p2 - p1
  GlobalSupport s1, s2;
};

Evaluation evaluate(const BodyPose &body1, const BodyPose &body2, const Vec3 &c)
{
  Evaluation e{c, 0., Vec3::Zero(), support(body1, c), support(body2, -c)};
  const Vec3 centre_line = body2.position - body1.position;
  e.phi = e.s1.height + e.s2.height - c.dot(centre_line);
  e.gap = centre_line + e.s2.arm - e.s1.arm;
  return e;
}

/// The part of p2 - p1 that vanishes at the common normal.
Vec3 tangential_gap(const Evaluation &e)
{
  return e.gap - e.c * e.c.dot(e.gap);
}

ContactGeometry make_result(const Evaluation &e, const ContactStatus status, const int n_evaluations)
{
  return {status, e.c, e.phi, e.s1.arm, e.s2.arm, e.s1.hessian, e.s2.hessian, n_evaluations};
}

double length_scale(const BodyPose &body1, const BodyPose &body2)
{
  const auto smallest = [](const SupportShape<double> &s) { return std::min({s.r1, s.r2, s.r3}); };
  return std::min(smallest(body1.shape), smallest(body2.shape));
}

/// Step of the Newton model of phi on the tangent plane at e.c, shifted until the model is convex: always downhill.
/// H1 + H2 is the tangential Hessian of phi; -phi comes from the curvature of the sphere.
/// @param least curvature that the model is given at least [m]; @param longest step [rad]
Vec3 newton_step(const Evaluation &e, const double least, const double longest)
{
  const TangentFrame frame = tangent_frame(e.c);
  const Vec3 t1 = frame.col(0), t2 = frame.col(1);
  const Mat3 hessian = e.s1.hessian + e.s2.hessian;
  const Vec2 gradient(-t1.dot(e.gap), -t2.dot(e.gap));
  const Vec3 ht1 = hessian * t1, ht2 = hessian * t2;
  double b11 = t1.dot(ht1) - e.phi;
  double b22 = t2.dot(ht2) - e.phi;
  const double b12 = t1.dot(ht2);
  // Shift the smaller eigenvalue where the model is not convex. Beside the huge one of a flat face the difference of
  // mean and radius would cancel to nothing: the determinant keeps it.
  const double mean = 0.5 * (b11 + b22);
  const double radius = std::hypot(0.5 * (b11 - b22), b12);
  const double high = mean + radius;
  const double low = mean > 0. ? b11 / high * b22 - b12 / high * b12 : mean - radius;
  if (low < least)
  {
    const double shift = std::max(least, std::abs(low)) - low;
    b11 += shift;
    b22 += shift;
  }
  const double det = b11 * b22 - b12 * b12;
  Vec2 step((-gradient[0] * b22 + gradient[1] * b12) / det, (-gradient[1] * b11 + gradient[0] * b12) / det);
  const double length = step.norm();
  if (!(length <= longest))
    step *= std::isfinite(length) ? longest / length : 0.;
  return t1 * step[0] + t2 * step[1];
}

constexpr double longest_step = 0.5;     // about 30 degrees: the model says nothing beyond
constexpr double least_curvature = 1e-6; // of the model, over the smallest half-axis

/// A separating direction is known; lower phi towards the true gap, so that the pair can rest longer.
Evaluation widen_gap(const BodyPose &body1, const BodyPose &body2, Evaluation current, int &n_evaluations)
{
  constexpr int max_steps = 3;
  constexpr double good_enough = 0.2; // tangential part over width of the gap
  for (int i = 0; i < max_steps; ++i)
  {
    const Vec3 tangential = tangential_gap(current);
    if (tangential.norm() < good_enough * -current.phi)
      break;
    const Vec3 step = newton_step(current, least_curvature * length_scale(body1, body2), longest_step);
    const Evaluation trial = evaluate(body1, body2, (current.c + step).normalized());
    ++n_evaluations;
    if (!(trial.phi < current.phi))
      break;
    current = trial;
  }
  return current;
}

/// Minimises phi from a start direction: Newton with a backtracking line search that never goes uphill.
/// Ends `separated` at the first direction with phi < 0, `touching` at a converged minimum with phi >= 0.
ContactGeometry minimise(const BodyPose &body1, const BodyPose &body2, const Vec3 &start)
{
  constexpr int max_evaluations = 250;
  constexpr double resolution = 1e-15; // of a unit vector
  constexpr double growth = 1.5;       // of the longest step after a success
  const double scale = length_scale(body1, body2);
  const double tolerance = 1e-10 * scale, least = least_curvature * scale;

  Evaluation current = evaluate(body1, body2, start);
  Vec3 tangential = tangential_gap(current);
  double longest = longest_step;
  Vec3 step = newton_step(current, least, longest);
  for (int n_evaluations = 1;; ++n_evaluations)
  {
    if (current.phi < 0.)
    {
      const Evaluation wide = widen_gap(body1, body2, current, n_evaluations);
      return make_result(wide, ContactStatus::separated, n_evaluations);
    }
    if (tangential.norm() < tolerance)
      return make_result(current, ContactStatus::touching, n_evaluations);
    if (n_evaluations >= max_evaluations)
      return make_result(current, ContactStatus::undecided, n_evaluations);

    // On a flat face p moves a lot for a change of c below resolution: then c is as good as it can be.
    if (step.norm() < resolution)
      return make_result(current, ContactStatus::touching, n_evaluations);

    const Evaluation trial = evaluate(body1, body2, (current.c + step).normalized());
    const Vec3 trial_tangential = tangential_gap(trial);
    // Near the minimum phi is flat to rounding: there the shorter tangential gap decides.
    const double noise = 1e-15 * (current.s1.height + current.s2.height);
    const bool is_downhill = trial.phi < current.phi - noise ||
                             (trial.phi <= current.phi + noise && trial_tangential.norm() < tangential.norm());
    // Where a surface is flat (exponent below one) the full step jumps across the minimum to about the same slope on
    // the other side, again and again: a step counts only if it takes off half of the slope.
    const double slope = -step.dot(tangential), trial_slope = -step.dot(trial_tangential);
    if (is_downhill && trial_slope < -0.5 * slope)
    {
      current = trial;
      tangential = trial_tangential;
      longest = std::min(longest_step, std::max(longest, growth * step.norm()));
      step = newton_step(current, least, longest);
    }
    else
    {
      const double secant = slope / (slope - trial_slope); // least phi between both ends
      step *= std::isfinite(secant) ? std::clamp(secant, 0.05, 0.7) : 0.25;
      // Near the kink of a flat face Newton's step is too long by 1/(q - 1): remember what was found.
      longest = step.norm();
    }
  }
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
    ranking[i] = {evaluate(body1, body2, directions[i]).phi, i};
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

/// Beyond this overlap over the smallest half-axis phi may have several minima.
constexpr double deep_overlap = 0.02;

} // namespace

ContactGeometry find_contact(const BodyPose &body1, const BodyPose &body2)
{
  const Vec3 centre_line = body2.position - body1.position;
  const ContactGeometry result = minimise(body1, body2, centre_line.normalized());
  const bool doubtful =
      result.status == ContactStatus::undecided ||
      (result.status == ContactStatus::touching && result.overlap > deep_overlap * length_scale(body1, body2));
  return doubtful ? search_globally(body1, body2, result) : result;
}

ContactGeometry update_contact(const BodyPose &body1, const BodyPose &body2, const Vec3 &guess)
{
  const ContactGeometry result = minimise(body1, body2, guess);
  if (result.status == ContactStatus::undecided)
    return find_contact(body1, body2);
  return result;
}

} // namespace bergamo::dem
