#include "dem/core/tangent_frame.h"
#include "dem/geometry/pair_search.h"
#include "dem/geometry/superquadric.h"
#include "tests/unit/dem_contact_pairs.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;
using namespace contact_pairs;

namespace
{

constexpr double pi = std::numbers::pi;

constexpr double degree = pi / 180.;

struct Series
{
  int n = 0, undecided = 0, wrong = 0, other_minimum = 0, higher_minimum = 0;
  double evaluations = 0., at_once = 0., overlap = 0., points = 0., direction = 0.;
  double worst_overlap = 0.;
};

constexpr int n_pairs = 20000;

/// Gaps uniform in (0, 0.25): a pair must be found separated, with a gap that is no larger than the true distance,
/// which is the made gap: c separates the bodies and the points on both sides of it are that far apart.
Series gap_series(RandomPairs random)
{
  Series s;
  for (; s.n < n_pairs; ++s.n)
  {
    Grain body1{random.shape()}, body2{random.shape(), Vec3::Zero(), random.orientation()};
    const double gap = random.uniform(0., 0.25);
    place(body1, body2, random.direction(), -gap);
    const BodyPose a = body1.pose(), b = body2.pose();
    const ContactGeometry g = find_contact(a, b);
    s.undecided += g.status == ContactStatus::undecided;
    // The direction must prove it: phi(c) = overlap < 0. Rounding: heights below 10.
    s.wrong += g.status == ContactStatus::touching || !(g.overlap < 0.) || -g.overlap > gap + 1e-14 ||
               std::abs(phi(a, b, g.normal) - g.overlap) > 1e-14;
    s.at_once += g.n_evaluations == 1;
    s.evaluations += g.n_evaluations;
    s.overlap += -g.overlap / gap;
  }
  return s;
}

/// Overlaps uniform in (0, 1.75e-3). The made common normal is stationary but need not be the global minimum of phi:
/// a lower phi is right as long as it is proven by its direction, a higher one is another, local minimum.
Series overlap_series(RandomPairs random)
{
  Series s;
  int n_compared = 0;
  for (; s.n < n_pairs; ++s.n)
  {
    Grain body1{random.shape()}, body2{random.shape(), Vec3::Zero(), random.orientation()};
    const double overlap = random.uniform(0., 1.75e-3);
    const Vec3 c = random.direction();
    place(body1, body2, c, overlap);
    const BodyPose a = body1.pose(), b = body2.pose();
    const ContactGeometry g = find_contact(a, b);
    s.undecided += g.status == ContactStatus::undecided;
    s.evaluations += g.n_evaluations;
    const bool is_proven = std::abs(phi(a, b, g.normal) - g.overlap) < 1e-14;
    s.wrong += !is_proven || (g.status == ContactStatus::touching) != (g.overlap > 0.);
    // The search ends at a slope below 1e-10 half-axes, and the minimum is quadratic: 1e-13 is far above its error.
    if (g.overlap > overlap + 1e-13)
      ++s.higher_minimum;
    else if (g.overlap < overlap - 1e-9)
      ++s.other_minimum;
    if (std::abs(g.overlap - overlap) > 1e-9)
      continue;
    ++n_compared;
    const double error = std::abs(g.overlap - overlap) / overlap;
    s.overlap += error;
    s.worst_overlap = std::max(s.worst_overlap, error);
    s.points += (g.arm1 - support(a, c).arm).norm();
    s.direction += 2. * std::asin(std::min(0.5 * (g.normal - c).norm(), 1.)) / degree;
  }
  s.overlap /= n_compared;
  s.points /= n_compared;
  s.direction /= n_compared;
  return s;
}

/// Distance of a point from a surface by sampling and shrinking steps, without support functions.
double distance_to_surface(const Superquadric &body, const Vec3 &point)
{
  const auto distance = [&](const double u, const double v) { return (surface_point(body, u, v) - point).norm(); };
  constexpr int n = 100;
  double best = distance(0., 0.), best_u = 0., best_v = 0.;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      if (const double d = distance(0.5 * pi * i / n, pi * j / n); d < best)
      {
        best = d;
        best_u = 0.5 * pi * i / n;
        best_v = pi * j / n;
      }
  for (double step = pi / n; step > 1e-11; step *= 0.7)
    for (bool better = true; better;)
    {
      better = false;
      for (int k = 0; k < 8; ++k)
      {
        const double u = std::clamp(best_u + step * std::cos(0.25 * pi * k), -0.5 * pi, 0.5 * pi);
        const double v = best_v + step * std::sin(0.25 * pi * k);
        if (const double d = distance(u, v); d < best)
        {
          best = d;
          best_u = u;
          best_v = v;
          better = true;
        }
      }
    }
  return best;
}

} // namespace

