#include "drivers/hourglass/glass.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace bergamo::driver
{
namespace
{

constexpr double pi = std::numbers::pi;

/// Radius and height of a circle of corners.
using Ring = std::pair<double, double>;

/// From the middle of the floor along it, up the walls and through the neck to the top.
std::vector<Ring> profile(const GlassShape &s)
{
  const std::vector<Ring> corners{
      {0., -s.height()},   {s.chamber_radius, -s.height()},     {s.chamber_radius, -s.cone_height()},
      {s.neck_radius, 0.}, {s.chamber_radius, s.cone_height()}, {s.chamber_radius, s.height()}};
  std::vector<Ring> rings{corners.front()};
  for (std::size_t k = 1; k < corners.size(); ++k)
  {
    const auto [r, z] = corners[k - 1];
    const double dr = corners[k].first - r, dz = corners[k].second - z;
    const double n = std::ceil(std::hypot(dr, dz) / s.triangle_size);
    for (int part = 1; part <= n; ++part)
      rings.emplace_back(r + dr * part / n, z + dz * part / n);
  }
  return rings;
}

} // namespace

double GlassShape::slope() const
{
  return std::tan(half_angle / 180. * pi);
}

double GlassShape::cone_height() const
{
  return (chamber_radius - neck_radius) / slope();
}

dem::Surface make_glass(const GlassShape &s)
{
  const std::vector<Ring> rings = profile(s);
  std::vector<Vec3> nodes{Vec3(0., 0., rings.front().second)};
  for (std::size_t k = 1; k < rings.size(); ++k)
    for (int j = 0; j < s.n_facets; ++j)
    {
      const double angle = 2. * pi * j / s.n_facets;
      nodes.emplace_back(rings[k].first * std::cos(angle), rings[k].first * std::sin(angle), rings[k].second);
    }
  const auto corner = [&](const std::size_t ring, const int j)
  { return static_cast<std::int32_t>(1 + (ring - 1) * s.n_facets + j % s.n_facets); };
  std::vector<dem::Triangle> triangles;
  for (int j = 0; j < s.n_facets; ++j)
    triangles.push_back({0, corner(1, j), corner(1, j + 1)});
  for (std::size_t k = 1; k + 1 < rings.size(); ++k)
    for (int j = 0; j < s.n_facets; ++j)
    {
      const std::int32_t a = corner(k, j), b = corner(k + 1, j), c = corner(k + 1, j + 1), d = corner(k, j + 1);
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    }
  return {std::move(nodes), std::move(triangles)};
}

dem::PackingSpace chamber_between(const GlassShape &s, const double bottom, const double top)
{
  const double middle = std::cos(pi / s.n_facets); // of a facet, over its corners' radius
  std::vector<dem::HalfSpace> planes{{-Vec3::UnitZ(), -bottom}, {Vec3::UnitZ(), top}};
  for (int j = 0; j < s.n_facets; ++j)
  {
    const double angle = 2. * pi * (j + 0.5) / s.n_facets;
    const Vec3 outwards(std::cos(angle), std::sin(angle), 0.);
    if (bottom < s.cone_height())
      planes.push_back({outwards - middle * s.slope() * Vec3::UnitZ(), middle * s.neck_radius});
    if (top > s.cone_height())
      planes.push_back({outwards, middle * s.chamber_radius});
  }
  return dem::PackingSpace::polyhedron(std::move(planes));
}

} // namespace bergamo::driver
