#pragma once

#include "dem/geometry/contact_geometry.h"

namespace bergamo::dem
{

/// phi and its parts at one direction c, for one pair (double) or a pack of pairs.
template <class Real>
struct Evaluation
{
  Vector3<Real> c;
  Real phi;           ///< [m]
  Vector3<Real> gap;  ///< p2 - p1 [m]
  Vector3<Real> arm1; ///< p1 - x1 [m]
  Vector3<Real> arm2; ///< p2 - x2 [m]
  CurvatureRadii<Real> radii1, radii2;
  Real reach; ///< h1(c) + h2(-c): the magnitude that phi is the rounded difference of [m]

  Evaluation(const Pose<Real> &body1, const Pose<Real> &body2, const Vector3<Real> &c) : c(c)
  {
    const TangentFrameOf<Real> frame = tangent_frame(c);
    const PlacedSupport<Real> s1 = support<Real>(body1, c, frame), s2 = support<Real>(body2, -c, frame);
    const Vector3<Real> centre_line = body2.position - body1.position;
    reach = s1.height + s2.height;
    phi = reach - c.dot(centre_line);
    gap = centre_line + s2.arm - s1.arm;
    arm1 = s1.arm;
    arm2 = s2.arm;
    radii1 = s1.radii;
    radii2 = s2.radii;
  }

  /// The part of p2 - p1 that vanishes at the common normal.
  Vector3<Real> tangential_gap() const { return gap - c * c.dot(gap); }

  void replace_where(const math::Mask<Real> &mask, const Evaluation &other)
  {
    c = math::select<Real>(mask, other.c, c);
    phi = math::select(mask, other.phi, phi);
    gap = math::select<Real>(mask, other.gap, gap);
    arm1 = math::select<Real>(mask, other.arm1, arm1);
    arm2 = math::select<Real>(mask, other.arm2, arm2);
    reach = math::select(mask, other.reach, reach);
    for (auto radii : {&Evaluation::radii1, &Evaluation::radii2})
      for (auto entry : {&CurvatureRadii<Real>::r11, &CurvatureRadii<Real>::r22, &CurvatureRadii<Real>::r12})
        this->*radii.*entry = math::select(mask, other.*radii.*entry, this->*radii.*entry);
  }
};

/// Hessian of phi on the unit sphere: H1 + H2 in the tangent plane; -phi comes from the curvature of the sphere [m].
template <class Real>
struct SphereHessian
{
  Real b11, b22, b12, low; ///< low: the smaller eigenvalue

  explicit SphereHessian(const Evaluation<Real> &e)
  {
    const CurvatureRadii<Real> radii = e.radii1 + e.radii2;
    b11 = radii.r11 - e.phi;
    b22 = radii.r22 - e.phi;
    b12 = radii.r12;
    // Beside the huge eigenvalue of a flat face the difference of mean and radius would cancel to nothing: the
    // determinant keeps the small one.
    const Real half(0.5);
    const Real mean = half * (b11 + b22), difference = half * (b11 - b22);
    const Real scale = math::max(math::max(math::abs(difference), math::abs(b12)), Real(1e-150));
    const Real x = difference / scale, y = b12 / scale;
    const Real radius = scale * math::sqrt(x * x + y * y); // without overflow
    const Real high = mean + radius;
    low = math::select(mean > Real(0.), Real(b11 / high * b22 - b12 / high * b12), Real(mean - radius));
  }
};

/// Minimises phi from a start direction: Newton on the sphere with a line search that never goes uphill. The same
/// source for one pair and for packs, where every lane goes its own way until it is decided.
template <class Real>
class NewtonSearch
{
public:
  using Mask = math::Mask<Real>;

  /// @param body1, body2 must outlive the search; @param start unit vector
  NewtonSearch(const Pose<Real> &body1, const Pose<Real> &body2, const Vector3<Real> &start)
      : NewtonSearch(body1, body2, Evaluation<Real>(body1, body2, start))
  {
  }