TEST_CASE("random pairs made backwards are all decided, and rightly")
{
  // Bounds: a tenth of the mean errors of Wellmann, table 3.1 (overlap 2.34, 2.40, 32.1 e-6; points 4.34, 4.40, 37.2
  // e-8; direction 4.21, 5.05, 18.2 e-3 degrees).
  struct Class
  {
    double low, high, overlap, points, direction;
  };
  const Class classes[3] = {
      {1., 1., 2.3e-7, 4.3e-9, 4.2e-4}, {0.7, 1.3, 2.4e-7, 4.4e-9, 5e-4}, {0.3, 1.7, 3.2e-6, 3.7e-8, 1.8e-3}};
  std::printf("class  series    pairs undecided wrong evaluations  at once  lower higher  |delta|/delta   worst     "
              "points   degrees\n");
  for (int k = 0; k < 3; ++k)
  {
    const Series gaps = gap_series({k + 1, classes[k].low, classes[k].high});
    std::printf("%5d  gaps     %6d %9d %5d %11.2f %7.1f%%            gap found/made %.3f\n", k + 1, gaps.n,
                gaps.undecided, gaps.wrong, gaps.evaluations / gaps.n, 100. * gaps.at_once / gaps.n,
                gaps.overlap / gaps.n);
    CHECK(gaps.undecided == 0);
    CHECK(gaps.wrong == 0);

    const Series overlaps = overlap_series({k + 11, classes[k].low, classes[k].high});
    std::printf("%5d  overlaps %6d %9d %5d %11.2f           %6d %6d  %12.2e %9.1e %9.1e %9.1e\n", k + 1, overlaps.n,
                overlaps.undecided, overlaps.wrong, overlaps.evaluations / overlaps.n, overlaps.other_minimum,
                overlaps.higher_minimum, overlaps.overlap, overlaps.worst_overlap, overlaps.points, overlaps.direction);
    CHECK(overlaps.undecided == 0);
    CHECK(overlaps.wrong == 0);
    CHECK(overlaps.higher_minimum == 0);
    CHECK(overlaps.overlap < classes[k].overlap);
    CHECK(overlaps.points < classes[k].points);
    CHECK(overlaps.direction < classes[k].direction);
    // Ellipsoids: the overlap is 1e-3 of the smallest radius of curvature's scale, no second minimum is that near.
    if (k == 0)
      CHECK(overlaps.other_minimum == 0);
  }
}

TEST_CASE("two spheres in closed form")
{
  // delta = r1 + r2 - |x2 - x1| along the line of centres; a gap is known exactly at the first direction tried.
  RandomPairs random(3, 1., 1.);
  for (int i = 0; i < 1000; ++i)
  {
    const double r1 = random.uniform(0.5, 3.), r2 = random.uniform(0.5, 3.), overlap = random.uniform(-0.2, 0.2);
    const Vec3 n = random.direction(), x1 = random.direction();
    const Grain body1{{Vec3::Constant(r1), 1., 1.}, x1, random.orientation()};
    const Grain body2{{Vec3::Constant(r2), 1., 1.}, x1 + (r1 + r2 - overlap) * n, random.orientation()};
    const ContactGeometry g = find_contact(body1.pose(), body2.pose());
    CHECK(g.status == (overlap > 0. ? ContactStatus::touching : ContactStatus::separated));
    CHECK(std::abs(g.overlap - overlap) < 1e-14);
    CHECK((g.normal - n).norm() < 1e-14);
    CHECK((g.arm1 - r1 * n).norm() < 1e-13);
    CHECK((g.arm2 + r2 * n).norm() < 1e-13);
    CHECK(std::abs(g.radii1.r11 - r1) < 1e-12);
    CHECK(std::abs(g.radii1.r22 - r1) < 1e-12);
    CHECK(std::abs(g.radii1.r12) < 1e-12);
    if (overlap < 0.01 * std::min(r1, r2)) // deeper ones are searched globally, to be sure
      CHECK(g.n_evaluations <= 2);
  }
}

