#include "tests/surfaces.h"

#include "dem/core/error.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace bergamo;
using namespace bergamo::dem;
using namespace bergamo::dem::test;

namespace
{

/// Energy of all places as Hertz's, without its constant, and the force on the body.
struct Response
{
  double energy = 0.;
  Vec3 force = Vec3::Zero();
};

Response response(const BodyPose &body, const Surface &surface, const std::vector<std::int32_t> &faces)
{
  Response r;
  for (const SurfacePlace &p : find_surface_places(body, surface.view(), faces))
  {
    r.energy += p.index * std::pow(p.overlap, 2.5);
    r.force += p.index * 2.5 * std::pow(p.overlap, 1.5) * p.normal;
  }
  return r;
}

Superquadric sphere(const double radius)
{
  Superquadric s;
  s.half_axes.setConstant(radius);
  return s;
}

BodyPose placed(const Superquadric &shape, const Vec3 &position, std::mt19937_64 &random)
{
  return make_pose(shape, position, draw_orientation(random));
}

/// Divergence and curl of the force on a body over the places of its centre, by central differences [force/length].
struct FieldRates
{
  double divergence, curl;
};

FieldRates rates_of_field(BodyPose body, const Surface &surface, const std::vector<std::int32_t> &faces)
{
  constexpr double step = 1e-6;
  const Vec3 centre = body.position;
  Mat3 gradient;
  for (int k = 0; k < 3; ++k)
  {
    Vec3 force[2];
    for (const int side : {0, 1})
    {
      body.position = centre + (side ? step : -step) * Vec3::Unit(k);
      force[side] = response(body, surface, faces).force;
    }
    gradient.col(k) = (force[1] - force[0]) / (2. * step);
  }
  const Mat3 turning = gradient - gradient.transpose();
  return {gradient.trace(), Vec3(turning(2, 1), turning(0, 2), turning(1, 0)).norm()};
}

} // namespace

TEST_CASE("a surface knows its neighbours", "[surface]")
{
  const Surface closed = cube();
  REQUIRE(closed.topology.is_closed());
  REQUIRE(closed.topology.n_edges() == 18);
  for (std::int32_t node = 0; node < 8; ++node)
    REQUIRE(closed.topology.corners_of(node).size() == closed.topology.edges_of(node).size());
  std::mt19937_64 random(1);
  const Surface open = grid_surface(
      3, [](double, double) { return 0.; }, 0., random);
  REQUIRE(!open.topology.is_closed());
  REQUIRE(open.topology.n_nodes() + open.topology.n_faces() == open.topology.n_edges() + 1); // Euler
}

