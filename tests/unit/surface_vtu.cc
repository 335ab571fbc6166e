#include "dem/io/surface_vtu.h"
#include "dem/core/error.h"
#include "dem/io/surface_file.h"
#include "dem/simulation/simulation.h"

#include "tests/surfaces.h"
#include "tests/temporary_folder.h"
#include "tests/unit/vtu_reader.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

using namespace bergamo;
using namespace bergamo::dem;
using namespace bergamo::dem::test;
using Catch::Contains;

namespace
{

constexpr double mm = 1e-3, radius = 1. * mm, overlap = 0.002 * mm;

dem::Surface in_millimetres(const test::Surface &surface)
{
  std::vector<Vec3> nodes;
  for (const Vec3 &x : surface.node)
    nodes.push_back(mm * x);
  return {nodes, surface.topology.triangle};
}

/// A ball on surfaces, its centre at a place, after a few steps of its velocity.
Simulation with_ball(const std::vector<dem::Surface> &surfaces, const Vec3 &place, const Vec3 &velocity = Vec3::Zero())
{
  SimulationParameters p;
  p.grain() = p.wall() = {1e8, 0.3, 2650.};
  p.between_grains().friction = p.with_walls().friction = 0.3;
  p.time_step = 1e-6;
  Particles grains;
  grains.add({Vec3::Constant(radius), 1., 1.}, 2650., place, Quaternion::Identity());
  grains.velocity[0] = velocity;
  Simulation s(p, grains, {});
  for (const dem::Surface &surface : surfaces)
    s.add_surface(surface);
  const int n_steps = velocity.isZero(0.) ? 0 : 20;
  for (int k = 0; k < n_steps; ++k)
    s.step();
  s.compute_forces();
  return s;
}

std::vector<SurfaceStress> stresses_of(const Simulation &s)
{
  std::size_t n_features = 0;
  for (const dem::Surface &surface : s.surfaces)
    n_features += surface.n_features();
  return surface_stress(s.surfaces, s.contacts.touching_walls(s.particles), s.contacts.friction_work(n_features));
}

double area_of(const dem::Surface &surface, const std::size_t t)
{
  const auto &[a, b, c] = surface.topology.triangle[t];
  return 0.5 * (surface.node[b] - surface.node[a]).cross(surface.node[c] - surface.node[a]).norm();
}

/// Sums of stress times area.
struct Sums
{
  double normal = 0.;
  Vec3 force = Vec3::Zero();
};

Sums sums_of(const dem::Surface &surface, const SurfaceStress &stress)
{
  Sums sums;
  for (std::size_t t = 0; t < surface.topology.n_faces(); ++t)
  {
    sums.normal += area_of(surface, t) * stress.pressure[t];
    sums.force += area_of(surface, t) * stress.traction[t];
  }
  return sums;
}

/// A square [0, 4]^2 mm of 2 x 2 squares, cut along diagonals of their own.
dem::Surface flat_square(const Vec3 &shift = Vec3::Zero())
{
  std::mt19937_64 random(5);
  test::Surface s = grid_surface(
      2, [](double, double) { return 0.; }, 0., random);
  for (Vec3 &x : s.node)
    x = 2. * x + shift;
  return in_millimetres(s);
}

} // namespace

