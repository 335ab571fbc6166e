#include "dem/core/error.h"
#include "dem/packing/distribution.h"
#include "dem/packing/overlap.h"
#include "dem/packing/pack_grains.h"
#include "dem/packing/space.h"
#include "dem/packing/tightening.h"
#include "dem/simulation/simulation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double pi = std::numbers::pi;

/// Of all points of the surface on a grid of angles, the furthest from the axis through the origin.
double sampled_reach(const Superquadric &shape, const Vec3 &position, const Quaternion &orientation, const int n)
{
  double furthest = 0.;
  for (int j = -n; j <= n; ++j)
    for (int k = -n; k < n; ++k)
      furthest = std::max(
          furthest, (position + orientation * surface_point(shape, 0.5 * pi * j / n, pi * k / n)).head<2>().norm());
  return furthest;
}

} // namespace

TEST_CASE("reach of a grain from the axis of a cylinder")
{
  SECTION("a sphere reaches its distance and its radius")
  {
    const Superquadric sphere{Vec3::Constant(0.4), 1., 1.};
    for (const Vec3 &x : {Vec3(1.5, -0.7, 3.), Vec3(0.1, 0., 0.), Vec3(0., 0., 1.)})
    {
      const RadialReach r = radial_reach(make_pose(sphere, x, Quaternion::Identity()), Vec3::Zero());
      CHECK(r.reach == Approx(x.head<2>().norm() + 0.4).epsilon(1e-8));
      CHECK(r.bound >= x.head<2>().norm() + 0.4 - 1e-15);
      CHECK(r.bound <= r.reach * (1. + 1e-8));
    }
  }
  SECTION("the bound holds for every point of the surface and is sharp")
  {
    // A grid of 200 angles a quarter misses the furthest point of these surfaces by a share of (pi/400)^2 of the
    // radius of curvature at most where they are smooth, by less than 1 % of the grain at the edges of a box.
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(0., 1.);
    for (int n = 0; n < 40; ++n)
    {
      const Superquadric grain{Vec3(0.3 + uniform(generator), 0.3 + uniform(generator), 0.3 + uniform(generator)),
                               0.3 + 1.4 * uniform(generator), 0.3 + 1.4 * uniform(generator)};
      const Vec3 x(3. * uniform(generator), 3. * uniform(generator), 0.);
      const Quaternion q = draw_orientation(generator);
      const RadialReach r = radial_reach(make_pose(grain, x, q), Vec3::Zero());
      const double sampled = sampled_reach(grain, x, q, 200);
      CHECK(r.bound >= sampled * (1. - 1e-14));
      CHECK(r.bound - sampled < 0.01 * bounding_radius(grain));
      CHECK(r.bound <= r.reach * (1. + 1e-8));
    }
  }
  SECTION("a cylinder holds a grain up to its wall")
  {
    const PackingSpace space = PackingSpace::cylinder(Vec3(1., 2., 3.), 2., 5.);
    CHECK(space.volume() == Approx(pi * 4. * 5.));
    const Superquadric sphere{Vec3::Constant(0.5), 1., 1.};
    const auto holds = [&](const Vec3 &x) { return space.contains(make_pose(sphere, x, Quaternion::Identity()), 0.5); };
    CHECK(holds(Vec3(1., 2., 5.)));
    CHECK(holds(Vec3(1. + 1.4999999, 2., 5.)));
    CHECK_FALSE(holds(Vec3(1. + 1.5000001, 2., 5.)));
    CHECK_FALSE(holds(Vec3(1. - 1.1, 2. - 1.1, 5.)));
    CHECK_FALSE(holds(Vec3(1., 2., 3.4999)));
    CHECK_FALSE(holds(Vec3(1., 2., 7.5001)));
  }
}