  /// @param start evaluated already
  NewtonSearch(const Pose<Real> &body1, const Pose<Real> &body2, const Evaluation<Real> &start)
      : best(start), body1(body1), body2(body2)
  {
    const auto smallest = [](const SupportShape<Real> &s) { return math::min(math::min(s.r1, s.r2), s.r3); };
    length_scale = math::min(smallest(body1.shape), smallest(body2.shape));
    sharpest = math::max(math::max(body1.shape.q1, body1.shape.q2), math::max(body2.shape.q1, body2.shape.q2));
    longest = Real(longest_step);
    tangential = best.tangential_gap();
    inverse = newton_inverse();
    step = model_step();
    decide();
  }

  /// Leaves lanes as they are.
  void close(const Mask &lanes) { is_open = is_open && !lanes; }

  /// Goes on until every lane is decided or the evaluations are used up.
  void run(const int max_evaluations)
  {
    run(max_evaluations, [] {});
  }

  /// @param look called after every evaluation; may close lanes
  template <class Look>
  void run(const int max_evaluations, Look &&look)
  {
    while (math::any(is_open) && n_evaluations < max_evaluations)
    {
      advance();
      look();
    }
  }

  /// The direction to be tried next.
  Vector3<Real> next() const
  {
    const Vector3<Real> target = best.c + step;
    return target / target.norm();
  }

  /// Whether best.c is in a flat region of one of the bodies: a component n of its normal is nearly zero and a dual
  /// exponent q below two. The radius of curvature goes to infinity there, in that one direction, as n^(q - 2); towards
  /// a box, q near one, the face is flat up to an edge that its radii say nothing of.
  Mask is_in_flat_middle() const
  {
    const auto is_in = [&](const Pose<Real> &body)
    {
      const Vector3<Real> n = turn_back(body.rotation, best.c);
      const auto size = [&](const int d) -> Real { return math::max(Real(math::abs(n[d])), Real(1e-100)); };
      const Real in_plane = math::min(size(0), size(1)), least = math::min(in_plane, size(2));
      const Real off_axis = math::max(Real(math::sqrt(n[0] * n[0] + n[1] * n[1])), Real(1e-100));
      const Real flatness = math::max(Real((body.shape.q1 - Real(2.)) * math::log(in_plane)),
                                      Real((body.shape.q2 - Real(2.)) * math::log(math::min(size(2), off_axis))));
      return (least < Real(flat_middle) && math::min(body.shape.q1, body.shape.q2) < Real(2.)) ||
             flatness > Real(flat_radius);
    };
    return is_in(body1) || is_in(body2);
  }

  Evaluation<Real> best; ///< the least phi found
  Real length_scale;     ///< smallest half-axis of both bodies [m]
  Real sharpest;         ///< largest dual exponent q of both bodies
  Real low;              ///< smaller eigenvalue of the model's Hessian at best; negative at a saddle or maximum [m]
  Mask is_open;          ///< not decided yet: the others are either separated (phi < 0) or at a minimum
  int n_evaluations = 1; ///< of the lane that took longest

private:
  static constexpr double longest_step = 0.5;     // about 30 degrees: the model says nothing beyond
  static constexpr double least_curvature = 1e-6; // of the model, over the smallest half-axis
  static constexpr double tolerance = 1e-10;      // of the tangential gap, over the smallest half-axis
  static constexpr double resolution = 1e-15;     // of a unit vector
  static constexpr double growth = 1.5;           // of the longest step after a success
  static constexpr double max_widenings = 3.;
  static constexpr double wide_enough = 0.1;  // what is left to be gained over the gap
  static constexpr double flat_middle = 1e-4; // of a unit normal
  static constexpr double flat_radius = 6.;   // logarithm of the radius over that of a round face

  /// Inverse of the model's Hessian in tangent_frame(best.c): symmetric, positive definite [1/m]. The inverse, because
  /// beside the huge radius of a flat face it keeps the other one; the Hessian itself would lose it in rounding.
  struct Inverse
  {
    Real m11, m22, m12;
  };