TEST_CASE("what grains press on a plane of triangles is shared by face, edge and vertex")
{
  const dem::Surface plane = flat_square();
  const Vec3 rise(0., 0., radius - overlap);
  const auto stress_at = [&](const Vec3 &foot) { return stresses_of(with_ball({plane}, foot + rise))[0]; };
  const double whole = [&]
  {
    const Simulation s = with_ball({plane}, Vec3(0.7 * mm, 0.2 * mm, 0.) + rise);
    return s.contacts.touching_walls(s.particles)[0].state.forces.normal;
  }();
  REQUIRE(whole > 0.);

  for (std::size_t t = 0; t < plane.topology.n_faces(); ++t) // the middle of a face
  {
    Vec3 foot = Vec3::Zero();
    for (const std::int32_t n : plane.topology.triangle[t])
      foot += plane.node[n] / 3.;
    const SurfaceStress stress = stress_at(foot);
    for (std::size_t k = 0; k < stress.pressure.size(); ++k)
      CHECK(stress.pressure[k] * area_of(plane, k) == Approx(k == t ? whole : 0.).epsilon(1e-9));
  }
  for (const Vec3 &foot : {Vec3(0.3 * mm, 0.4 * mm, 0.), Vec3(2. * mm, 1. * mm, 0.), Vec3(2. * mm, 2. * mm, 0.),
                           Vec3(1. * mm, 2. * mm, 0.), Vec3(1. * mm, 1. * mm, 0.)})
  {
    // On an edge rounding has the say which of face, edge and face it is; the sum does not depend on that.
    const SurfaceStress stress = stress_at(foot);
    CHECK(sums_of(plane, stress).normal == Approx(whole).epsilon(1e-9));
    CHECK((sums_of(plane, stress).force - Vec3(0., 0., -whole)).norm() < 1e-9 * whole);
  }
}

TEST_CASE("contacts on edges and vertices are shared by halves and by angles")
{
  // A roof whose ridge runs along y, and a tip; both convex, so the ball is on edge and vertex for sure.
  const dem::Surface roof = in_millimetres(ridge(0.5));
  const SurfaceStress on_edge = stresses_of(with_ball({roof}, Vec3(0., 1. * mm, radius - overlap)))[0];
  const double left = on_edge.pressure[0] * area_of(roof, 0), right = on_edge.pressure[1] * area_of(roof, 1);
  CHECK(left > 0.);
  CHECK(left == Approx(right).epsilon(1e-12));
  CHECK(on_edge.shear_stress[0] == 0.); // pressed on squarely
  CHECK(on_edge.traction[0].z() == Approx(-on_edge.pressure[0]).epsilon(1e-9));

  const dem::Surface box = in_millimetres(cube());
  constexpr std::int32_t corner = 3;
  const Vec3 outwards = box.node[corner].normalized();
  const Simulation s = with_ball({box}, box.node[corner] + (radius - overlap) * outwards);
  const std::vector<TouchingContact> contacts = s.contacts.touching_walls(s.particles);
  REQUIRE(contacts.size() == 1);
  const double whole = contacts[0].state.forces.normal;
  const SurfaceStress on_vertex = stresses_of(s)[0];
  double sum = 0.;
  for (std::size_t t = 0; t < 12; ++t)
  {
    // Each side of the cube has a right angle at the corner, in one triangle or in two halves.
    const Triangle &corners = box.topology.triangle[t];
    const auto at = std::find(corners.begin(), corners.end(), corner) - corners.begin();
    const double part = on_vertex.pressure[t] * area_of(box, t) / whole;
    sum += part;
    if (at == 3)
    {
      CHECK(part == 0.);
      continue;
    }
    const Vec3 a = box.node[corners[(at + 1) % 3]] - box.node[corner],
               b = box.node[corners[(at + 2) % 3]] - box.node[corner];
    CHECK(part == Approx(a.normalized().dot(b.normalized()) > 0.5 ? 1. / 6. : 1. / 3.).epsilon(1e-12));
  }
  CHECK(sum == Approx(1.).epsilon(1e-12));
}