TEST_CASE("surfaces that are none are refused by triangle and node", "[surface]")
{
  using Catch::Contains;
  const auto make = [](std::vector<Triangle> t) { return SurfaceTopology(std::move(t), 5); };
  REQUIRE_THROWS_WITH(make({{0, 1, 5}}), Contains("triangle 0") && Contains("node 5"));
  REQUIRE_THROWS_WITH(make({{0, 1, 2}, {1, 3, 3}}), Contains("triangle 1") && Contains("node 3 twice"));
  REQUIRE_THROWS_WITH(make({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), Contains("0, 1 and 2") && Contains("two triangles"));
  REQUIRE_THROWS_WITH(make({{0, 1, 2}, {0, 1, 3}}), Contains("turn one of them around"));
  REQUIRE_THROWS_WITH(make({{0, 1, 2}, {0, 3, 4}}), Contains("node 0") && Contains("hang together"));
  REQUIRE_NOTHROW(make({{0, 1, 2}, {1, 0, 3}, {3, 0, 4}}));
}

TEST_CASE("triangles of one plane are one plane", "[surface]")
{
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0., 1.);
  const Surface flat = grid_surface(
      12, [](double, double) { return 0.; }, 0.4, random);
  const std::vector<std::int32_t> faces = flat.all_faces();
  for (int k = 0; k < 2000; ++k)
  {
    // The plane turned and moved, so that nodes lie in it to rounding alone.
    const Mat3 turn = draw_orientation(random).toRotationMatrix();
    Surface surface = flat;
    for (Vec3 &x : surface.node)
      x = turn * x;
    BodyPose body = placed(random_grain(random), Vec3::Zero(), random);
    const Vec3 normal = turn.col(2);
    const PlacedSupport<double> s = support(body, -normal);
    const double overlap = s.height * std::pow(10., -1. - 4. * unit(random));
    // Deepest above the plane's inner part; in a third of the cases on a node or on the line to its neighbour.
    Vec3 foot = turn * Vec3(3. + 6. * unit(random), 3. + 6. * unit(random), 0.);
    const std::size_t node = 13 * (3 + k % 7) + 3 + k % 6;
    if (k % 3 == 1)
      foot = surface.node[node];
    if (k % 3 == 2)
      foot = surface.node[node] + unit(random) * (surface.node[node + 1] - surface.node[node]);
    body.position = foot - s.arm - overlap * normal;

    double sum = 0.;
    int n = 0;
    for (const SurfacePlace &p : find_surface_places(body, surface.view(), faces))
    {
      n += p.index;
      sum += p.index * p.overlap;
      REQUIRE((p.normal - normal).norm() < 1e-12);
      REQUIRE((p.arm - s.arm).norm() < 1e-7);
    }
    REQUIRE(n == 1);
    REQUIRE(std::abs(sum - overlap) < 1e-13);
  }
}

TEST_CASE("places on any surface add up to one", "[surface]")
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0., 1.);
  for (int k = 0; k < 400; ++k)
  {
    const double rough = std::pow(10., -3. + 3.2 * unit(random));
    const Surface terrain = grid_surface(
        5, [&](double, double) { return rough * unit(random); }, 0.24, random);
    for (int m = 0; m < 10; ++m)
    {
      const Superquadric shape = random_grain(random);
      const BodyPose body =
          placed(shape, Vec3(5. * unit(random), 5. * unit(random), rough + 1.6 + unit(random)), random);
      REQUIRE(sum_of_indices(body, terrain.view()) == 1);
    }
  }
  const Surface closed = cube(); // a sphere's worth of normals, of which those on the far side see the body too
  for (int m = 0; m < 100; ++m)
  {
    const Vec3 towards = draw_orientation(random) * Vec3::UnitX();
    const BodyPose body = placed(sphere(0.5), 3. * towards, random);
    const auto places = find_surface_places(body, closed.view(), closed.all_faces());
    REQUIRE(places.empty());
  }
}

TEST_CASE("forces on a body are the derivatives of one continuous energy", "[surface]")
{
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0., 1.);
  int n_bent = 0;
  for (int k = 0; k < 120; ++k)
  {
    // From nearly flat, where several places are touched at once, to rough.
    const double rough = std::pow(10., -4. + 3.5 * unit(random));
    const Surface terrain = grid_surface(
        6, [&](double, double) { return rough * unit(random); }, 0.2, random);
    const std::vector<std::int32_t> faces = terrain.all_faces();
    // Deepest near the middle node, where several faces may be touched.
    BodyPose body = placed(random_grain(random), Vec3::Zero(), random);
    const PlacedSupport<double> lowest = support(body, Vec3(-Vec3::UnitZ()));
    body.position = terrain.node[24] - lowest.arm + 0.1 * Vec3(unit(random) - 0.5, unit(random) - 0.5, 0.);
    const double start = body.position[2];
    // Down to a slight overlap.
    double low = start - 1., high = start + 1.;
    for (int n = 0; n < 50; ++n)
    {
      body.position[2] = 0.5 * (low + high);
      (find_surface_places(body, terrain.view(), faces).empty() ? high : low) = body.position[2];
    }
    body.position[2] -= 0.01;
    const Vec3 along = draw_orientation(random) * Vec3::UnitX();
    const double step = 1e-5;
    Response before = response(body, terrain, faces);
    std::size_t n_places = 0;
    for (int n = 0; n < 100; ++n)
    {
      body.position += step * Vec3(along[0], along[1], 0.);
      const Response now = response(body, terrain, faces);
      const double work = 0.5 * step * (before.force + now.force).dot(Vec3(along[0], along[1], 0.));
      // The trapezoidal rule's error: the cube of the step times the second derivative, which is bounded only where
      // the overlap is not zero; a force that jumps would leave the step times the jump.
      REQUIRE(std::abs(now.energy - before.energy + work) < 2e-5 * step * (before.force.norm() + 1e-3));
      REQUIRE((now.force - before.force).norm() < 50. * step);
      n_places = std::max(n_places, find_surface_places(body, terrain.view(), faces).size());
      before = now;
    }
    n_bent += n_places > 1;
  }
  REQUIRE(n_bent > 8); // and with places that count against one another among them
}

