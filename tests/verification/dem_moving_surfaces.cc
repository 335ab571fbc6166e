// Grains on surfaces that turn, and among many triangles, beside closed forms and planes.

#include "dem/motion/surface_path.h"
#include "dem/simulation/simulation.h"

#include "tests/surfaces.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

using namespace bergamo;
using namespace bergamo::dem;
using bergamo::dem::test::soft_grains;

namespace
{

constexpr double mm = 1e-3, gravity = 9.81, pi = std::numbers::pi;

/// Inside of a cylinder along y about the origin, of n facets that touch its radius from inside and outside alike.
Surface drum(const double radius, const double length, const int n)
{
  const double corner = radius * 2. / (1. + std::cos(pi / n));
  std::vector<Vec3> nodes;
  std::vector<Triangle> triangles;
  for (int k = 0; k < n; ++k)
    for (const double y : {-0.5 * length, 0.5 * length})
      nodes.emplace_back(corner * std::cos(2. * pi * k / n), y, corner * std::sin(2. * pi * k / n));
  for (int k = 0; k < n; ++k)
  {
    const std::int32_t a = 2 * k, b = a + 1, c = 2 * ((k + 1) % n), d = c + 1;
    triangles.insert(triangles.end(), {{a, c, b}, {b, c, d}}); // normals towards the axis
  }
  return {nodes, triangles};
}

/// Angle of the centre of a sphere that rolls in a drum from rest at an angle, over the pendulum's of length 7/5 of the
/// distance of the axis: the largest difference in the first swing [rad].
double error_in_drum(const int n_facets, const double spin)
{
  const double radius = 10. * mm, grain_radius = mm, distance = radius - grain_radius, start = 0.5;
  SimulationParameters p = soft_grains(1., 0.7);
  Particles grains;
  const Superquadric sphere{Vec3::Constant(grain_radius), 1., 1.};
  grains.add(sphere, 2650., Vec3(std::sin(start), 0., -std::cos(start)) * distance, Quaternion::Identity());
  // Rolls on the turning wall: its surface has the wall's velocity at the contact.
  grains.angular_momentum[0] = grains.inertia[0].cwiseProduct(Vec3(0., spin * radius / grain_radius, 0.));
  Simulation s(p, grains, {});
  s.add_surface(drum(radius, 6. * mm, n_facets));
  const SurfacePath path(s.surfaces[0], Vec3::Zero(),
                         [&](const double time) {
                           return SurfacePlacement{Vec3::Zero(), Vec3(0., spin * time, 0.)};
                         });
  double angle = start, rate = 0., worst = 0.; // the pendulum, by the leapfrog in the same steps
  const double omega_square = gravity / (1.4 * distance);
  const int n_steps = static_cast<int>(2. * pi / std::sqrt(omega_square) / p.time_step);
  for (int n = 0; n < n_steps; ++n)
  {
    s.step();
    path.move(s.surfaces[0], s.time, p.time_step);
    rate -= (n == 0 ? 0.5 : 1.) * p.time_step * omega_square * std::sin(angle);
    angle += p.time_step * rate;
    const Vec3 &x = s.particles.position[0];
    worst = std::max(worst, std::abs(std::atan2(x[0], -x[2]) - angle));
  }
  return worst;
}

} // namespace

TEST_CASE("a sphere in a turning drum of triangles swings as the pendulum of 7/5 of its distance")
{
  // At any constant spin of the drum: what rolls has the same equation, (7/5) (R - r) angle'' = -g sin angle. The
  // polygon's slope is wrong by up to pi / n, its height by a share of (pi / n)^2 / 8.
  for (const double spin : {0., -8., 8.})
  {
    const double coarse = error_in_drum(60, spin), fine = error_in_drum(240, spin);
    CAPTURE(spin, coarse, fine);
    CHECK(coarse < 0.05);
    CHECK(fine < 0.4 * coarse);
  }
}

