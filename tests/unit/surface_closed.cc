#include "dem/core/error.h"
#include "dem/geometry/closed_surface.h"
#include "dem/geometry/superquadric.h"

#include "tests/surfaces.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <numbers>

using namespace bergamo;
using namespace bergamo::dem;
using namespace bergamo::dem::test;
using Catch::Contains;

namespace
{

constexpr double rounding = 1e-13;

/// The sphere of radius 1 by triangles: those of a tetrahedron, halved n times, their nodes on the sphere.
test::Surface round_surface(const int n)
{
  test::Surface s;
  const double a = 1. / std::sqrt(3.);
  s.node = {Vec3(a, a, a), Vec3(a, -a, -a), Vec3(-a, a, -a), Vec3(-a, -a, a)};
  std::vector<Triangle> triangles{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  for (int k = 0; k < n; ++k)
  {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle;
    const auto between = [&](const std::int32_t i, const std::int32_t j)
    {
      const auto [place, is_new] = middle.try_emplace(std::minmax(i, j), static_cast<std::int32_t>(s.node.size()));
      if (is_new)
        s.node.push_back((s.node[i] + s.node[j]).normalized());
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto &[p, q, r] : triangles)
    {
      const std::int32_t pq = between(p, q), qr = between(q, r), rp = between(r, p);
      finer.insert(finer.end(), {{p, pq, rp}, {q, qr, pq}, {r, rp, qr}, {pq, qr, rp}});
    }
    triangles = finer;
  }
  s.topology = SurfaceTopology(triangles, s.node.size());
  return s;
}

/// x -> turn x + shift, as one map of a body.
test::Surface moved(test::Surface s, const Mat3 &map, const Vec3 &shift)
{
  for (Vec3 &x : s.node)
    x = map * x + shift;
  return s;
}

} // namespace

TEST_CASE("the mass of a box is that of its formula wherever it is")
{
  const Vec3 half(0.5, 1.5, 2.);
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1., -2., 0.5).normalized()).toRotationMatrix();
  const Vec3 centre(3., -5., 7.);
  for (const Mat3 &orientation : {Mat3(Mat3::Identity()), turn})
  {
    const EnclosedBody body = enclosed_body(moved(cube(), orientation * half.asDiagonal(), centre).view());
    const double volume = 8. * half.prod();
    const Vec3 squares = half.cwiseAbs2(), own = Vec3::Constant(squares.sum()) - squares;
    const Mat3 inertia = orientation * (volume / 3. * own).asDiagonal() * orientation.transpose();
    CHECK(std::abs(body.volume - volume) < rounding * volume);
    CHECK((body.centre - centre).norm() < rounding * centre.norm());
    CHECK((body.inertia - inertia).norm() < rounding * inertia.norm());
  }
  // Far away only the digits of the places are lost.
  const EnclosedBody far = enclosed_body(moved(cube(), Mat3::Identity(), Vec3(1e6, 0., 0.)).view());
  CHECK((far.inertia - 16. / 3. * Mat3::Identity()).norm() < 1e-8);
}