TEST_CASE("stresses add up to the forces on the nodes, at valleys and in sliding, too")
{
  const dem::Surface valley = in_millimetres(ridge(-0.02)), plane = flat_square(Vec3(20., 0., 0.));
  for (const bool is_in_valley : {true, false})
  {
    const Vec3 foot = is_in_valley ? Vec3(0., 1. * mm, 0.) : Vec3(22.5 * mm, 1.2 * mm, 0.);
    const Simulation s = with_ball({valley, plane}, foot + Vec3(0., 0., radius - overlap),
                                   Vec3(0.01, 0.1, is_in_valley ? -0.02 : -0.01));
    const std::vector<SurfaceStress> stress = stresses_of(s);
    REQUIRE(stress.size() == 2);
    const std::size_t touched = is_in_valley ? 0 : 1;
    if (is_in_valley)
      CHECK(s.contacts.touching_walls(s.particles).size() == 3); // two faces and the edge against them
    const Sums sums = sums_of(s.surfaces[touched], stress[touched]);
    const Vec3 force = s.surface_loads()[touched].force;
    CHECK(force.norm() > 0.);
    CHECK((sums.force - force).norm() < 1e-12 * force.norm());
    CHECK(sums_of(s.surfaces[1 - touched], stress[1 - touched]).normal == 0.);
    if (!is_in_valley) // Coulomb's law
      for (std::size_t t = 0; t < stress[1].pressure.size(); ++t)
        if (stress[1].pressure[t] > 0.)
        {
          CHECK(stress[1].shear_stress[t] == Approx(0.3 * stress[1].pressure[t]).epsilon(1e-6));
          CHECK(stress[1].traction[t].y() > 0.); // dragged along
        }
  }
}

TEST_CASE("friction wears each triangle by its coefficient times weight times the way over it")
{
  constexpr double friction = 0.01, speed = 0.5, way = 3.2 * mm, y = 0.9 * mm;
  const dem::Surface plane = flat_square();
  SimulationParameters p;
  p.grain() = p.wall() = {1e8, 0.3, 2650.};
  p.between_grains().friction = p.with_walls().friction = friction;
  p.set_damping(0.5);
  p.gravity = Vec3(0., 0., -9.81);
  p.time_step = 2e-6;
  Particles grains;
  grains.add({Vec3::Constant(radius), 1., 1.}, 2650., Vec3(0.4 * mm, y, radius - 1e-3 * overlap),
             Quaternion::Identity());
  Simulation s(p, grains, {});
  s.add_surface(plane);
  for (int n = 0; n < 5000; ++n) // at rest
    s.step();
  s.reset_accounts();
  s.particles.velocity[0] = Vec3(speed, 0., 0.);
  const double begin = s.particles.position[0].x();
  while (s.particles.position[0].x() < begin + way)
    s.step();

  std::vector<double> length(plane.topology.n_faces(), 0.); // of the way over each triangle
  constexpr int n_points = 10000;
  for (int n = 0; n < n_points; ++n)
  {
    const Vec3 x(begin + way * (n + 0.5) / n_points, y, 0.);
    for (std::size_t t = 0; t < length.size(); ++t)
    {
      const auto &[a, b, c] = plane.topology.triangle[t];
      const auto is_left = [&](const std::int32_t from, const std::int32_t to)
      { return (plane.node[to] - plane.node[from]).cross(x - plane.node[from]).z() > 0.; };
      length[t] += is_left(a, b) && is_left(b, c) && is_left(c, a) ? way / n_points : 0.;
    }
  }
  const std::vector<double> work = s.contacts.friction_work(plane.n_features());
  const SurfaceStress stress = surface_stress(s.surfaces, s.contacts.touching_walls(s.particles), work)[0];
  const double weight = s.particles.mass[0] * 9.81;
  int n_crossed = 0;
  for (std::size_t t = 0; t < length.size(); ++t)
  {
    CAPTURE(t, length[t]);
    // It slows down and begins to roll by friction g t / speed of its way, some thousandths.
    CHECK(stress.friction_work[t] * area_of(plane, t) ==
          Approx(friction * weight * length[t]).epsilon(0.005).margin(1e-3 * friction * weight * way));
    n_crossed += length[t] > 0.1 * way;
  }
  CHECK(n_crossed >= 3);
  // All of it, with what contacts have lost in their ends.
  CHECK(std::accumulate(work.begin(), work.end(), 0.) == Approx(s.energy().friction_loss).epsilon(1e-12));
}