TEST_CASE("closed paths around edges and vertices give and take nothing: the field of forces has no curl", "[surface]")
{
  // Wellmann, figure 4.5, with any body instead of a sphere: his interpolated forces have a curl wherever faces bend
  // little. Circles of the centre about a place that is touched: over an edge or a vertex, and out of contact in part.
  struct Case
  {
    const char *name;
    Surface surface;
    Vec3 nearby; ///< unit, from the origin to the body
  };
  const double degree = M_PI / 180.;
  std::vector<Case> cases;
  for (const double slope : {0., 0.5, 5., 30., -0.5, -5., -30.})
    cases.push_back({slope < 0. ? "valley" : "ridge", ridge(slope * degree), Vec3::UnitZ()});
  Surface corner = cube();
  for (Vec3 &node : corner.node)
    node = 10. * (node - Vec3::Ones());
  cases.push_back({"vertex", corner, Vec3::Ones().normalized()});
  cases.push_back({"edge of a cube", corner, Vec3(1., 0., 1.).normalized()});
  std::mt19937_64 random(8);
  std::vector<Superquadric> bodies{sphere(1.)};
  for (int k = 0; k < 2; ++k)
    bodies.push_back(random_grain(random));
  for (const Case &c : cases)
  {
    const std::vector<std::int32_t> faces = c.surface.all_faces();
    double largest_work = 0., largest_curl = 0., largest_divergence = 0.;
    for (const Superquadric &shape : bodies)
    {
      BodyPose body = placed(shape, Vec3::Zero(), random);
      body.position = 3. * c.nearby;
      while (find_surface_places(body, c.surface.view(), faces).empty())
        body.position -= 1e-3 * c.nearby;
      body.position -= 5e-3 * c.nearby;
      const Vec3 centre = body.position;
      for (int n = 0; n < 3; ++n)
      {
        const Vec3 axis = draw_orientation(random) * Vec3::UnitX(), one = axis.unitOrthogonal(), two = axis.cross(one);
        constexpr double radius = 0.01;
        constexpr int n_points = 500;
        double work = 0., most_energy = 0.;
        for (int k = 0; k < n_points; ++k)
        {
          const double angle = 2. * M_PI * k / n_points;
          body.position = centre + radius * (std::cos(angle) * one + std::sin(angle) * two);
          const Response here = response(body, c.surface, faces);
          work += 2. * M_PI * radius / n_points * here.force.dot(std::cos(angle) * two - std::sin(angle) * one);
          most_energy = std::max(most_energy, here.energy);
          if (k % 25 == 0)
          {
            const FieldRates rates = rates_of_field(body, c.surface, faces);
            largest_curl = std::max(largest_curl, rates.curl);
            largest_divergence = std::max(largest_divergence, std::abs(rates.divergence));
          }
        }
        REQUIRE(most_energy > 0.);
        largest_work = std::max(largest_work, std::abs(work) / most_energy);
      }
    }
    CAPTURE(c.name, largest_work, largest_curl, largest_divergence);
    CHECK(largest_work < 1e-5);                      // the quadrature's, where the overlap goes to zero
    CHECK(largest_curl < 1e-4 * largest_divergence); // the differences', likewise
  }
}

