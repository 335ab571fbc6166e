#include "benchmarks/peers/vessels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace bergamo::benchmark
{
namespace
{

constexpr int n_around = 36; // facets of a round wall

/// Triangles in the making; rings of n_around nodes each.
struct Mesh
{
  std::vector<Vec3> nodes;
  std::vector<dem::Triangle> triangles;

  std::int32_t add_ring(const std::vector<Vec3> &ring)
  {
    nodes.insert(nodes.end(), ring.begin(), ring.end());
    return static_cast<std::int32_t>(nodes.size() - ring.size());
  }

  /// The wall between two closed rings of n nodes. Normals point to the axis where the rings turn anticlockwise as seen
  /// from the second one's side.
  void join(const std::int32_t low, const std::int32_t high, const std::int32_t n)
  {
    for (std::int32_t k = 0; k < n; ++k)
    {
      const std::int32_t a = low + k, b = low + (k + 1) % n, c = high + (k + 1) % n, d = high + k;
      triangles.insert(triangles.end(), {{b, a, d}, {b, d, c}});
    }
  }

  /// Closes a ring by a fan, anticlockwise with the ring. @param turned against it
  void close(const std::int32_t ring, const std::int32_t n, const Vec3 &centre, const bool turned)
  {
    const auto middle = static_cast<std::int32_t>(nodes.size());
    nodes.push_back(centre);
    for (std::int32_t k = 0; k < n; ++k)
    {
      const std::int32_t a = ring + k, b = ring + (k + 1) % n;
      triangles.push_back(turned ? dem::Triangle{middle, b, a} : dem::Triangle{middle, a, b});
    }
  }
};

Vec3 direction(const double turn) // in turns, about z
{
  const double angle = 2. * std::numbers::pi * turn;
  return {std::cos(angle), std::sin(angle), 0.};
}

std::vector<Vec3> circle(const double radius, const double height)
{
  std::vector<Vec3> ring;
  for (int k = 0; k < n_around; ++k)
    ring.push_back(radius * direction(double(k) / n_around) + Vec3(0., 0., height));
  return ring;
}

/// Rows of about square facets over a length.
int n_rows(const double length, const double facet)
{
  return std::max(1, static_cast<int>(std::lround(length / facet)));
}

double facet_of(const double radius)
{
  return 2. * std::numbers::pi * radius / n_around;
}

/// The z axis turned to the y axis.
Vec3 lying(const Vec3 &x)
{
  return {x.y(), x.z(), x.x()};
}

} // namespace

dem::Surface Silo::surface() const
{
  Mesh mesh;
  std::int32_t below = mesh.add_ring(circle(orifice_radius, 0.));
  const auto rise_to = [&](const double radius_above, const double height_above)
  {
    const std::int32_t above = mesh.add_ring(circle(radius_above, height_above));
    mesh.join(below, above, n_around);
    below = above;
  };
  const double cone = cone_height();
  const int in_cone = n_rows(std::hypot(cone, radius - orifice_radius), facet_of(radius)),
            in_cylinder = n_rows(height - cone, facet_of(radius));
  for (int row = 1; row <= in_cone; ++row)
    rise_to(std::lerp(orifice_radius, radius, double(row) / in_cone), cone * row / in_cone);
  for (int row = 1; row <= in_cylinder; ++row)
    rise_to(radius, std::lerp(cone, height, double(row) / in_cylinder));
  return {mesh.nodes, mesh.triangles};
}

dem::PackingSpace Silo::space() const
{
  const double apothem = std::cos(std::numbers::pi / n_around);
  std::vector<dem::HalfSpace> planes{{-Vec3::UnitZ(), 0.}, {Vec3::UnitZ(), height}};
  for (int k = 0; k < n_around; ++k)
  {
    const Vec3 outwards = direction((k + 0.5) / n_around);
    planes.push_back({outwards, radius * apothem});
    const Vec3 down = Vec3(slope * outwards.x(), slope * outwards.y(), -apothem).normalized();
    planes.push_back({down, down.dot(orifice_radius * apothem * outwards)});
  }
  return dem::PackingSpace::polyhedron(planes);
}

dem::Surface Drum::surface() const
{
  Mesh mesh;
  const int rows = n_rows(width, facet_of(radius));
  const std::int32_t first = mesh.add_ring(circle(radius, -0.5 * width));
  std::int32_t last = first;
  for (int row = 1; row <= rows; ++row)
  {
    const std::int32_t next = mesh.add_ring(circle(radius, width * (double(row) / rows - 0.5)));
    mesh.join(last, next, n_around);
    last = next;
  }
  mesh.close(first, n_around, Vec3(0., 0., -0.5 * width), false);
  mesh.close(last, n_around, Vec3(0., 0., 0.5 * width), true);
  for (Vec3 &x : mesh.nodes)
    x = lying(x);
  return {mesh.nodes, mesh.triangles};
}

dem::PackingSpace Drum::space() const
{
  std::vector<dem::HalfSpace> planes{{Vec3::UnitY(), 0.5 * width}, {-Vec3::UnitY(), 0.5 * width}};
  for (int k = 0; k < n_around; ++k)
    planes.push_back({lying(direction((k + 0.5) / n_around)), radius * std::cos(std::numbers::pi / n_around)});
  return dem::PackingSpace::polyhedron(planes);
}

dem::Surface OpenBox::surface() const
{
  constexpr int n_across = 8;
  const double cell = width / n_across, edge = 0.5 * width;
  Mesh mesh;
  const auto outline = [&](const double z)
  {
    std::vector<Vec3> ring;
    for (int side = 0; side < 4; ++side)
      for (int k = 0; k < n_across; ++k)
      {
        const double along = cell * k - edge;
        const Vec3 places[] = {{along, -edge, z}, {edge, along, z}, {-along, edge, z}, {-edge, -along, z}};
        ring.push_back(places[side]);
      }
    return ring;
  };
  const int rows = n_rows(height, cell);
  const std::int32_t floor = mesh.add_ring(outline(0.));
  std::int32_t below = floor;
  for (int row = 1; row <= rows; ++row)
  {
    const std::int32_t above = mesh.add_ring(outline(height * row / rows));
    mesh.join(below, above, 4 * n_across);
    below = above;
  }
  mesh.close(floor, 4 * n_across, Vec3::Zero(), false);
  return {mesh.nodes, mesh.triangles};
}

dem::PackingSpace OpenBox::space() const
{
  return dem::Box{{-0.5 * width, -0.5 * width, 0.}, {0.5 * width, 0.5 * width, height}};
}

} // namespace bergamo::benchmark