  /// Of the Newton model at best, shifted until it is convex: its step is always downhill.
  Inverse newton_inverse()
  {
    using math::abs, math::max, math::select;
    const SphereHessian<Real> b(best);
    low = b.low;
    const Real least = Real(least_curvature) * length_scale;
    const Real shift = select(b.low < least, Real(max(least, abs(b.low)) - b.low), Real(0.));
    const Real b11 = b.b11 + shift, b22 = b.b22 + shift;
    const Real factor = Real(1.) / (b11 * b22 - b.b12 * b.b12);
    return {b22 * factor, b11 * factor, -b.b12 * factor};
  }

  /// The inverse with the change of the gradient, y, over a step s that went too far, learnt (BFGS: Nocedal & Wright
  /// 2006, eq. 6.17). At the kink of a flat face the slope jumps from one side to the other: the model takes the jump's
  /// mean curvature in that direction alone, so that along the kink the search goes on with full steps.
  static Inverse learn(const Inverse &m, const Real &s1, const Real &s2, const Real &y1, const Real &y2)
  {
    const Real rho = Real(1.) / (s1 * y1 + s2 * y2);
    const Real u1 = m.m11 * y1 + m.m12 * y2, u2 = m.m12 * y1 + m.m22 * y2;
    const Real factor = rho * (Real(1.) + rho * (y1 * u1 + y2 * u2));
    return {m.m11 + factor * s1 * s1 - Real(2.) * rho * s1 * u1, m.m22 + factor * s2 * s2 - Real(2.) * rho * s2 * u2,
            m.m12 + factor * s1 * s2 - rho * (s1 * u2 + s2 * u1)};
  }

  /// Step of the model, no longer than `longest`.
  Vector3<Real> model_step() const
  {
    using math::select;
    const TangentFrameOf<Real> frame = tangent_frame(best.c);
    const Vector3<Real> t1 = frame.col(0), t2 = frame.col(1);
    const Real g1 = t1.dot(best.gap), g2 = t2.dot(best.gap); // minus the gradient
    Real s1 = inverse.m11 * g1 + inverse.m12 * g2, s2 = inverse.m12 * g1 + inverse.m22 * g2;
    const Real length = math::sqrt(s1 * s1 + s2 * s2);
    const Real factor = select(length <= longest, Real(1.), Real(longest / length));
    const Mask is_finite = length < Real(1e300);
    s1 = select(is_finite, Real(s1 * factor), Real(0.));
    s2 = select(is_finite, Real(s2 * factor), Real(0.));
    return t1 * s1 + t2 * s2;
  }

  /// Closes lanes: a common normal; or a separating direction, after it was improved where that is cheap, so that the
  /// pair can rest longer.
  void decide()
  {
    const Mask is_apart = best.phi < Real(0.);
    const Real size = tangential.norm();
    // On a flat face p moves a lot for a change of c below resolution: then c is as good as it can be.
    const Mask at_minimum = size < Real(tolerance) * length_scale || step.norm() < Real(resolution);
    // The model's gap is wider by half of the step times the slope.
    const Mask is_wide =
        Real(0.5) * step.dot(tangential) < Real(-wide_enough) * best.phi || widenings >= Real(max_widenings);
    const Mask may_touch = best.phi >= Real(0.); // not what is no number: that stays open
    is_open = !((is_apart && is_wide) || (may_touch && at_minimum));
  }