TEST_CASE("a contact's points, overlap and normal agree with one another")
{
  // At the solution p1 - p2 = delta c; the tangential part ends below 1e-10 of the smallest half-axis (0.5) or where
  // the normal cannot be resolved further, so that p is uncertain by 1e-15 times a radius of curvature.
  RandomPairs random(5, 0.3, 1.7);
  for (int i = 0; i < 2000; ++i)
  {
    Grain body1{random.shape(), random.direction(), random.orientation()},
        body2{random.shape(), Vec3::Zero(), random.orientation()};
    place(body1, body2, random.direction(), random.uniform(0., 1e-2));
    const ContactGeometry g = find_contact(body1.pose(), body2.pose());
    if (g.status != ContactStatus::touching)
      continue;
    const Vec3 gap = body1.position + g.arm1 - body2.position - g.arm2;
    const double radius = std::max(g.radii1.norm(), g.radii2.norm());
    CHECK(std::abs(g.normal.norm() - 1.) < 1e-15);
    CHECK((gap - g.overlap * g.normal).norm() < 1e-10 * 3. + 1e-14 * radius);
    // The functions of packs differ from these by rounding, magnified by the exponents.
    CHECK((g.arm1 - support(body1.pose(), g.normal).arm).norm() < 1e-13);
    const auto radii2 = support<double>(body2.pose(), -g.normal, tangent_frame(g.normal)).radii;
    const double bound = 1e-12 * (1. + radii2.norm());
    CHECK(std::abs(g.radii2.r11 - radii2.r11) < bound);
    CHECK(std::abs(g.radii2.r22 - radii2.r22) < bound);
    CHECK(std::abs(g.radii2.r12 - radii2.r12) < bound);
  }
}

TEST_CASE("a contact does not depend on the frame")
{
  // Turning and shifting both bodies turns the result: coordinates of up to 10 carry rounding 1e-15, the minimum of phi
  // is flat, so the overlap agrees to 1e-14; normals and points to the solver's tolerance of 1e-10 half-axes, points
  // on flat spots times the radius of curvature.
  for (const auto &[low, high] : {std::pair(1., 1.), std::pair(0.7, 1.3), std::pair(0.3, 1.7)})
  {
    RandomPairs random(7, low, high);
    for (int i = 0; i < 1000; ++i)
    {
      Grain body1{random.shape(), Vec3::Zero(), random.orientation()},
          body2{random.shape(), Vec3::Zero(), random.orientation()};
      place(body1, body2, random.direction(), random.uniform(-1e-2, 1.75e-3));
      const ContactGeometry g = find_contact(body1.pose(), body2.pose());
      const Quaternion turn = random.orientation();
      const Vec3 shift = 3. * random.direction();
      const auto moved = [&](const Grain &body) {
        return Grain{body.shape, turn * body.position + shift, turn * body.orientation};
      };
      const ContactGeometry m = find_contact(moved(body1).pose(), moved(body2).pose());
      CHECK(m.status == g.status);
      if (g.status != ContactStatus::touching || m.status != ContactStatus::touching)
        continue;
      CHECK(std::abs(m.overlap - g.overlap) < 3e-14);
      const double radius = std::max(g.radii1.norm(), g.radii2.norm());
      CHECK((m.arm1 - turn * g.arm1).norm() < 1e-9 + 1e-14 * radius);
    }
  }
}