namespace
{

/// Inside of a cube about the origin, of 2 n^2 triangles a side.
Surface cube_inside(const double edge, const int n)
{
  std::vector<Vec3> nodes;
  std::vector<Triangle> triangles;
  std::map<std::array<int, 3>, std::int32_t> node_at;
  const auto node = [&](const int axis, const std::array<int, 3> &place)
  {
    std::array<int, 3> at{};
    for (int k = 0; k < 3; ++k)
      at[(axis + k) % 3] = place[k];
    const auto [found, is_new] = node_at.try_emplace(at, static_cast<std::int32_t>(nodes.size()));
    if (is_new)
      nodes.push_back(edge * (Vec3(at[0], at[1], at[2]) / n - Vec3::Constant(0.5)));
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
        {
          std::int32_t a = node(axis, {side, i, j}), b = node(axis, {side, i + 1, j}),
                       c = node(axis, {side, i + 1, j + 1}), d = node(axis, {side, i, j + 1});
          if (side == n) // normals inwards
            std::swap(b, d);
          triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        }
  return {nodes, triangles};
}

std::vector<PlaneWall> cube_of_planes(const double edge)
{
  std::vector<PlaneWall> walls;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1., 1.})
    {
      walls.emplace_back();
      walls.back().normal = -side * Vec3::Unit(axis);
      walls.back().point = 0.5 * edge * side * Vec3::Unit(axis);
    }
  return walls;
}

/// Rebounds of grains in a box of planes, and beside each the same rebound in a box of triangles: how far they end from
/// one another, and what both lose. Each grain flies alone, spins, bounces obliquely and rubs; both boxes begin each
/// rebound with the grain of the planes, because every one magnifies rounding by some ten.
struct Rebounds
{
  double farthest = 0., farthest_turn = 0.;              ///< [m], of a unit quaternion
  double energy_at_first = 0., energy_at_last = 0.;      ///< kinetic, as the first and the last one begin [J]
  int n_steps_apart = 0;                                 ///< in which one touches and the other does not
  std::array<double, 2> friction_loss{}, viscous_loss{}; ///< by box [J]
};

Rebounds rebounds(const int n_grains, const int n_rebounds)
{
  const Threads one_thread(1);
  const double edge = 10. * mm;
  SimulationParameters p = soft_grains(0.05, 0.001);
  p.gravity.setZero();
  p.contact.overlap_tolerance = 0.; // all contacts are searched every step, as those on edges always are
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1., 1.);
  const Surface triangles = cube_inside(edge, 10);
  REQUIRE(triangles.topology.n_faces() == 1200);
  REQUIRE(triangles.topology.is_closed());
  Rebounds found;
  for (int k = 0; k < n_grains; ++k)
  {
    Particles grains;
    const Superquadric shape{Vec3(1.2 + 0.2 * unit(random), 1., 0.9 + 0.1 * unit(random)) * mm,
                             0.9 + 0.1 * unit(random), 0.9 + 0.1 * unit(random)};
    grains.add(shape, 2650., Vec3(unit(random), unit(random), unit(random)) * mm,
               Quaternion(Eigen::AngleAxisd(pi * unit(random), Vec3(unit(random), unit(random), 1.).normalized())));
    grains.velocity[0] = Vec3(unit(random), unit(random), unit(random));
    grains.angular_momentum[0] = grains.inertia[0].cwiseProduct(100. * Vec3(unit(random), unit(random), unit(random)));
    for (int n = 0; n < n_rebounds; ++n)
    {
      Simulation box[2]{Simulation(p, grains, cube_of_planes(edge)), Simulation(p, grains, {})};
      box[1].add_surface(triangles);
      if (n == 0)
        found.energy_at_first += box[0].energy().kinetic;
      if (n + 1 == n_rebounds)
        found.energy_at_last += box[0].energy().kinetic;
      for (bool has_touched = false, is_over = false; !is_over;)
      {
        for (Simulation &of : box)
          of.step();
        const int now = box[0].contacts.n_touching_walls();
        found.n_steps_apart += (box[1].contacts.n_touching_walls() > 0) != (now > 0);
        is_over = has_touched && now == 0;
        has_touched |= now > 0;
      }
      grains = box[0].particles;
      const Particles &other = box[1].particles;
      found.farthest = std::max(found.farthest, (grains.position[0] - other.position[0]).norm());
      found.farthest_turn =
          std::max(found.farthest_turn, (grains.orientation[0].coeffs() - other.orientation[0].coeffs()).norm());
      for (int b = 0; b < 2; ++b)
      {
        found.friction_loss[b] += box[b].energy().friction_loss;
        found.viscous_loss[b] += box[b].energy().viscous_loss;
      }
    }
  }
  return found;
}