  void advance()
  {
    using math::max, math::min, math::select;
    const Evaluation<Real> trial(body1, body2, next());
    ++n_evaluations;
    const Vector3<Real> trial_tangential = trial.tangential_gap();
    const Mask was_apart = best.phi < Real(0.);

    // Near the minimum phi is flat to rounding: there the shorter tangential gap decides.
    const Real noise = Real(1e-15) * best.reach;
    const Mask is_downhill =
        trial.phi < best.phi - noise ||
        (trial.phi <= best.phi + noise && trial_tangential.squaredNorm() < tangential.squaredNorm());
    // Where a surface is flat (exponent below one) the full step jumps across the minimum to about the same slope on
    // the other side, again and again: a step counts only if it takes off half of the slope.
    const Real slope = -step.dot(tangential), trial_slope = -step.dot(trial_tangential);
    const Mask is_better = is_open && ((was_apart && trial.phi < best.phi) ||
                                       (!was_apart && is_downhill && trial_slope < Real(-0.5) * slope));
    const Real length = step.norm();
    best.replace_where(is_better, trial);
    widenings = widenings + select(was_apart, select(is_better, Real(1.), Real(max_widenings)), Real(0.));

    // A success may lengthen the next step. A failure shortens this one: where the slope has turned, to where the model
    // with that curvature is least, at most a share of the step; otherwise to a quarter.
    const Mask is_curved = trial_slope > Real(0.5) * slope; // at least half of the slope gone
    const Mask learns = !is_better && is_curved;
    const auto replace = [&](const Mask &mask, const Inverse &other)
    {
      for (auto entry : {&Inverse::m11, &Inverse::m22, &Inverse::m12})
        inverse.*entry = select(mask, other.*entry, inverse.*entry);
    };
    if (math::any(learns))
    {
      const TangentFrameOf<Real> frame = tangent_frame(best.c);
      const Vector3<Real> t1 = frame.col(0), t2 = frame.col(1), change = tangential - trial_tangential;
      replace(learns, learn(inverse, t1.dot(step), t2.dot(step), t1.dot(change), t2.dot(change)));
    }
    if (math::any(is_better))
      replace(is_better, newton_inverse());
    longest = select(is_better, min(Real(longest_step), max(longest, Real(growth) * length)),
                     Real(length * select(is_curved, Real(0.7), Real(0.25))));
    tangential = select<Real>(is_better, trial_tangential, tangential);
    step = model_step();
    // Near a kink Newton's step is too long by 1/(q - 1) once more after the next success: remember what was found.
    longest = select(is_better, longest, math::clamp(Real(step.norm()), Real(length * Real(0.05)), longest));
    decide();
  }

  const Pose<Real> &body1, &body2;
  Vector3<Real> tangential; ///< gap at best
  Vector3<Real> step;       ///< next to be tried
  Inverse inverse;
  Real longest; ///< step allowed [rad]
  Real widenings = Real(0.);
};

/// Whether what was found from the centre line may not be the least minimum:
///  * the overlap is so deep that phi may have several;
///  * or it is not small beside the smaller radius of curvature rho = low + phi of both surfaces together: the ball of
///    radius phi inside the Minkowski sum of the bodies touches its boundary near a ridge, and may cross that on the
///    other side. Away from a ridge rho grows over angles of about 1/q, q = 2/(2 - eps) the dual exponent, so the limit
///    goes with the sharpest one. A saddle (low < 0), where a symmetric pair may end, is among them;
///  * or rho at the minimum says nothing of a ridge nearby. A pointed body (q large) is flat up to the very ridge: at
///    the depth phi inside a ridge of half the angle alpha its rho is (q - 1) phi / sin^2 alpha, and the other body
///    adds its own. In the middle of a flat face rho is infinite, in that one direction, and the search may come to
///    rest beside the minimum: its steps are too short there. Of 1.8 million random pairs that touch, with exponents
///    up to 1.75 and ratios of half-axes up to 20, 23 had a lower minimum although low > 12 q phi: 18 with q > 4.4 and
///    low up to 1e4 q phi, 4 in flat middles, one with q = 3.1 and low = 14 q phi; of the pairs of the fuzz target two
///    on flat faces beside their middles, with low = 27 and 61 q phi.
template <class Real>
math::Mask<Real> is_suspicious(const NewtonSearch<Real> &search)
{
  constexpr double deep_overlap = 0.02; // over the smallest half-axis
  constexpr double near_ridge = 20.;    // low over phi and the sharpest dual exponent
  constexpr double pointed = 4.2;       // dual exponent: that of eps = 1.52
  const Real &phi = search.best.phi;
  return phi > Real(0.) &&
         (phi > Real(deep_overlap) * search.length_scale || search.low < Real(near_ridge) * search.sharpest * phi ||
          search.sharpest > Real(pointed) || search.is_in_flat_middle());
}

/// Whether a touching pair ended at a saddle of phi: only there by symmetry, and not where the contact is.
template <class Real>
math::Mask<Real> is_saddle(const NewtonSearch<Real> &search)
{
  return search.best.phi > Real(0.) && search.low < Real(0.);
}

} // namespace bergamo::dem