TEST_CASE("a body that touches a convex polyhedron does so once, where it is least deep", "[surface]")
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0., 1.);
  const Surface surface = cube();
  std::array<int, 3> n_of{};
  for (int k = 0; k < 150; ++k)
  {
    const Superquadric shape = random_grain(random);
    const Vec3 towards = draw_orientation(random) * Vec3::UnitX();
    const Quaternion orientation = draw_orientation(random);
    const auto overlap_along = [&](const BodyPose &body, const Vec3 &c) // the cube's support is the sum of |c|
    { return c.cwiseAbs().sum() + support(body, Vec3(-c)).height - c.dot(body.position); };
    // The least over all directions by a search that knows neither derivatives nor features.
    const auto least = [&](const BodyPose &body)
    {
      Vec3 best = body.position.normalized();
      double value = overlap_along(body, best);
      for (double reach = 0.5; reach > 1e-9; reach *= 0.8)
        for (int n = 0; n < 60; ++n)
        {
          const Vec3 trial = (best + reach * (draw_orientation(random) * Vec3::UnitX())).normalized();
          if (const double there = overlap_along(body, trial); there < value)
          {
            value = there;
            best = trial;
          }
        }
      return std::pair(value, best);
    };
    const auto at = [&](const double distance) { return make_pose(shape, distance * towards, orientation); };
    double touching = 0., apart = 6.; // to a slight overlap
    while (apart - touching > 0.05)
    {
      const double middle = 0.5 * (touching + apart);
      (least(at(middle)).first < 0. ? apart : touching) = middle;
    }
    const BodyPose body = at(touching);
    const auto places = find_surface_places(body, surface.view(), surface.all_faces());
    const double overlap = least(body).first;
    REQUIRE(places.size() == 1);
    REQUIRE(places[0].index == 1);
    REQUIRE(overlap_along(body, places[0].normal) == Approx(places[0].overlap).margin(1e-13));
    REQUIRE(overlap > places[0].overlap - 1e-13); // no direction is less deep, and the search ends near
    REQUIRE(overlap < places[0].overlap + 1e-3);
    ++n_of[static_cast<int>(places[0].feature)];
  }
  REQUIRE(*std::min_element(n_of.begin(), n_of.end()) > 5);
}

TEST_CASE("a sphere in a valley has two contacts, on a ridge one", "[surface]")
{
  std::mt19937_64 random(6);
  const double slope = 0.5, overlap = 1e-3;
  const Surface valley = ridge(-slope), crest = ridge(slope);
  const BodyPose in_valley = placed(sphere(1.), Vec3(0., 0.3, (1. - overlap) / std::cos(slope)), random);
  const auto two = find_surface_places(in_valley, valley.view(), valley.all_faces());
  REQUIRE(two.size() == 2);
  for (const SurfacePlace &p : two)
  {
    REQUIRE(p.feature == Feature::face);
    REQUIRE(p.overlap == Approx(overlap));
  }
  REQUIRE((two[0].normal + two[1].normal).normalized().isApprox(Vec3::UnitZ(), 1e-12));
  const Vec3 lean = Vec3(std::sin(0.3), 0., std::cos(0.3)); // within the slope: on the edge
  const BodyPose on_crest = placed(sphere(1.), (1. - overlap) * lean + Vec3(0., 0.3, 0.), random);
  const auto one = find_surface_places(on_crest, crest.view(), crest.all_faces());
  REQUIRE(one.size() == 1);
  REQUIRE(one[0].feature == Feature::edge);
  REQUIRE(one[0].overlap == Approx(overlap));
  REQUIRE(one[0].normal.isApprox(lean, 1e-9));
}

