#include "dem/geometry/part_overlap.h"

#include "dem/geometry/concave.h"
#include "dem/geometry/support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace bergamo::dem
{
namespace
{

/// |(a, b)| in the norm of power p > 1, with its derivatives.
struct PowerNorm
{
  double value, by_a, by_b;

  PowerNorm(const double a, const double b, const double p)
  {
    const double x = std::abs(a), y = std::abs(b), large = std::max(x, y), ratio = std::min(x, y) / large;
    if (!(large > 0.))
    {
      value = by_a = by_b = 0.;
      return;
    }
    const double power = std::pow(ratio, p), root = std::pow(1. + power, 1. / p);
    value = large * root;
    const double of_large = root / (1. + power), of_small = power > 0. ? of_large * power / ratio : 0.;
    by_a = std::copysign(x >= y ? of_large : of_small, a);
    by_b = std::copysign(x >= y ? of_small : of_large, b);
  }
};

/// A superquadric with half-axes one.
struct UnitShape
{
  double p1, p2; ///< 2/eps1, 2/eps2

  explicit UnitShape(const Superquadric &s) : p1(2. / s.eps1), p2(2. / s.eps2) {}

  /// Half of the section at x1, along the second axis.
  double half_width(const double x1) const { return complement(std::abs(x1), p1); }

  /// Half of the chord along the third axis.
  double half_chord(const double x1, const double x2) const { return complement(PowerNorm(x1, x2, p1).value, p2); }

  /// The chord { t : x + t d in the body }, if the line meets it.
  std::optional<Range> chord(const Vec3 &x, const Vec3 &d) const
  {
    // The cube around the body first: there the gauge is one at least.
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    for (int k = 0; k < 3; ++k)
      if (d[k] != 0.)
      {
        const double t1 = (-1. - x[k]) / d[k], t2 = (1. - x[k]) / d[k];
        low = std::max(low, std::min(t1, t2));
        high = std::min(high, std::max(t1, t2));
      }
      else if (std::abs(x[k]) > 1.)
        return {};
    if (!(low < high))
      return {};
    const std::optional<double> first = enter(x, d, low, high);
    if (!first)
      return {};
    const std::optional<double> last = enter(x, -d, -high, -*first);
    return Range{*first, last ? -*last : *first};
  }

private:
  /// (1 - x^p)^(1/p)
  static double complement(const double x, const double p)
  {
    const double rest = 1. - std::pow(x, p);
    return rest > 0. ? std::pow(rest, 1. / p) : 0.;
  }

  /// Newton's method on the gauge, a norm, from a point outside: it is convex along the line, so no step goes too far.
  std::optional<double> enter(const Vec3 &x, const Vec3 &d, double t, const double end) const
  {
    for (int i = 0; i < 200; ++i)
    {
      const Vec3 y = x + t * d;
      const PowerNorm plane(y[0], y[1], p1), body(plane.value, y[2], p2);
      const double excess = body.value - 1.;
      if (excess <= 0.)
        return t;
      const double slope = body.by_a * (plane.by_a * d[0] + plane.by_b * d[1]) + body.by_b * d[2];
      if (!(slope < 0.))
        return {};
      const double next = t - excess / slope;
      if (!(next <= end))
        return {};
      if (next == t)
        return t;
      t = next;
    }
    return t;
  }
};

/// Another part in the coordinates of the first one.
class OtherPart
{
public:
  OtherPart(const ClumpPart &part, const ClumpPart &other)
      : shape(other.shape), support_shape(1., 1., 1., other.shape.eps1, other.shape.eps2)
  {
    const Mat3 turn = (other.orientation.conjugate() * part.orientation).toRotationMatrix();
    const Vec3 arm = other.orientation.conjugate() * (part.position - other.position);
    in = other.shape.half_axes.cwiseInverse().asDiagonal() * turn * part.shape.half_axes.asDiagonal();
    offset = arm.cwiseQuotient(other.shape.half_axes);
    out = part.shape.half_axes.cwiseInverse().asDiagonal() * turn.transpose() * other.shape.half_axes.asDiagonal();
    centre = -(part.shape.half_axes.cwiseInverse().asDiagonal() * (turn.transpose() * arm));
  }

  std::optional<Range> chord(const double x1, const double x2) const
  {
    return shape.chord(in.col(0) * x1 + in.col(1) * x2 + offset, in.col(2));
  }

  /// Extent along the first axis.
  Range extent() const
  {
    const double half = height(Vec3::UnitX()).first;
    return {centre[0] - half, centre[0] + half};
  }

  /// Extent of the section at x1 along the second axis. The duality of linear programming: the highest point of the
  /// section is min over lambda of h(e2 + lambda e1) - lambda x1, and lambda is where the support point lies in it.
  Range section(const double x1) const { return {-highest(x1, -1.), highest(x1, 1.)}; }

private:
  /// Support height about the centre and the first coordinate of its point.
  std::pair<double, double> height(const Vec3 &c) const
  {
    const Vec3 n = out.transpose() * c;
    const Support<double> s = support(support_shape, n[0], n[1], n[2]);
    return {s.h, out.row(0).dot(Vec3(s.x1, s.x2, s.x3))};
  }

  double highest(const double x1, const double side) const
  {
    const double place = x1 - centre[0];
    const auto direction = [&](const double angle) { return Vec3(std::sin(angle), side * std::cos(angle), 0.); };
    const auto miss = [&](const double angle) { return height(direction(angle)).second - place; };
    constexpr double steepest = 0.5 * std::numbers::pi - 1e-9;
    std::uintmax_t iterations = 60;
    std::pair<double, double> angles(-steepest, steepest);
    if (miss(-steepest) < 0. && miss(steepest) > 0.)
      angles = boost::math::tools::toms748_solve(miss, -steepest, steepest,
                                                 boost::math::tools::eps_tolerance<double>(30), iterations);
    double highest = std::numeric_limits<double>::infinity();
    for (const double angle : {angles.first, angles.second})
      highest = std::min(highest, (height(direction(angle)).first - place * std::sin(angle)) / std::cos(angle));
    return highest + side * centre[1];
  }

  UnitShape shape;
  SupportShape<double> support_shape;
  Mat3 in, out;        ///< from the first part's coordinates to this one's, and back
  Vec3 offset, centre; ///< of both maps
};

/// What one part shares with others, in its own coordinates.
class Sharing
{
public:
  Sharing(const ClumpPart &part, const std::span<const ClumpPart> all, const double tolerance)
      : shape(part.shape), tolerance(tolerance)
  {
    for (const ClumpPart &other : all)
    {
      const OtherPart candidate(part, other);
      if (const std::optional<Range> range = shared_range(candidate))
      {
        others.push_back(candidate);
        ranges.push_back(*range);
      }
    }
  }

  PartOverlap measure()
  {
    if (others.empty())
      return {};
    const auto section = [&](const double x1) { return of_section(x1); };
    PartOverlap overlap{integrate(section, breaks_of(ranges, 1.), tolerance, max_sections), false};
    overlap.shared.error += end_error;
    overlap.is_whole = is_whole && covers(ranges, 1.);
    return overlap;
  }

private:
  static constexpr int max_sections = 400, max_pieces = 200;
  static constexpr double end_error = 1e-9;   // of all moments: ends of nearly sharp edges are known to 1e-10
  static constexpr double inner_share = 0.05; // of the tolerance: the outer rule must not see the inner one's error

  /// How much of the chord is shared: concave where both bodies have one.
  double depth(const OtherPart &other, const double x1, const double x2) const
  {
    const double half = shape.half_chord(x1, x2);
    const std::optional<Range> chord = other.chord(x1, x2);
    constexpr double beside = -1e100; // of the other part, by rounding of its section's end
    return chord ? std::min(half, chord->high) - std::max(-half, chord->low) : beside;
  }

  /// Where in the section at x1 both bodies have chords, which may be empty.
  Range common_section(const OtherPart &other, const double x1) const
  {
    const double half = shape.half_width(x1);
    const Range section = other.section(x1);
    return {std::max(-half, section.low), std::min(half, section.high)};
  }

  std::optional<Range> shared_section(const OtherPart &other, const double x1) const
  {
    const Range common = common_section(other, x1);
    return positive_range([&](const double x2) { return depth(other, x1, x2); }, common.low, common.high);
  }

  /// Where along the first axis sections share something.
  std::optional<Range> shared_range(const OtherPart &other) const
  {
    const Range extent = other.extent();
    const auto common_width = [&](const double x1)
    {
      const Range common = common_section(other, x1);
      return common.high - common.low;
    };
    const std::optional<Range> common =
        positive_range(common_width, std::max(-1., extent.low), std::min(1., extent.high));
    if (!common)
      return {};
    const auto deepest = [&](const double x1)
    {
      const Range section = common_section(other, x1);
      return largest_value([&](const double x2) { return depth(other, x1, x2); }, section.low, section.high);
    };
    return positive_range(deepest, common->low, common->high);
  }

  /// Ends of ranges, with the middle, where powers of |x| have their kink.
  static std::vector<double> breaks_of(const std::vector<Range> &ranges, const double half)
  {
    std::vector<double> breaks;
    for (const Range &range : ranges)
    {
      breaks.push_back(range.low);
      breaks.push_back(range.high);
      if (range.low < 0. && range.high > 0.)
        breaks.push_back(0.);
    }
    std::sort(breaks.begin(), breaks.end());
    const auto same = [&](const double a, const double b) { return b - a < 1e-14 * half; };
    breaks.erase(std::unique(breaks.begin(), breaks.end(), same), breaks.end());
    return breaks;
  }

  static bool covers(const std::vector<Range> &ranges, const double half)
  {
    return std::any_of(ranges.begin(), ranges.end(),
                       [&](const Range &range) { return range.low <= -half && range.high >= half; });
  }

  Integral of_section(const double x1)
  {
    std::vector<Range> sections;
    std::vector<const OtherPart *> here;
    for (std::size_t k = 0; k < others.size(); ++k)
      if (x1 > ranges[k].low && x1 < ranges[k].high)
        if (const std::optional<Range> section = shared_section(others[k], x1))
        {
          sections.push_back(*section);
          here.push_back(&others[k]);
        }
    const double half = shape.half_width(x1);
    is_whole = is_whole && covers(sections, half);
    if (here.empty())
      return {};
    const auto chord = [&](const double x2) { return Integral{of_chord(here, x1, x2), 0.}; };
    return integrate(chord, breaks_of(sections, half), inner_share * tolerance, max_pieces);
  }

  /// The union of the shared chords: exact.
  Moments of_chord(const std::vector<const OtherPart *> &here, const double x1, const double x2)
  {
    const double half = shape.half_chord(x1, x2);
    chords.clear();
    for (const OtherPart *other : here)
    {
      const std::optional<Range> chord = other->chord(x1, x2);
      if (!chord)
        continue;
      const Range shared{std::max(-half, chord->low), std::min(half, chord->high)};
      if (shared.low < shared.high)
        chords.push_back(shared);
    }
    std::sort(chords.begin(), chords.end(), [](const Range &a, const Range &b) { return a.low < b.low; });
    double m0 = 0., m1 = 0., m2 = 0., end = -half;
    bool has_gap = false;
    for (const Range &chord : chords)
    {
      has_gap = has_gap || chord.low > end;
      const double low = std::max(chord.low, end), high = std::max(chord.high, end);
      m0 += high - low;
      m1 += (high * high - low * low) / 2.;
      m2 += (high * high * high - low * low * low) / 3.;
      end = high;
    }
    is_whole = is_whole && !has_gap && end >= half;
    Moments m;
    m << m0, x1 * m0, x2 * m0, m1, x1 * x1 * m0, x2 * x2 * m0, m2, x1 * x2 * m0, x1 * m1, x2 * m1;
    return m;
  }

  UnitShape shape;
  double tolerance;
  std::vector<OtherPart> others; ///< that share something
  std::vector<Range> ranges;     ///< where, along the first axis
  std::vector<Range> chords;     ///< working space
  bool is_whole = true;          ///< at all points so far
};

} // namespace

PartOverlap shared_moments(const ClumpPart &part, const std::span<const ClumpPart> others, const double tolerance)
{
  return Sharing(part, others, tolerance).measure();
}

} // namespace bergamo::dem