TEST_CASE("the mass of a tetrahedron is that of its formula")
{
  // Tonon 2004, his example: volume and inertia about the centre.
  test::Surface s;
  s.node = {Vec3(8.33220, -11.86875, 0.93355), Vec3(0.75523, 5., 16.37072), Vec3(52.61236, 5., -5.38580),
            Vec3(2., 5., 3.)};
  std::vector<Triangle> triangles{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  s.topology = SurfaceTopology(triangles, 4);
  if (enclosed_moments(s.view(), Vec3::Zero())[0] < 0.)
  {
    for (Triangle &t : triangles)
      std::swap(t[0], t[1]);
    s.topology = SurfaceTopology(triangles, 4);
  }
  const EnclosedBody body = enclosed_body(s.view());
  CHECK((body.centre - (s.node[0] + s.node[1] + s.node[2] + s.node[3]) / 4.).norm() < rounding * body.centre.norm());
  constexpr double digits = 2e-6; // of his figures
  Mat3 inertia;
  inertia << 43520.33257, -11996.20119, 46343.16662, -11996.20119, 194711.28938, -4417.66150, 46343.16662, -4417.66150,
      191168.76173;
  CHECK((body.centre - Vec3(15.92492, 0.78281, 3.72962)).norm() < 1e-4); // his places have five digits
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      CHECK(std::abs(body.inertia(i, j) - inertia(i, j)) < digits * inertia.norm());
}

TEST_CASE("the mass of a sphere of triangles converges by the square of their size")
{
  const Vec3 centre(0.3, -0.2, 5.);
  constexpr double volume = 4. / 3. * std::numbers::pi, moment = 0.4 * volume;
  double error_before = 0., inertia_error_before = 0.;
  for (int n = 4; n <= 6; ++n)
  {
    const EnclosedBody body = enclosed_body(moved(round_surface(n), Mat3::Identity(), centre).view());
    const double error = std::abs(body.volume / volume - 1.);
    const double inertia_error = (body.inertia - moment * Mat3::Identity()).norm() / moment;
    CHECK((body.centre - centre).norm() < 1e-12);
    if (n > 4)
    {
      INFO(n);
      CHECK(std::log2(error_before / error) == Approx(2.).margin(0.05));
      CHECK(std::log2(inertia_error_before / inertia_error) == Approx(2.).margin(0.05));
    }
    error_before = error;
    inertia_error_before = inertia_error;
  }
}

TEST_CASE("an ellipsoid's mass is that of the superquadric")
{
  const Superquadric shape{Vec3(1.2, 0.7, 0.4), 1., 1.};
  const EnclosedBody body = enclosed_body(moved(round_surface(6), shape.half_axes.asDiagonal(), Vec3::Zero()).view());
  CHECK(body.volume == Approx(volume(shape)).epsilon(2e-3));
  const Vec3 moments = inertia_per_density(shape);
  for (int i = 0; i < 3; ++i)
    CHECK(body.inertia(i, i) == Approx(moments[i]).epsilon(3e-3));
}

TEST_CASE("a cavity counts off")
{
  const test::Surface outside = cube();
  test::Surface hollow = moved(cube(), 2. * Mat3::Identity(), Vec3::Zero());
  std::vector<Triangle> triangles = hollow.topology.triangle;
  const Vec3 shift(0.5, 0., 0.);
  for (const Vec3 &x : outside.node)
    hollow.node.push_back(x + shift);
  for (const Triangle &t : outside.topology.triangle)
    triangles.push_back({t[0] + 8, t[2] + 8, t[1] + 8});
  hollow.topology = SurfaceTopology(triangles, hollow.node.size());
  const EnclosedBody body = enclosed_body(hollow.view());
  CHECK(body.volume == Approx(64. - 8.));
  CHECK(body.centre.x() == Approx(-8. * 0.5 / 56.));
}

TEST_CASE("what encloses nothing has no mass")
{
  const test::Surface open = ridge(0.3);
  CHECK_THROWS_WITH(enclosed_body(open.view()), Contains("1 holes of 4 edges"));
  test::Surface inwards = cube();
  std::vector<Triangle> triangles = inwards.topology.triangle;
  for (Triangle &t : triangles)
    std::swap(t[0], t[1]);
  inwards.topology = SurfaceTopology(triangles, 8);
  CHECK_THROWS_WITH(enclosed_body(inwards.view()), Contains("encloses -8 m3") && Contains("inwards"));
}

TEST_CASE("holes are loops of edges with one face")
{
  CHECK(holes_of(cube().topology).n_holes == 0);
  CHECK(holes_of(ridge(0.1).topology).n_holes == 1);
  std::vector<Triangle> triangles = cube().topology.triangle;
  triangles.erase(triangles.begin() + 11);
  triangles.erase(triangles.begin());
  const Holes holes = holes_of(SurfaceTopology(triangles, 8));
  CHECK(holes.n_holes == 2);
  CHECK(holes.n_edges == 6);
  CHECK(SurfaceTopology(triangles, 8).edge[holes.edge].right == SurfaceTopology::none);
}
