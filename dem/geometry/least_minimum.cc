#include "dem/geometry/least_minimum.h"

#include "dem/geometry/newton_search.h"
#include "dem/geometry/pose_lanes.h"
#include "dem/geometry/search_result.h"

#include <algorithm>
#include <array>
#include <vector>

namespace bergamo::dem
{
namespace
{

/// phi is the support function of a convex body, the difference of both grains seen from their distance: the largest
/// p.c over its points p. Every evaluation gives one of these points, p1 - p2 at c, so p.c is a lower bound of phi in
/// all directions. The sphere is split into triangles; one whose bound reaches the best minimum known is done, the one
/// with the least bound is split next, at the middle of its longest side.
class LeastMinimum
{
public:
  LeastMinimum(const BodyPose &body1, const BodyPose &body2, const ContactGeometry &first)
      : body1(body1), body2(body2), packed1(in_every_lane(body1)), packed2(in_every_lane(body2)), best(first)
  {
    const auto smallest = [](const SupportShape<double> &s) { return std::min({s.r1, s.r2, s.r3}); };
    margin = tolerance * std::min(smallest(body1.shape), smallest(body2.shape));
    corners.reserve(512);
    open.reserve(512);
  }

  ContactGeometry find()
  {
    begin_with_octahedron();
    while (best.status != ContactStatus::separated && !open.empty() && best.n_evaluations < max_evaluations)
      split_some();
    const bool is_proven = open.empty() && best.overlap >= 0.; // not of a state that is no number
    if (best.status == ContactStatus::undecided && is_proven)
      best.status = ContactStatus::touching;
    if (best.status == ContactStatus::undecided)
      go_down_from_lowest();
    return best;
  }

private:
  static constexpr double tolerance = 3e-10;   // of the minimum, over the smallest half-axis
  static constexpr double least_share = 0.1;   // of a side cut off
  static constexpr int max_evaluations = 3000; // a pair with a valley all round may need more
  static constexpr int max_newton = 250;
  static constexpr int n_last_starts = 32; // where neither Newton's method nor the proof came to an end

  struct Corner
  {
    Vec3 c, p;
  };
  struct Triangle
  {
    std::array<int, 3> corners;
    double bound; ///< of phi in the triangle [m]

    bool operator<(const Triangle &o) const { return bound > o.bound; } // the heap's top is the least
  };

  struct Split
  {
    int a, b, opposite, middle;
  };
  struct SplitSide
  {
    int a = -1, b = -1, middle = -1; ///< a < b
  };

  double limit() const { return best.overlap - margin; }

  /// Its first axis is the normal found so far: triangles must be small around it, so corners should be there.
  void begin_with_octahedron()
  {
    const TangentFrame frame = tangent_frame(best.normal);
    std::array<Vec3, 6> directions;
    for (int i = 0; i < 3; ++i)
    {
      const Vec3 axis = i == 0 ? best.normal : Vec3(frame.col(i - 1));
      directions[2 * i] = axis;
      directions[2 * i + 1] = -axis;
    }
    evaluate(directions.data(), 6);
    for (const int i : {0, 1})
      for (const int j : {2, 3})
        for (const int k : {4, 5})
          add({i, j, k});
  }

  /// Splits triangles until a pack is full of new corners.
  void split_some()
  {
    splits.clear();
    std::array<Vec3, pack_width> directions;
    int n = 0;
    while (n < pack_width && !open.empty())
    {
      std::pop_heap(open.begin(), open.end());
      const Triangle triangle = open.back();
      open.pop_back();
      if (!(triangle.bound < limit())) // a lower minimum was found since; so for all others
      {
        open.clear();
        break;
      }
      const auto [a, b, opposite] = most_bent_side_first(triangle.corners);
      SplitSide &side = split_side(a, b);
      if (side.a != std::min(a, b) || side.b != std::max(a, b))
      {
        side = {std::min(a, b), std::max(a, b), static_cast<int>(corners.size()) + n};
        directions[n++] = split_of(a, b);
      }
      splits.push_back({a, b, opposite, side.middle});
    }
    if (n > 0)
      evaluate(directions.data(), n);
    for (const auto &[a, b, opposite, middle] : splits)
    {
      add({a, middle, opposite});
      add({middle, b, opposite});
    }
  }

  /// Where the middle of a side is kept; another side's may be there.
  SplitSide &split_side(const int a, const int b)
  {
    const unsigned key = static_cast<unsigned>(std::min(a, b)) * 31U + static_cast<unsigned>(std::max(a, b));
    return split_sides[key % split_sides.size()];
  }

  /// (p_b - p_a).(c_b - c_a) >= 0: how much phi bends along a side. The bound of a triangle is below its least corner
  /// by no more than the largest of its sides.
  double bend(const int a, const int b) const { return (corners[b].p - corners[a].p).dot(corners[b].c - corners[a].c); }

  std::array<int, 3> most_bent_side_first(const std::array<int, 3> &t) const
  {
    const auto side = [&](const int i) { return bend(t[i], t[(i + 1) % 3]); };
    const int i = side(0) >= side(1) ? (side(0) >= side(2) ? 0 : 2) : (side(1) >= side(2) ? 1 : 2);
    return {t[i], t[(i + 1) % 3], t[(i + 2) % 3]};
  }