TEST_CASE("surfaces are written with their stresses and read again")
{
  const TemporaryFolder folder;
  std::mt19937_64 random(8);
  const dem::Surface hills = in_millimetres(grid_surface(
      6, [](const double x, const double y) { return 0.3 * std::sin(x + 0.5 * y); }, 0.2, random));
  const dem::Surface box = in_millimetres(cube());
  Simulation s = with_ball({hills, box}, Vec3(3.2 * mm, 3.1 * mm, 0.68 * mm), Vec3(0.05, 0., -1.));
  s.surfaces[1].drift_velocity.assign(8, Vec3::Zero());
  s.surfaces[1].drift_velocity[3] = Vec3(1., 2., 3.);
  const std::vector<SurfaceStress> stress = stresses_of(s);
  write_surfaces_vtu(s.surfaces, stress, folder / "surfaces.vtu");
  write_surfaces_vtu({&s.surfaces[1], 1}, {&stress[1], 1}, folder / "box.vtu");

  const VtuReader file(content_of(folder / "surfaces.vtu"));
  const std::size_t n_hills = hills.topology.n_faces(), m_hills = hills.topology.n_nodes();
  REQUIRE(file.n_cells == n_hills + 12);
  REQUIRE(file.n_points == m_hills + 8);
  const auto pressure = file.array<float>("pressure"), shear = file.array<float>("shear_stress"),
             traction = file.array<float>("traction"), wear = file.array<float>("friction_work"),
             velocity = file.array<float>("velocity");
  const auto number = file.array<std::int32_t>("surface");
  REQUIRE(traction.size() == 3 * file.n_cells);
  REQUIRE(velocity.size() == 3 * file.n_points);
  double highest = 0., most_worn = 0.;
  for (std::size_t t = 0; t < file.n_cells; ++t)
  {
    const std::size_t of = t < n_hills ? 0 : 1, k = t - (of == 1 ? n_hills : 0);
    REQUIRE(number[t] == static_cast<std::int32_t>(of));
    CHECK(pressure[t] == static_cast<float>(stress[of].pressure[k]));
    CHECK(shear[t] == static_cast<float>(stress[of].shear_stress[k]));
    CHECK(traction[3 * t + 2] == static_cast<float>(stress[of].traction[k].z()));
    CHECK(wear[t] == static_cast<float>(stress[of].friction_work[k]));
    highest = std::max<double>(highest, pressure[t]);
    most_worn = std::max<double>(most_worn, wear[t]);
  }
  CHECK(highest > 0.);
  CHECK(most_worn > 0.);
  CHECK(velocity[3 * (m_hills + 3) + 1] == 2.f);
  CHECK(velocity[1] == 0.f); // at rest

  // Both are one surface of two parts to the reader, to the last bit.
  const dem::Surface both = read_surface(folder / "surfaces.vtu");
  REQUIRE(both.topology.n_faces() == file.n_cells);
  REQUIRE(both.topology.n_nodes() == file.n_points);
  for (std::size_t n = 0; n < m_hills; ++n)
    CHECK(both.node[n] == s.surfaces[0].node[n]);
  const dem::Surface again = read_surface(folder / "box.vtu", {.use = SurfaceUse::body});
  CHECK(again.topology.triangle == box.topology.triangle);
  CHECK(again.node == s.surfaces[1].node);
}

TEST_CASE("mistakes in writing surfaces are named")
{
  const TemporaryFolder folder;
  const std::vector<dem::Surface> surfaces{in_millimetres(cube())};
  std::vector<SurfaceStress> stress = surface_stress(surfaces, {});
  CHECK_THROWS_WITH(write_surfaces_vtu(surfaces, {}, folder / "a.vtu"), Contains("stresses of surfaces is 0"));
  CHECK_THROWS_AS(write_surfaces_vtu(surfaces, stress, folder / "none/a.vtu"), RunError);
  stress[0].pressure.pop_back();
  CHECK_THROWS_WITH(write_surfaces_vtu(surfaces, stress, folder / "a.vtu"),
                    Contains("surface 0 is 11") && Contains("12"));
  CHECK(std::filesystem::is_empty(folder.path()));
  // No surfaces make a file without cells.
  write_surfaces_vtu({}, {}, folder / "none.vtu");
  CHECK(VtuReader(content_of(folder / "none.vtu")).n_cells == 0);
}