TEST_CASE("polyhedra between planes")
{
  SECTION("a corner of a cube, with normals of any length and a repeated and a useless plane")
  {
    const PackingSpace space = PackingSpace::polyhedron({{Vec3(-1., 0., 0.), 0.},
                                                         {Vec3(0., -2., 0.), 0.},
                                                         {Vec3(0., 0., -1.), 0.},
                                                         {Vec3(3., 3., 3.), 3.},
                                                         {Vec3(1., 1., 1.), 1.},
                                                         {Vec3(1., 0., 0.), 7.}});
    CHECK(space.volume() == Approx(1. / 6.).epsilon(1e-12));
    CHECK(space.bounds().low.norm() < 1e-12);
    CHECK((space.bounds().high - Vec3::Ones()).norm() < 1e-12);
    const Superquadric small{Vec3::Constant(0.1), 1., 1.};
    const double touching = (1. - 0.1 * std::sqrt(3.)) / 3.; // (t, t, t) is 0.1 below the plane x + y + z = 1
    const auto holds = [&](const double t)
    { return space.contains(make_pose(small, Vec3::Constant(t), Quaternion::Identity()), 0.1); };
    CHECK(holds(touching - 1e-9));
    CHECK_FALSE(holds(touching + 1e-9));
    CHECK(holds(0.1 + 1e-9));
    CHECK_FALSE(holds(0.1 - 1e-9));
  }
  SECTION("a six-sided prism")
  {
    std::vector<HalfSpace> planes{{Vec3::UnitZ(), 2.}, {-Vec3::UnitZ(), 1.}};
    for (int k = 0; k < 6; ++k)
      planes.push_back({Vec3(std::cos(pi * k / 3.), std::sin(pi * k / 3.), 0.), 1.});
    CHECK(PackingSpace::polyhedron(planes).volume() == Approx(3. * 2. * std::sqrt(3.)).epsilon(1e-12));
  }
  SECTION("what does not close is refused")
  {
    std::vector<HalfSpace> planes{
        {-Vec3::UnitX(), 0.}, {-Vec3::UnitY(), 0.}, {Vec3::UnitX(), 1.}, {Vec3::UnitY(), 1.}, {-Vec3::UnitZ(), 0.}};
    CHECK_THROWS_WITH(PackingSpace::polyhedron(planes), Catch::Contains("leave the body open"));
    planes.push_back({Vec3(1., 1., 1.).normalized(), 0.5});
    CHECK_NOTHROW(PackingSpace::polyhedron(planes));
    planes = {{-Vec3::UnitX(), 0.},
              {Vec3(1., 0., -0.1), 1.},
              {-Vec3::UnitY(), 0.},
              {Vec3(0., 1., -0.1), 1.},
              {-Vec3::UnitZ(), 0.}};
    CHECK_THROWS_AS(PackingSpace::polyhedron(planes), ConfigError); // a funnel, open at the top
    planes.push_back({Vec3::UnitZ(), -1.});                         // nothing is below and above
    CHECK_THROWS_AS(PackingSpace::polyhedron(planes), ConfigError);
  }
}

TEST_CASE("a periodic box")
{
  const PackingSpace space = PackingSpace::periodic({Vec3(-1., 0., 2.), Vec3(1., 3., 6.)});
  CHECK(space.volume() == Approx(24.));
  CHECK((space.wrap(Vec3(1.5, -0.25, 10.5)) - Vec3(-0.5, 2.75, 2.5)).norm() < 1e-14);
  CHECK((space.nearest_image(Vec3(1.9, -2., 2.1)) - Vec3(-0.1, 1., -1.9)).norm() < 1e-14);
  CHECK(space.wrap(Vec3(-1. - 1e-17, 3., 2.)) == Vec3(-1., 0., 2.));
  CHECK_NOTHROW(space.require_range(0.99));
  CHECK_THROWS_WITH(space.require_range(1.),
                    Catch::Contains("along x is 2 m") && Catch::Contains("1 m") && Catch::Contains("larger box"));
  CHECK_NOTHROW(PackingSpace(Box{Vec3::Zero(), Vec3::Ones()}).require_range(1.));
  CHECK_THROWS_WITH(PackingSpace::periodic({Vec3::Zero(), Vec3(1., -1., 1.)}), Catch::Contains("along y is -1"));
}

TEST_CASE("a box that repeats in some directions has walls across the others")
{
  const PackingSpace space = PackingSpace::periodic({Vec3(-1., 0., 2.), Vec3(1., 3., 6.)}, {true, false, true});
  CHECK(space.is_periodic());
  CHECK(space.is_periodic(0));
  CHECK_FALSE(space.is_periodic(1));
  REQUIRE(space.walls().size() == 2);
  for (const HalfSpace &wall : space.walls())
    CHECK(std::abs(wall.normal[1]) == 1.);
  CHECK((space.wrap(Vec3(1.5, -0.25, 10.5)) - Vec3(-0.5, -0.25, 2.5)).norm() < 1e-14);
  CHECK((space.nearest_image(Vec3(1.9, -2., 2.1)) - Vec3(-0.1, -2., -1.9)).norm() < 1e-14);
  CHECK_THROWS_WITH(space.require_range(1.), Catch::Contains("along x is 2 m"));
  const PackingSpace narrow = PackingSpace::periodic({Vec3::Zero(), Vec3(8., 1., 8.)}, {true, false, true});
  CHECK_NOTHROW(narrow.require_range(2.));
  const std::vector<Superquadric> wide(1, {Vec3::Constant(0.6), 1., 1.});
  CHECK_THROWS_WITH(place_at_random(wide, narrow, 1), Catch::Contains("is 1 m"));

  // Grains reach out of the faces that repeat, as their images reach in, and meet nothing there.
  PackingParameters packing;
  packing.solid_fraction = 0.5;
  const Box box{Vec3::Zero(), Vec3(5e-3, 4e-3, 6e-3)};
  const PackedGrains packed =
      pack_grains(GrainDistribution(), PackingSpace::periodic(box, {true, false, true}), packing, 5);
  CHECK(packed.report.has_reached_target);
  Particles grains = packed.particles;
  bool reaches_out = false, stays_in = true;
  for (std::size_t i = 0; i < grains.size(); ++i)
  {
    const BodyPose pose = make_pose(grains.parts.shape[i], grains.position[i], grains.orientation[i]);
    reaches_out = reaches_out || pose.position[0] + support(pose, Vec3::UnitX()).height > box.high[0];
    stays_in = stays_in && pose.position[1] + support(pose, Vec3::UnitY()).height <= box.high[1] &&
               pose.position[1] >= support(pose, -Vec3::UnitY()).height;
  }
  CHECK(reaches_out);
  CHECK(stays_in);
  grains.cell = PeriodicCell(Vec3(box.high[0], std::numeric_limits<double>::infinity(), box.high[2]));
  SimulationParameters still;
  still.time_step = 1e-9;
  Simulation s(still, grains, {});
  s.compute_forces();
  CHECK(s.contacts.n_candidates() > 0);
  CHECK(s.contacts.n_touching() == 0);
}