TEST_CASE("exchanging the bodies turns the normal")
{
  RandomPairs random(9, 0.3, 1.7);
  for (int i = 0; i < 2000; ++i)
  {
    Grain body1{random.shape(), Vec3::Zero(), random.orientation()},
        body2{random.shape(), Vec3::Zero(), random.orientation()};
    place(body1, body2, random.direction(), random.uniform(-1e-2, 1.75e-3));
    const ContactGeometry g = find_contact(body1.pose(), body2.pose()), e = find_contact(body2.pose(), body1.pose());
    CHECK(e.status == g.status);
    // phi is the same function of the opposite direction: equal up to the order of summation.
    CHECK(std::abs(e.overlap - g.overlap) < 1e-14);
    if (g.status != ContactStatus::touching)
      continue;
    const double radius = std::max(g.radii1.norm(), g.radii2.norm());
    CHECK((e.arm1 - g.arm2).norm() < 1e-9 + 1e-14 * radius);
    CHECK((e.arm2 - g.arm1).norm() < 1e-9 + 1e-14 * radius);
  }
}

TEST_CASE("equal aligned bodies: the overlap is twice the depth of the midpoint")
{
  // For equal, equally turned bodies phi(c) = 2 (h(c) - c.d/2), d the line of centres: its least value is twice the
  // distance of d/2 from the surface. The reference uses surface points only; it comes within 1e-10 from above.
  RandomPairs random(13, 0.3, 1.7);
  for (int i = 0; i < 60; ++i)
  {
    Grain body1{random.shape()}, body2{body1.shape};
    place(body1, body2, random.direction(), random.uniform(1e-4, 1e-2));
    const ContactGeometry g = find_contact(body1.pose(), body2.pose());
    const double depth = distance_to_surface(body1.shape, 0.5 * body2.position);
    CAPTURE(body1.shape.half_axes.transpose(), body1.shape.eps1, body1.shape.eps2, body2.position.transpose());
    REQUIRE(g.status == ContactStatus::touching);
    CHECK(g.overlap <= 2. * depth * (1. + 1e-9) + 1e-13);
    CHECK(g.overlap >= 2. * depth * (1. - 1e-5)); // the walk over the surface may stop short in a narrow valley
  }
}

TEST_CASE("aligned faces of box-like grains")
{
  // A square stack: by symmetry c is the axis and delta = 2 r - distance, to rounding of coordinates below 4.
  for (const double eps : {0.05, 0.1, 0.3, 0.6})
    for (const double overlap : {1e-2, 1e-4, 1e-6, -1e-4})
      for (int axis = 0; axis < 3; ++axis)
      {
        const Superquadric box{{0.5, 1.9, 1.2}, eps, eps};
        const Vec3 n = Vec3::Unit(axis);
        const Grain lower{box}, upper{box, (2. * box.half_axes[axis] - overlap) * n};
        const ContactGeometry g = find_contact(lower.pose(), upper.pose());
        CAPTURE(eps, overlap, axis);
        CHECK(g.status == (overlap > 0. ? ContactStatus::touching : ContactStatus::separated));
        CHECK(std::abs(g.overlap - overlap) < 1e-14);
        CHECK((g.normal - n).norm() < 1e-14);
        CHECK(std::isfinite(g.radii1.norm()));
      }
  // Shifted sideways by up to half a face the midpoint lies d/2 off the axis, where the face has fallen from r3 by
  // r3 (1 - (1 - s)^(eps/2)), s = (|d1/2 r1|^(2/eps) + |d2/2 r2|^(2/eps)): the height along the axis bounds the depth
  // from above, its product with cos(slope) from below. At eps = 0.1 and a quarter of the face s < 2 * 4^-20: nothing
  // to see, delta = 2 r3 - distance.
  const Superquadric box{{1., 1.5, 0.8}, 0.1, 0.1};
  for (const auto &[sx, sy] : {std::pair(0.25, 0.), std::pair(0., 0.25), std::pair(0.25, 0.25), std::pair(-0.1, 0.2)})
  {
    const double overlap = 1e-3;
    const Grain lower{box}, upper{box, Vec3(2. * sx * box.half_axes[0], 2. * sy * box.half_axes[1], 1.6 - overlap)};
    const ContactGeometry g = find_contact(lower.pose(), upper.pose());
    CAPTURE(sx, sy);
    CHECK(g.status == ContactStatus::touching);
    CHECK(std::abs(g.overlap - overlap) < 1e-11);
    CHECK((g.normal - Vec3::UnitZ()).norm() < 1e-9);
  }
}