  /// Where the bounds by the points of both ends meet: in the middle of an evenly curved side, at the kink of a kinked.
  Vec3 split_of(const int a, const int b) const
  {
    const double share = (corners[a].p - corners[b].p).dot(corners[a].c) / bend(a, b);
    const double t = share > least_share ? std::min(share, 1. - least_share) : least_share;
    return (corners[a].c + t * (corners[b].c - corners[a].c)).normalized();
  }

  /// Appends corners; where one is lower than the best minimum, Newton's method goes down from there.
  void evaluate(const Vec3 *directions, const int n)
  {
    for (int begin = 0; begin < n; begin += pack_width)
    {
      const auto direction = [&](const int lane) -> const Vec3 & { return directions[std::min(begin + lane, n - 1)]; };
      const Vector3<Pack> c = math::gather_vectors<Pack>(direction);
      const Vector3<Pack> gap = Evaluation<Pack>(packed1, packed2, c).gap;
      for (int lane = 0; lane < std::min(pack_width, n - begin); ++lane)
        corners.push_back({directions[begin + lane], -math::lane<Pack>(gap, lane)});
    }
    best.n_evaluations += n;
    const auto is_lower = [](const Corner &a, const Corner &b) { return a.p.dot(a.c) < b.p.dot(b.c); };
    const Corner &lowest = *std::min_element(corners.end() - n, corners.end(), is_lower);
    if (lowest.p.dot(lowest.c) < limit())
      go_down(lowest.c);
  }

  void go_down(const Vec3 &start)
  {
    NewtonSearch<double> search(body1, body2, start);
    search.run(max_newton);
    const int n_evaluations = best.n_evaluations + search.n_evaluations;
    const ContactGeometry candidate = result_of(search, 0);
    const bool is_first_end = best.status == ContactStatus::undecided && candidate.status != ContactStatus::undecided;
    if (candidate.overlap < best.overlap || (is_first_end && candidate.overlap < best.overlap + margin))
      best = candidate;
    best.n_evaluations = n_evaluations;
  }

  void go_down_from_lowest()
  {
    const auto is_lower = [](const Corner &a, const Corner &b) { return a.p.dot(a.c) < b.p.dot(b.c); };
    const int n = std::min<int>(n_last_starts, static_cast<int>(corners.size()));
    std::partial_sort(corners.begin(), corners.begin() + n, corners.end(), is_lower);
    for (int i = 0; i < n && best.status == ContactStatus::undecided; ++i)
      go_down(corners[i].c);
  }

  void add(const std::array<int, 3> &triangle)
  {
    const double bound = bound_of(triangle);
    if (!(bound < limit()))
      return;
    open.push_back({triangle, bound});
    std::push_heap(open.begin(), open.end());
  }

  /// A direction of the triangle is a sum of its corners with weights >= 0 that add up to one at least. So whatever
  /// point p of the convex body, the least of p.c over the corners is a bound where it is positive. Taken are the
  /// corners' own points and the point between them that is best placed: with the same p.c at all corners. (A negative
  /// limit, of an overlap below the margin, is missed by a factor sqrt(3) at most: the weights add up to no more.)
  double bound_of(const std::array<int, 3> &triangle) const
  {
    Eigen::Matrix3d heights; // p_j.c_i
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        heights(i, j) = corners[triangle[j]].p.dot(corners[triangle[i]].c);
    const Vec3 a = heights.col(0), ab = heights.col(1) - a, ac = heights.col(2) - a;
    const auto bound_by = [&](const double u, const double v) { return (a + u * ab + v * ac).minCoeff(); };
    double bound = bound_by(1. / 3., 1. / 3.);
    if (bound >= limit()) // mostly
      return bound;
    bound = std::max({bound, bound_by(0., 0.), bound_by(1., 0.), bound_by(0., 1.)});
    bound = std::max({bound, bound_by(0.5, 0.), bound_by(0.5, 0.5), bound_by(0., 0.5)});
    const double m11 = ab[1] - ab[0], m12 = ac[1] - ac[0], m21 = ab[2] - ab[0], m22 = ac[2] - ac[0];
    const double r1 = a[0] - a[1], r2 = a[0] - a[2], determinant = m11 * m22 - m12 * m21;
    const double u = (r1 * m22 - r2 * m12) / determinant, v = (r2 * m11 - r1 * m21) / determinant;
    return u >= 0. && v >= 0. && u + v <= 1. ? std::max(bound, bound_by(u, v)) : bound;
  }

  const BodyPose &body1, &body2;
  const Pose<Pack> packed1, packed2;
  ContactGeometry best;
  double margin; ///< [m]
  std::vector<Corner> corners;
  std::vector<Triangle> open;             ///< heap
  std::array<SplitSide, 512> split_sides; ///< two triangles share a side: its middle is evaluated once, mostly
  std::vector<Split> splits;
};

} // namespace

ContactGeometry find_least_minimum(const BodyPose &body1, const BodyPose &body2, const ContactGeometry &first)
{
  return LeastMinimum(body1, body2, first).find();
}

} // namespace bergamo::dem