void check_same(const Rebounds &r)
{
  CAPTURE(r.farthest / (1e-12 * mm), r.farthest_turn / 1e-12, r.energy_at_first, r.energy_at_last, r.friction_loss,
          r.viscous_loss);
  CHECK(r.n_steps_apart == 0);
  CHECK(r.farthest < 1e-11 * mm);
  CHECK(r.farthest_turn < 1e-11);
  CHECK(r.energy_at_last > 0.01 * r.energy_at_first); // still a rebound
  CHECK(r.friction_loss[0] > 0.1 * r.energy_at_first);
  CHECK(r.friction_loss[1] == Approx(r.friction_loss[0]).epsilon(1e-9));
  CHECK(r.viscous_loss[1] == Approx(r.viscous_loss[0]).epsilon(1e-9));
}

} // namespace

TEST_CASE("a box of 1200 triangles lets a grain rebound as a box of planes does")
{
  check_same(rebounds(3, 50));
}

TEST_CASE("a box of 1200 triangles lets 100 grains rebound 50 times as a box of planes does", "[.][long]")
{
  check_same(rebounds(100, 50));
}

TEST_CASE("what is too deep in a moving surface to be touched is touched again once it has come off")
{
  // A plate goes up into a grain that hardly moves, deeper than it is touched, and back; a wall of the same surface
  // beside the grain, if there, is touched all the while, and hardly.
  const bool has_wall = GENERATE(false, true);
  const double radius = mm, speed = 10., wall = -0.99 * radius;
  SimulationParameters p = soft_grains(0., 0.);
  p.gravity.setZero();
  Particles grains;
  grains.add({Vec3::Constant(radius), 1., 1.}, 1e12, Vec3(0., 0., 1.001 * radius), Quaternion::Identity());
  Simulation s(p, grains, {});
  std::vector<Vec3> nodes{Vec3(-5., -5., 0.) * mm, Vec3(5., -5., 0.) * mm, Vec3(5., 5., 0.) * mm,
                          Vec3(-5., 5., 0.) * mm};
  std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
  if (has_wall)
  {
    nodes.insert(nodes.end(), {Vec3(wall, -5. * mm, 5. * mm), Vec3(wall, -5. * mm, -5. * mm), Vec3(wall, 5. * mm, 0.)});
    triangles.push_back({4, 5, 6});
  }
  s.add_surface({nodes, triangles});
  int n_in = 0, n_out = 0; // steps that touch the plate, on either way
  bool comes_back = false;
  for (double overlap = -0.001; overlap > -0.01;)
  {
    comes_back = comes_back || overlap > 0.7;
    s.surfaces[0].velocity.assign(nodes.size(), Vec3::Zero());
    std::fill_n(s.surfaces[0].velocity.begin(), 4, Vec3(0., 0., comes_back ? -speed : speed));
    s.step();
    CAPTURE(overlap, comes_back, has_wall);
    const bool is_touched = s.contacts.n_touching_walls() > has_wall;
    CHECK(is_touched == (overlap > 0. && overlap <= (comes_back ? deepest_begin : deepest_overlap)));
    (comes_back ? n_out : n_in) += is_touched;
    overlap = 1. - (s.particles.position[0][2] - s.surfaces[0].node[0][2]) / radius;
  }
  CHECK(n_in > 20);
  CHECK(n_out > 3);
}