TEST_CASE("box-like grains face to face, shifted and turned in space, are decided")
{
  // The direction across the faces gives phi = 1e-3, so the overlap found is no larger (rounding 1e-14, solver 5e-12).
  // Near it phi has a kink, where Newton's step is too long by 1/(q - 1) = 2/eps - 1: 39 for an exponent of 0.05. In
  // the middle of the flat faces about a hundred evaluations more prove that no other direction has less.
  for (const double eps : {0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8})
    for (const bool is_turned : {false, true})
    {
      RandomPairs random(41, eps, eps);
      int n_undecided = 0, n_wrong = 0;
      double n_evaluations = 0.;
      constexpr int n = 300;
      for (int i = 0; i < n; ++i)
      {
        const Superquadric box{{1., 1.5, 0.8}, eps, eps};
        const double overlap = 1e-3;
        const Quaternion turn = random.orientation();
        const Quaternion spin(Eigen::AngleAxisd(is_turned ? random.uniform(-pi, pi) : 0., Vec3::UnitZ()));
        const Vec3 shift(random.uniform(-0.8, 0.8), random.uniform(-1.2, 1.2), 1.6 - overlap);
        const ContactGeometry g =
            find_contact(Grain{box, Vec3::Zero(), turn}.pose(), Grain{box, turn * shift, turn * spin}.pose());
        n_undecided += g.status == ContactStatus::undecided;
        n_wrong += g.overlap > overlap + 5e-12;
        n_evaluations += g.n_evaluations;
      }
      CAPTURE(eps, is_turned);
      CHECK(n_undecided == 0);
      CHECK(n_wrong == 0);
      CHECK(n_evaluations < 200. * n);
    }
}

TEST_CASE("coaxial stacks, turned about their axis and in space")
{
  // Bodies of revolution or not: on a common axis of symmetry through both poles c is that axis.
  RandomPairs random(15, 0.3, 1.7);
  for (int i = 0; i < 300; ++i)
  {
    const Superquadric shape1 = random.shape(), shape2 = random.shape();
    const Quaternion turn = random.orientation();
    const Vec3 n = turn * Vec3::UnitZ();
    const double overlap = random.uniform(1e-6, 1e-3);
    const Quaternion spin(Eigen::AngleAxisd(random.uniform(0., 2. * pi), Vec3::UnitZ()));
    const Grain body1{shape1, Vec3::Zero(), turn};
    const Grain body2{shape2, (shape1.half_axes[2] + shape2.half_axes[2] - overlap) * n, turn * spin};
    const ContactGeometry g = find_contact(body1.pose(), body2.pose());
    CAPTURE(shape1.eps1, shape1.eps2, shape2.eps1, shape2.eps2);
    // The axis is stationary; between pointed ends (exponents above one) it is a maximum in some plane or one of
    // several minima, so the overlap can only be lower.
    CHECK(g.status != ContactStatus::undecided);
    CHECK(g.overlap <= overlap + 1e-14);
    if (shape1.eps1 <= 1. && shape1.eps2 <= 1. && shape2.eps1 <= 1. && shape2.eps2 <= 1.)
    {
      CHECK(g.status == ContactStatus::touching);
      CHECK(std::abs(g.overlap - overlap) < 1e-13);
    }
  }
}

