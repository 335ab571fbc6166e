#include "dem/state/surface.h"
#include "drivers/common/intruder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace bergamo;
using namespace bergamo::driver;

namespace
{

constexpr double mm = 1e-3, height = 20. * mm;
const Vec3 lowest(1. * mm, 2. * mm, 3. * mm);

/// Sums over the triangles of a part: area vectors, and the volume between them and the lowest point.
struct PartSums
{
  Vec3 area = Vec3::Zero(); ///< [m²]
  double horizontal = 0.;   ///< of the area vectors' horizontal lengths [m²]
  double volume = 0.;       ///< [m³]
};

PartSums sums_of(const Intruder &intruder, const std::int32_t part)
{
  PartSums sums;
  const auto place = [&](const unsigned n)
  {
    const auto &v = intruder.body.vertices[n];
    return Vec3(Vec3(v[0], v[1], v[2]) - lowest);
  };
  for (std::size_t t = 0; t < intruder.body.triangles.size(); ++t)
  {
    if (intruder.parts.of_face[t] != part)
      continue;
    const auto &[a, b, c] = intruder.body.triangles[t];
    const Vec3 area = 0.5 * (place(b) - place(a)).cross(place(c) - place(a));
    sums.area += area;
    sums.horizontal += area.head<2>().norm();
    sums.volume += place(a).dot(area) / 3.;
  }
  return sums;
}

} // namespace

TEST_CASE("tip and shaft of every intruder face outwards, and their areas are those of the body")
{
  IntruderShape shape{.width = 4. * mm, .breadth = 3. * mm, .n_facets = 12, .triangle_size = 1.3 * mm};
  for (const IntruderKind kind : {IntruderKind::plate, IntruderKind::cone, IntruderKind::pile})
    for (const double angle : {180., 90.})
    {
      shape.kind = kind;
      shape.tip_angle = angle;
      CAPTURE(static_cast<int>(kind), angle);
      const Intruder intruder = make_intruder(shape, lowest, height, 0.);
      REQUIRE(intruder.parts.of_face.size() == intruder.body.triangles.size());
      intruder.body.validate();
      std::vector<Vec3> nodes;
      double low = 1., high = 0.;
      for (const auto &v : intruder.body.vertices)
      {
        nodes.emplace_back(v[0], v[1], v[2]);
        low = std::min(low, v[2]);
        high = std::max(high, v[2]);
      }
      CHECK(low == Approx(lowest[2]).epsilon(1e-12));
      CHECK(high == Approx(lowest[2] + height).epsilon(1e-12));
      std::vector<dem::Triangle> triangles;
      for (const auto &[a, b, c] : intruder.body.triangles)
        triangles.push_back({static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
      CHECK_NOTHROW(dem::Surface(nodes, triangles).validate(2));

      const double tip_height = angle == 180. ? 0. : 2. * mm;
      CHECK(shape.tip_height() == Approx(tip_height).margin(1e-15));
      const double area = shape.tip_area(),
                   exact = kind == IntruderKind::cone ? 4. * std::numbers::pi * mm * mm : 12. * mm * mm;
      CHECK(area == Approx(exact).epsilon(1e-12));
      const PartSums tip = sums_of(intruder, tip_part), shaft = sums_of(intruder, shaft_part);
      CHECK((tip.area + area * Vec3::UnitZ()).norm() < 1e-12 * area); // downwards
      CHECK(shaft.area.norm() < 1e-12 * area);
      // Outwards: from the lowest point the shaft's triangles are seen from behind.
      CHECK(shaft.volume > 0.);
      CHECK(tip.volume == Approx(0.).margin(1e-12 * area * height)); // all of them pass through it
      const double around = kind == IntruderKind::pile ? 2. * shape.breadth : 2. * (shape.width + shape.breadth);
      if (kind != IntruderKind::cone)
        CHECK(shaft.horizontal == Approx(around * (height - tip_height)).epsilon(1e-12));
      else // of the regular polygon of the circle's area
        CHECK(shaft.horizontal ==
              Approx(2. * std::sqrt(area * 12. * std::tan(std::numbers::pi / 12.)) * (height - tip_height))
                  .epsilon(1e-12));
    }
}

TEST_CASE("a pile reaches beyond the box on both sides")
{
  const IntruderShape shape{.kind = IntruderKind::pile, .width = 4. * mm, .breadth = 6. * mm};
  double low = 1., high = -1.;
  for (const auto &v : make_intruder(shape, lowest, height, 1.5 * mm).body.vertices)
  {
    low = std::min(low, v[1]);
    high = std::max(high, v[1]);
  }
  CHECK(low == Approx(lowest[1] - 4.5 * mm).epsilon(1e-12));
  CHECK(high == Approx(lowest[1] + 4.5 * mm).epsilon(1e-12));
}