TEST_CASE("two faces that hardly bend are touched as one", "[surface]")
{
  std::mt19937_64 random(7);
  const double overlap = 1e-2, plane = 2.5 * std::pow(overlap, 1.5);
  double last = plane;
  for (const double slope : {-1e-8, -1e-5, -1e-3, -1e-2, -0.03, -0.1, -0.3})
  {
    const Surface valley = ridge(slope);
    const BodyPose body = placed(sphere(1.), Vec3(0., 0.3, (1. - overlap) / std::cos(slope)), random);
    const double force = response(body, valley, valley.all_faces()).force[2];
    REQUIRE(force > 0.999 * last); // rises with the bend, from that of the plane to twice that
    if (slope > -1e-4)
      REQUIRE(force == Approx(plane).epsilon(1e-4));
    if (slope < -0.2)
      REQUIRE(force == Approx(2. * plane * std::cos(slope)));
    last = force;
  }
}

TEST_CASE("the rim of an open surface is round", "[surface]")
{
  std::mt19937_64 random(8);
  const Surface sheet = grid_surface(
      2, [](double, double) { return 0.; }, 0., random);
  const BodyPose beside = placed(sphere(1.), Vec3(2. + 0.995 * std::cos(0.5), 1.1, 0.995 * std::sin(0.5)), random);
  const auto at_edge = find_surface_places(beside, sheet.view(), sheet.all_faces());
  REQUIRE(at_edge.size() == 1);
  REQUIRE(at_edge[0].feature == Feature::edge);
  REQUIRE(at_edge[0].overlap == Approx(0.005));
  const Vec3 out = Vec3(1., 1., 0.7).normalized();
  const BodyPose at_corner = placed(sphere(1.), Vec3(2., 2., 0.) + 0.995 * out, random);
  const auto corner = find_surface_places(at_corner, sheet.view(), sheet.all_faces());
  REQUIRE(corner.size() == 1);
  REQUIRE(corner[0].feature == Feature::vertex);
  REQUIRE(corner[0].normal.isApprox(out, 1e-9));
}

TEST_CASE("a vertex is touched beside places that are too deep to be", "[surface]")
{
  // A small triangle stands on edge in the side of a flat grain: its plane and the lines of its edges are far inside,
  // but one vertex alone is, and hardly.
  Superquadric shape;
  shape.half_axes = Vec3(1., 6.79, 5.12);
  shape.eps1 = 1.056;
  shape.eps2 = 0.902;
  Mat3 axes;
  axes << -0.0553, -0.0727, -0.9958, 0.5113, 0.8546, -0.0908, 0.8576, -0.5141, -0.0101;
  const Surface triangle{{Vec3(0.0100, 0.0185, 0.0039), Vec3(-0.0173, 0.0039, -0.0102), Vec3(-0.0145, 0.0054, -0.0087)},
                         SurfaceTopology({{0, 1, 2}}, 3)};
  BodyPose body = make_pose(shape, Vec3::Zero(), Quaternion(axes).normalized());
  const Vec3 direction = Vec3(0.0874, 0.7154, 0.6932).normalized();
  const Vec3 touched = triangle.node[0] - support(body, Vec3(-direction)).arm;
  for (const double depth : {-1e-3, -1e-5, 1e-5, 1e-3})
  {
    CAPTURE(depth);
    body.position = touched - depth * direction;
    const std::vector<SurfacePlace> places = find_surface_places(body, triangle.view(), triangle.all_faces());
    REQUIRE(places.size() == (depth > 0. ? 1 : 0));
    if (depth > 0.)
    {
      CHECK(places[0].feature == Feature::vertex);
      CHECK(places[0].number == 0);
      CHECK(places[0].index == 1);
      CHECK(places[0].overlap == Approx(depth).epsilon(1e-6));
      CHECK(places[0].normal.dot(direction) == Approx(1.));
    }
  }
}