TEST_CASE("the largest sphere inside a grain")
{
  // The distance of the nearest point of the surface, sampled on a grid: never below, and above by less than 1 %.
  for (const double eps1 : {0.3, 1., 1.7})
    for (const double eps2 : {0.3, 1., 1.7})
    {
      const Superquadric grain{Vec3(0.5, 1., 0.8), eps1, eps2};
      double nearest = 10.;
      for (int j = -400; j <= 400; ++j)
        for (int k = -400; k < 400; ++k)
          nearest = std::min(nearest, surface_point(grain, 0.5 * pi * j / 400, pi * k / 400).norm());
      CAPTURE(eps1, eps2);
      CHECK(inscribed_radius(grain) <= nearest * (1. + 1e-12));
      CHECK(inscribed_radius(grain) > 0.99 * nearest);
    }
  CHECK(inscribed_radius({Vec3::Constant(2.), 1., 1.}) == Approx(2.).epsilon(1e-14));
}

TEST_CASE("spaces and packings that are no numbers are refused, and searches of such grains end")
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const double wrong : {nan, infinite, -infinite})
  {
    CAPTURE(wrong);
    for (int d = 0; d < 3; ++d)
    {
      const Vec3 place = Vec3::Zero() + wrong * Vec3::Unit(d);
      Vec3 corner = Vec3::Zero();
      corner[d] = wrong;
      CHECK_THROWS_AS(PackingSpace(Box{corner, Vec3::Ones()}), ConfigError);
      CHECK_THROWS_AS(PackingSpace::periodic({Vec3::Zero(), corner}), ConfigError);
      CHECK_THROWS_WITH(PackingSpace::cylinder(corner, 1., 1.), Catch::Contains("base of the packing's cylinder"));
      CHECK_FALSE(PackingSpace::cylinder(Vec3::Zero(), 1., 1.)
                      .contains(make_pose({Vec3::Constant(0.1), 0.5, 0.5}, place, Quaternion::Identity()), 0.2));
    }
    CHECK_THROWS_AS(PackingSpace::cylinder(Vec3::Zero(), wrong, 1.), ConfigError);
    CHECK_THROWS_AS(PackingSpace::cylinder(Vec3::Zero(), 1., wrong), ConfigError);
    const std::vector<Superquadric> grains(1, {Vec3(0.1, 0.1, wrong), 1., 1.}), whole(1, {Vec3::Constant(0.1), 1., 1.});
    const PackingSpace space(Box{Vec3::Zero(), Vec3::Ones()});
    CHECK_THROWS_WITH(place_at_random(grains, space, 1), Catch::Contains("half-axis"));
    CHECK_THROWS_WITH(add_at_random(whole, space, wrong, 1), Catch::Contains("density"));

    const Vec3 middle = Vec3::Constant(0.5);
    const auto tightened = [&](const LoosePacking &start) { return tighten(whole, space, start, {}, 1); };
    CHECK_THROWS_WITH(tightened({{{middle}, {Quaternion::Identity()}}, wrong}), Catch::Contains("loose packing"));
    CHECK_THROWS_WITH(tightened({{{wrong * middle}, {Quaternion::Identity()}}, 0.5}), Catch::Contains("place"));
    CHECK_THROWS_WITH(tightened({{{middle}, {Quaternion(wrong, 0., 0., 0.)}}, 0.5}), Catch::Contains("orientation"));
    CHECK_THROWS_WITH(tightened({{{middle, middle}, {Quaternion::Identity()}}, 0.5}), Catch::Contains("is 2"));
  }
  // The halving of angles would go on to the last one for what is no number.
  const BodyPose nowhere = make_pose({Vec3::Constant(0.1), 0.5, 0.5}, Vec3(nan, 0., 0.), Quaternion::Identity());
  CHECK_FALSE(radial_reach(nowhere, Vec3::Zero()).bound > 0.);
}
