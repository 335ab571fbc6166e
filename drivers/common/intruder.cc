#include "drivers/common/intruder.h"

#include "dem/geometry/merge_nodes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace bergamo::driver
{
namespace
{

constexpr double pi = std::numbers::pi;

/// Rows of places, as many in each, between which the triangles lie: seen from outside the next place of a row is on
/// the right where the next row is above.
struct Rows
{
  std::vector<std::vector<Vec3>> row;
  std::vector<std::int32_t> part; ///< between each row and the next one
  bool is_closed = false;         ///< the last place of a row is beside the first
};

/// Half-width and height.
struct ProfilePoint
{
  double r, z;
};

int parts_of(const double length, const double size)
{
  return std::max(1, static_cast<int>(std::ceil(length / size * (1. - 1e-9))));
}

/// Of a half of the body, from its lowest point to its top.
std::vector<ProfilePoint> half_profile(const IntruderShape &s, const double height, std::vector<std::int32_t> &part)
{
  const std::array<ProfilePoint, 3> corner{{{0., 0.}, {0.5 * s.width, s.tip_height()}, {0.5 * s.width, height}}};
  std::vector<ProfilePoint> points{corner[0]};
  for (int k = 0; k < 2; ++k)
  {
    const double dr = corner[k + 1].r - corner[k].r, dz = corner[k + 1].z - corner[k].z;
    const int n = parts_of(std::hypot(dr, dz), s.triangle_size);
    for (int i = 1; i <= n; ++i)
    {
      points.push_back({corner[k].r + dr * i / n, corner[k].z + dz * i / n});
      part.push_back(k == 0 ? tip_part : shaft_part);
    }
  }
  return points;
}

/// Section of unit half-width, anticlockwise from above.
std::vector<Vec2> section(const IntruderShape &s)
{
  std::vector<Vec2> points;
  if (s.kind == IntruderKind::cone)
  {
    const double corner = std::sqrt(2. * pi / s.n_facets / std::sin(2. * pi / s.n_facets)); // the circle's area
    for (int j = 0; j < s.n_facets; ++j)
      points.emplace_back(corner * std::cos(2. * pi * j / s.n_facets), corner * std::sin(2. * pi * j / s.n_facets));
    return points;
  }
  const double b = s.breadth / s.width;
  const std::array<Vec2, 5> corner{Vec2(1., -b), Vec2(1., b), Vec2(-1., b), Vec2(-1., -b), Vec2(1., -b)};
  for (int k = 0; k < 4; ++k)
  {
    const int n = parts_of(0.5 * s.width * (corner[k + 1] - corner[k]).norm(), s.triangle_size);
    for (int i = 0; i < n; ++i)
      points.push_back(corner[k] + (corner[k + 1] - corner[k]) * i / n);
  }
  return points;
}

/// One row around the body for each point of its profile, upwards.
Rows around(const IntruderShape &s, const double height)
{
  Rows rows;
  rows.is_closed = true;
  for (const ProfilePoint &p : half_profile(s, height, rows.part))
  {
    rows.row.emplace_back();
    for (const Vec2 &q : section(s))
      rows.row.back().emplace_back(p.r * q[0], p.r * q[1], p.z);
  }
  return rows;
}

/// One row along y for each point of the profile, from the top on the left to that on the right.
Rows along(const IntruderShape &s, const double height, const double overhang)
{
  std::vector<std::int32_t> part;
  const std::vector<ProfilePoint> half = half_profile(s, height, part);
  Rows rows;
  rows.part.assign(part.rbegin(), part.rend());
  rows.part.insert(rows.part.end(), part.begin(), part.end());
  const double length = s.breadth + 2. * overhang;
  const int n = parts_of(length, s.triangle_size);
  const auto add = [&](const double x, const double z)
  {
    rows.row.emplace_back();
    for (int j = 0; j <= n; ++j)
      rows.row.back().emplace_back(x, length * (static_cast<double>(j) / n - 0.5), z);
  };
  for (auto p = half.rbegin(); p != half.rend(); ++p)
    add(-p->r, p->z);
  for (auto p = half.begin() + 1; p != half.end(); ++p)
    add(p->r, p->z);
  return rows;
}

} // namespace

void IntruderShape::declare(ParameterFile &file, const std::string &section)
{
  file.add(section, "width", width, "along x; a cone's diameter [m]", Range::positive().usual(1e-4, 10));
  file.add(section, "tip angle", tip_angle, "full angle of the tip; 180: flat [degrees]", Range::between(10, 180));
  file.add(section, "facets", n_facets, "around a cone", Range::between(6, 1000));
  file.add(section, "triangle size", triangle_size, "at most [m]", Range::positive().usual(1e-4, 10));
}

double IntruderShape::tip_height() const
{
  return tip_angle == 180. ? 0. : 0.5 * width / std::tan(tip_angle / 360. * pi);
}

double IntruderShape::tip_area() const
{
  return kind == IntruderKind::cone ? 0.25 * pi * width * width : width * breadth;
}

Intruder make_intruder(const IntruderShape &s, const Vec3 &lowest, const double height, const double overhang)
{
  const Rows rows = s.kind == IntruderKind::pile ? along(s, height, overhang) : around(s, height);
  const auto n = static_cast<std::int32_t>(rows.row.front().size());
  std::vector<Vec3> nodes;
  for (const std::vector<Vec3> &row : rows.row)
    for (const Vec3 &place : row)
      nodes.push_back(lowest + place);
  std::vector<dem::Triangle> triangles;
  std::vector<std::int32_t> part;
  for (std::size_t k = 0; k < rows.part.size(); ++k)
    for (std::int32_t j = 0; j < (rows.is_closed ? n : n - 1); ++j)
    {
      const std::int32_t first = static_cast<std::int32_t>(k) * n, a = first + j, b = first + (j + 1) % n;
      triangles.insert(triangles.end(), {{a, b, b + n}, {a, b + n, a + n}});
      part.insert(part.end(), 2, rows.part[k]);
    }
  constexpr double same_place = 1e-12; // m
  dem::merge_nodes(nodes, triangles, same_place);

  Intruder intruder;
  intruder.parts = {.surface = 0, .n_parts = 2, .of_face = {}};
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const auto [a, b, c] = triangles[t];
    if (a == b || b == c || c == a) // at the point of a tip
      continue;
    intruder.body.triangles.push_back({static_cast<unsigned>(a), static_cast<unsigned>(b), static_cast<unsigned>(c)});
    intruder.parts.of_face.push_back(part[t]);
  }
  for (const Vec3 &node : nodes)
    intruder.body.vertices.push_back({node[0], node[1], node[2]});
  intruder.body.inertia.centre = {lowest[0], lowest[1], lowest[2]};
  intruder.body.guide.velocity = {0., 0., 0.};
  intruder.body.guide.angular_velocity = {0., 0., 0.};
  return intruder;
}

} // namespace bergamo::driver