TEST_CASE("grains of ten times the size")
{
  // As the random series, with body 2 ten times smaller: errors relative to the small grain's axes, so ten times the
  // bounds' absolute size is never reached; no pair undecided or wrong.
  for (const auto &[low, high] : {std::pair(1., 1.), std::pair(0.7, 1.3), std::pair(0.3, 1.7)})
  {
    RandomPairs random(21, low, high);
    int n_undecided = 0, n_wrong = 0, n_lower = 0;
    double error = 0.;
    constexpr int n = 3000;
    for (int i = 0; i < n; ++i)
    {
      Grain body1{random.shape()}, body2{random.shape(), Vec3::Zero(), random.orientation()};
      body2.shape.half_axes *= 0.1;
      const double overlap = random.uniform(-2.5e-2, 1.75e-4);
      place(body1, body2, random.direction(), overlap);
      const ContactGeometry g =
          i % 2 ? find_contact(body1.pose(), body2.pose()) : find_contact(body2.pose(), body1.pose());
      n_undecided += g.status == ContactStatus::undecided;
      n_wrong += g.overlap > overlap + 1e-14 && overlap > 0.;
      n_wrong += g.status == ContactStatus::touching && overlap < 0.;
      if (overlap > 0. && g.overlap < overlap - 1e-10)
        ++n_lower;
      else if (overlap > 0.)
        error = std::max(error, std::abs(g.overlap - overlap));
    }
    CHECK(n_undecided == 0);
    CHECK(n_wrong == 0);
    CHECK(error < 1e-10);
    if (low == 1.)
      CHECK(n_lower == 0);
  }
}

TEST_CASE("the gap of a separated pair is a lower bound of the distance")
{
  // Points sampled on both surfaces are never nearer than the gap, and the gap is the made distance at most.
  RandomPairs random(23, 0.3, 1.7);
  std::vector<Vec3> points1, points2;
  for (int i = 0; i < 40; ++i)
  {
    Grain body1{random.shape(), random.direction(), random.orientation()},
        body2{random.shape(), Vec3::Zero(), random.orientation()};
    const double gap = random.uniform(0., 0.05);
    place(body1, body2, random.direction(), -gap);
    const ContactGeometry g = find_contact(body1.pose(), body2.pose());
    REQUIRE(g.status == ContactStatus::separated);
    CHECK(-g.overlap <= gap + 1e-14);
    const auto sample = [&](const Grain &body, std::vector<Vec3> &points)
    {
      points.clear();
      for (int j = -30; j <= 30; ++j)
        for (int k = -30; k < 30; ++k)
          points.push_back(body.position +
                           body.orientation * surface_point(body.shape, 0.5 * pi * j / 30, pi * k / 30));
    };
    sample(body1, points1);
    sample(body2, points2);
    double nearest = 1e300;
    for (const Vec3 &p : points1)
      for (const Vec3 &q : points2)
        nearest = std::min(nearest, (p - q).squaredNorm());
    CHECK(std::sqrt(nearest) >= -g.overlap);
    // Along its normal the two bodies lie on either side of a slab as wide as the gap.
    double front = -1e300, back = 1e300;
    for (const Vec3 &p : points1)
      front = std::max(front, g.normal.dot(p));
    for (const Vec3 &p : points2)
      back = std::min(back, g.normal.dot(p));
    CHECK(back - front >= -g.overlap - 1e-13);
  }
}

