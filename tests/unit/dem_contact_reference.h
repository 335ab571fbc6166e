#pragma once

#include "dem/geometry/contact_geometry.h"

#include <algorithm>
#include <array>
#include <vector>

/// The least phi(c) = h1(c) + h2(-c) - c.(x2 - x1) over all directions from its definition alone, slow and sure.
///
/// phi is the support function of a convex body: phi(c) = max p.c over its points p, and every direction evaluated
/// gives one of them. In a triangle of directions a, b, c any of these points p bounds phi from below by the least of
/// p.a, p.b, p.c if that is positive. Triangles that reach below the limit are split, the lowest first.
namespace contact_reference
{

using namespace bergamo;
using namespace bergamo::dem;

enum class Verdict
{
  nothing_lower, ///< phi >= limit everywhere, proven
  lower,         ///< phi < limit at the direction given
  unknown        ///< too many directions
};

struct Judgement
{
  Verdict verdict;
  Vec3 direction; ///< of the least phi seen
  double phi;     ///< there [m]
};

struct Corner
{
  Vec3 c, p;

  double phi() const { return p.dot(c); }
};

inline Corner corner(const BodyPose &a, const BodyPose &b, const Vec3 &c)
{
  return {c, support(a, c).arm - support(b, -c).arm - (b.position - a.position)};
}

struct Triangle
{
  std::array<Corner, 3> corners;
  double bound;

  explicit Triangle(const std::array<Corner, 3> &corners) : corners(corners), bound(-1e300)
  {
    // points of the triangle p1 p2 p3, on a grid
    constexpr int n = 6;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
      {
        const Vec3 p = (i * corners[0].p + j * corners[1].p + (n - i - j) * corners[2].p) / n;
        bound = std::max(bound, std::min({p.dot(corners[0].c), p.dot(corners[1].c), p.dot(corners[2].c)}));
      }
  }
  bool operator<(const Triangle &o) const { return bound > o.bound; }

  /// How much phi bends from corner i to the next.
  double bend(const int i) const
  {
    const Corner &a = corners[i], &b = corners[(i + 1) % 3];
    return (b.p - a.p).dot(b.c - a.c);
  }
};

/// @param limit > 0 [m]
inline Judgement judge(const BodyPose &body1, const BodyPose &body2, const double limit,
                       const int max_directions = 20000)
{
  std::vector<Triangle> open;
  Judgement best{Verdict::nothing_lower, Vec3::UnitX(), 1e300};
  const auto evaluate = [&](const Vec3 &c)
  {
    const Corner result = corner(body1, body2, c);
    if (result.phi() < best.phi)
      best = {best.verdict, c, result.phi()};
    return result;
  };
  const auto add = [&](const Corner &a, const Corner &b, const Corner &c)
  {
    open.emplace_back(std::array{a, b, c});
    std::push_heap(open.begin(), open.end());
  };
  std::array<Corner, 6> axes;
  for (int i = 0; i < 6; ++i)
    axes[i] = evaluate(i % 2 ? Vec3(-Vec3::Unit(i / 2)) : Vec3(Vec3::Unit(i / 2)));
  for (int i = 0; i < 8; ++i)
    add(axes[i & 1], axes[2 + (i >> 1 & 1)], axes[4 + (i >> 2)]);
  for (int n = 6; open.front().bound < limit && best.phi >= limit; ++n)
  {
    if (n == max_directions)
      return {Verdict::unknown, best.direction, best.phi};
    std::pop_heap(open.begin(), open.end());
    const Triangle t = open.back();
    open.pop_back();
    const int side = t.bend(0) >= t.bend(1) ? (t.bend(0) >= t.bend(2) ? 0 : 2) : (t.bend(1) >= t.bend(2) ? 1 : 2);
    const Corner &a = t.corners[side], &b = t.corners[(side + 1) % 3], &c = t.corners[(side + 2) % 3];
    // where the planes through both points meet, which is at a kink if there is one
    const double share = std::clamp((a.p - b.p).dot(a.c) / t.bend(side), 0.1, 0.9);
    const Corner middle = evaluate((a.c + share * (b.c - a.c)).normalized());
    add(a, middle, c);
    add(middle, b, c);
  }
  if (best.phi < limit)
    best.verdict = Verdict::lower;
  return best;
}

} // namespace contact_reference