TEST_CASE("a valley whose faces are too deep to be touched does not pull", "[surface]")
{
  // A sphere that is over its bottom touches both faces and the edge counts against them; deeper than the faces are
  // touched the edge alone would be within reach.
  std::mt19937_64 random(10);
  constexpr double slope = 0.6;
  const Surface valley = ridge(-slope);
  int n_valleys = 0, n_beyond = 0;
  for (double height = 0.05; height < 1.3; height += 0.01)
    for (const double aside : {0., 0.05, 0.2})
    {
      CAPTURE(height, aside);
      const BodyPose body = placed(sphere(1.), Vec3(aside, 0.3, height), random);
      const auto overlap = [&](const double side) { return 1. - height * std::cos(slope) - side * std::sin(slope); };
      const double shallow = overlap(aside), deep = overlap(-aside);
      const std::vector<SurfacePlace> places = find_surface_places(body, valley.view(), valley.all_faces());
      const auto n_edges =
          std::count_if(places.begin(), places.end(), [](const SurfacePlace &p) { return p.feature == Feature::edge; });
      if (n_edges > 0)
        REQUIRE(deep <= deepest_overlap);
      n_valleys += n_edges > 0;
      n_beyond += shallow > deepest_overlap && std::hypot(aside, height) > 1. - deepest_overlap;
      const Response r = response(body, valley, valley.all_faces());
      REQUIRE(r.energy >= 0.);
      REQUIRE(r.force[2] >= 0.);
    }
  REQUIRE(n_valleys > 10);
  REQUIRE(n_beyond > 10);
}

TEST_CASE("crumpled surfaces press bodies and do not pull them in", "[surface]")
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0., 1.);
  int n_touched = 0, n_against = 0, n_pulled = 0;
  for (int k = 0; k < 3000; ++k)
  {
    const Surface crumpled = grid_surface(
        3, [&](double, double) { return 1.2 * unit(random); }, 0.3, random);
    const BodyPose body =
        placed(random_grain(random), Vec3(3. * unit(random), 3. * unit(random), 2. * unit(random)), random);
    const std::vector<SurfacePlace> places = find_surface_places(body, crumpled.view(), crumpled.all_faces());
    n_touched += !places.empty();
    n_against += std::any_of(places.begin(), places.end(), [](const SurfacePlace &p) { return p.index < 0; });
    n_pulled += response(body, crumpled, crumpled.all_faces()).energy < 0.;
  }
  // Left are those whose deeper place lies beyond the features around: one in a thousand; a tenth of all without a look
  // at these.
  REQUIRE(n_touched > 500);
  REQUIRE(n_against > 100);
  REQUIRE(n_pulled < n_touched / 200);
}

TEST_CASE("bounds of the gap between a body and a feature hold", "[surface]")
{
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(0., 1.);
  int n_bounds = 0;
  for (int k = 0; k < 300; ++k)
  {
    const Surface terrain = grid_surface(
        4, [&](double, double) { return 0.3 * unit(random); }, 0.24, random);
    const Superquadric shape = random_grain(random);
    const BodyPose body = placed(shape, Vec3(4. * unit(random), 4. * unit(random), 0.5 + 2. * unit(random)), random);
    const SurfaceView view = terrain.view();
    SurfaceLook look(body, view);
    const auto f = static_cast<std::int32_t>(k % terrain.topology.n_faces());
    const Triangle &t = terrain.topology.triangle[f];
    const auto check = [&](const double gap, const Vec3 &point)
    {
      n_bounds += gap > 0.;
      if (gap > 0.) // no ball of that radius about a point of the feature reaches into the body
        for (int n = 0; n < 50; ++n)
        {
          const Vec3 x = point + 0.999 * gap * (draw_orientation(random) * Vec3::UnitX()) - body.position;
          REQUIRE(inside_outside(shape, body.rotation.transpose() * x) > 1.);
        }
    };
    const double a = unit(random), b = unit(random) * (1. - a);
    check(look.separation_from(Feature::face, f).gap,
          a * terrain.node[t[0]] + b * terrain.node[t[1]] + (1. - a - b) * terrain.node[t[2]]);
    check(look.separation_from(Feature::edge, terrain.topology.edge_of[f][0]).gap,
          a * terrain.node[t[0]] + (1. - a) * terrain.node[t[1]]);
    check(look.separation_from(Feature::vertex, t[2]).gap, terrain.node[t[2]]);
  }
  REQUIRE(n_bounds > 200);
}