namespace
{

/// The least phi, from heights alone: a dense set of directions and a pattern search from the best of them.
double least_phi(const BodyPose &a, const BodyPose &b)
{
  constexpr int n = 3000, n_starts = 12;
  static const std::vector<Vec3> directions = []
  {
    std::vector<Vec3> d(n);
    for (int i = 0; i < n; ++i)
    {
      const double z = 1. - (2. * i + 1.) / n, r = std::sqrt(1. - z * z), angle = pi * (3. - std::sqrt(5.)) * i;
      d[i] = Vec3(r * std::cos(angle), r * std::sin(angle), z);
    }
    return d;
  }();
  std::vector<std::pair<double, int>> ranking(n);
  for (int i = 0; i < n; ++i)
    ranking[i] = {phi(a, b, directions[i]), i};
  std::partial_sort(ranking.begin(), ranking.begin() + n_starts, ranking.end());
  double least = ranking[0].first;
  for (int k = 0; k < n_starts; ++k)
  {
    double best = ranking[k].first;
    Vec3 c = directions[ranking[k].second];
    for (double step = 0.05; step > 1e-12; step *= 0.5)
      for (int tries = 0; tries < 20; ++tries)
      {
        const auto frame = tangent_frame(c);
        bool is_better = false;
        for (int j = 0; j < 8 && !is_better; ++j)
        {
          const double angle = 0.25 * pi * j;
          const Vec3 trial =
              (c + step * (std::cos(angle) * frame.col(0) + std::sin(angle) * frame.col(1))).normalized();
          if (const double value = phi(a, b, trial); value < best)
          {
            best = value;
            c = trial;
            is_better = true;
          }
        }
        if (!is_better)
          break;
      }
    least = std::min(least, best);
  }
  return least;
}

} // namespace

TEST_CASE("the overlap is the least phi of a dense search, for any shape, pose and depth")
{
  // The search may not end above the reference by more than its own tolerance, slopes of 1e-10 half-axes over the
  // kinks' angles; and what it found is phi of its direction (rounding). The reference only bounds the least phi from
  // above, so that nothing is assumed of it below.
  enum Placing
  {
    any,
    faces,
    edges,
    coaxial
  };
  for (const Placing placing : {any, faces, edges, coaxial})
  {
    RandomPairs random(51 + placing, 0.05, 1.95);
    int n_undecided = 0, n_wrong = 0, n_touching = 0;
    for (int i = 0; i < 150; ++i)
    {
      const auto shape = [&](const double size)
      {
        Superquadric s = random.shape();
        for (double &r : s.half_axes)
          r = size * std::pow(10., -random.uniform(0., 1.)); // axis ratios up to 10
        return s;
      };
      Grain body1{shape(1.)}, body2{shape(std::pow(10., -random.uniform(0., 1.)))};
      const double smallest = std::min(body1.shape.half_axes.minCoeff(), body2.shape.half_axes.minCoeff());
      const double overlap = 0.1 * smallest * (random.uniform(0., 1.) < 0.2 ? -10. : 1.) * random.uniform(0., 1.);
      Vec3 c = random.direction();
      if (placing == any)
        body2.orientation = random.orientation();
      else if (placing == edges)
      {
        c[i % 3] = 0.;
        c.normalize();
      }
      else
        c = Vec3::Unit(i % 3);
      if (placing == coaxial)
        body2.orientation = Quaternion(Eigen::AngleAxisd(random.uniform(-pi, pi), c));
      place(body1, body2, c, overlap);
      if (placing == faces) // sideways
        body2.position += 0.5 * smallest * Vec3::Unit((i + 1) % 3) * random.uniform(-1., 1.);
      const BodyPose a = body1.pose(), b = body2.pose();
      const ContactGeometry g = find_contact(a, b);
      n_undecided += g.status == ContactStatus::undecided;
      n_touching += g.status == ContactStatus::touching;
      const double reference = least_phi(a, b), tolerance = 1e-9 * smallest;
      const bool is_proven = std::abs(phi(a, b, g.normal) - g.overlap) < 1e-14 * (1. + b.position.norm());
      const bool is_right = g.status == ContactStatus::touching ? g.overlap <= reference + tolerance : g.overlap < 0.;
      n_wrong += !is_proven || !is_right;
    }
    CAPTURE(placing);
    CHECK(n_undecided == 0);
    CHECK(n_wrong == 0);
    CHECK(n_touching > 80);
  }
}

TEST_CASE("a pair in the middle of a flat face and beyond its edge is decided in a plane of symmetry")
{
  // Both bodies lie in one plane of symmetry, where a component of the normal is exactly zero and one radius infinite:
  // it must not drown the other one. The reference knows no Hessian.
  RandomPairs random(61, 0.02, 0.4);
  for (int i = 0; i < 100; ++i)
  {
    Grain body1{random.shape()}, body2{random.shape()};
    body2.orientation = Quaternion(Eigen::AngleAxisd(random.uniform(-pi, pi), Vec3::UnitZ()));
    const Vec3 c = Vec3(std::cos(0.37 * i), std::sin(0.37 * i), 0.);
    place(body1, body2, c, random.uniform(0., 1e-2));
    const BodyPose a = body1.pose(), b = body2.pose();
    const ContactGeometry g = find_contact(a, b);
    CHECK(g.status != ContactStatus::undecided);
    CHECK(g.overlap <= least_phi(a, b) + 1e-9);
  }
}

TEST_CASE("a pack of pairs gives what each pair alone gives")
{
  // Other functions of the vector library, rounding of 1 ulp: overlaps agree to 1e-14; points to the solver's
  // tolerance.
  RandomPairs random(71, 0.2, 1.8);
  for (int i = 0; i < 300; ++i)
  {
    std::vector<std::pair<BodyPose, BodyPose>> pairs;
    for (int k = 0; k < pack_width; ++k)
    {
      Grain body1{random.shape(), Vec3::Zero(), random.orientation()},
          body2{random.shape(), Vec3::Zero(), random.orientation()};
      place(body1, body2, random.direction(), random.uniform(-1e-3, 1.75e-3));
      pairs.emplace_back(body1.pose(), body2.pose());
    }
    const auto gather = [&](auto member)
    {
      Pose<Pack> packed = in_every_lane(pairs[0].*member);
      const auto load = [&](auto &&number) -> Pack
      { return math::generate<Pack>([&](const int k) -> double { return number(pairs[k].*member); }); };
      packed.shape.r1 = load([](const BodyPose &p) { return p.shape.r1; });
      packed.shape.r2 = load([](const BodyPose &p) { return p.shape.r2; });
      packed.shape.r3 = load([](const BodyPose &p) { return p.shape.r3; });
      packed.shape.q1 = load([](const BodyPose &p) { return p.shape.q1; });
      packed.shape.q2 = load([](const BodyPose &p) { return p.shape.q2; });
      packed.shape.q2_over_q1 = load([](const BodyPose &p) { return p.shape.q2_over_q1; });
      packed.shape.one_over_q2 = load([](const BodyPose &p) { return p.shape.one_over_q2; });
      for (int d = 0; d < 3; ++d)
      {
        packed.position[d] = load([d](const BodyPose &p) { return p.position[d]; });
        for (int j = 0; j < 3; ++j)
          packed.rotation(d, j) = load([d, j](const BodyPose &p) { return p.rotation(d, j); });
      }
      return packed;
    };
    const Vector3<Pack> no_guess(Pack(0.), Pack(0.), Pack(0.));
    const FoundContacts<Pack> found =
        search_pairs<Pack>(gather(&std::pair<BodyPose, BodyPose>::first),
                           gather(&std::pair<BodyPose, BodyPose>::second), no_guess, pack_width);
    for (int k = 0; k < pack_width; ++k)
    {
      const ContactGeometry g = find_contact(pairs[k].first, pairs[k].second);
      CHECK(!found.is_undecided[k]);
      CHECK((math::lane(found.overlap, k) > 0.) == (g.overlap > 0.));
      if (g.status != ContactStatus::touching)
        continue;
      CHECK(std::abs(math::lane(found.overlap, k) - g.overlap) < 1e-13);
      const double radius = std::max(g.radii1.norm(), g.radii2.norm());
      CHECK((math::lane<Pack>(found.arm1, k) - g.arm1).norm() < 1e-9 + 1e-14 * radius);
      CHECK((math::lane<Pack>(found.arm2, k) - g.arm2).norm() < 1e-9 + 1e-14 * radius);
    }
  }
}
