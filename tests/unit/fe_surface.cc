#include "dem/core/error.h"
#include "fe_dealii/boundary/face_triangles.h"
#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

using namespace bergamo::fe;

namespace
{

using Vector = std::array<double, 3>;

ExplicitBody box(const unsigned int degree, const double distortion)
{
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 2, 3}, {2, 3, 2}}, mesh);
  if (distortion > 0)
    dealii::GridTools::distort_random(distortion, mesh, /*keep_boundary=*/false, /*seed=*/5);
  ExplicitBodyParameters parameters;
  parameters.degree = degree;
  return ExplicitBody(mesh, parameters);
}

Vector sum_of(const std::vector<double> &force)
{
  Vector sum{};
  for (std::size_t dof = 0; dof < force.size(); ++dof)
    sum[dof % 3] += force[dof];
  return sum;
}

} // namespace

TEST_CASE("triangles on faces close where faces meet, and follow curved ones as they get finer", "[fe]")
{
  for (const unsigned int degree : {1u, 2u})
  {
    const ExplicitBody body = box(degree, 0.2);
    std::vector<Surface> sides;
    for (unsigned int id = 0; id < 6; ++id)
      sides.push_back(boundary_surface(body.dof_handler(), id));
    std::vector<double> bent(3 * body.n_nodes()); // displacement, which twists faces of 4 nodes and bends those of 9
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const auto &x = body.node_position()[node];
      bent[3 * node + 2] = 0.1 * x[0] * x[0] + 0.2 * x[0] * x[1];
    }
    double exact = 0;
    for (const Surface &side : sides)
      exact += SurfaceLoad(side, body.node_position()).volume(bent);
    double missed[3];
    for (int k = 0; k < 3; ++k)
    {
      const FaceTriangles faces = divide_faces(sides, degree << k);
      std::vector<Vector> x;
      for (std::size_t corner = 0; corner < faces.corners.size(); ++corner)
      {
        double sum = 0;
        x.push_back({});
        for (const auto &[node, value] : faces.corners[corner])
        {
          sum += value;
          for (int i = 0; i < 3; ++i)
            x.back()[i] += value * (body.node_position()[node][i] + bent[3 * std::size_t(node) + i]);
        }
        REQUIRE(sum == Approx(1).epsilon(1e-15));
        REQUIRE((k > 0 || faces.corners[corner].size() == 1)); // these are the nodes
      }
      std::map<std::pair<unsigned int, unsigned int>, int> edges;
      double volume = 0;
      for (const auto &[a, b, c] : faces.triangles)
      {
        for (int i = 0; i < 3; ++i)
          volume += x[a][i] * (x[b][(i + 1) % 3] * x[c][(i + 2) % 3] - x[b][(i + 2) % 3] * x[c][(i + 1) % 3]) / 6;
        for (const auto &edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
          ++edges[edge];
      }
      for (const auto &[edge, count] : edges)
      {
        REQUIRE(count == 1);
        REQUIRE(edges.count({edge.second, edge.first}) == 1);
      }
      missed[k] = std::abs(volume / exact - 1);
    }
    CAPTURE(degree, missed[0], missed[1], missed[2]);
    CHECK(missed[1] < 0.3 * missed[0]); // of second order
    CHECK(missed[2] < 0.3 * missed[1]);
  }
  CHECK_THROWS_WITH(divide_faces({}, 0), Catch::Contains("number of squares"));
}

TEST_CASE("triangles on both sides of a sheet close at its rim", "[fe]")
{
  // Two squares beside one another, of which all nodes lie on the rim.
  const Surface sheet{1, {0, 1, 2, 3, 1, 4, 3, 5}, {0, 1}};
  const FaceTriangles front = divide_faces({&sheet, 1}, 1), both = both_sides(front);
  CHECK(front.triangles.size() == 4);
  CHECK(front.corners.size() == 6);
  CHECK(both.corners.size() == 6 + 2 * 3); // the middles of the three sides inside, on the front and on the back
  std::map<std::pair<unsigned int, unsigned int>, int> edges;
  for (const auto &[a, b, c] : both.triangles)
    for (const auto &edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      ++edges[edge];
  for (const auto &[edge, count] : edges)
  {
    CHECK(count == 1);
    CHECK(edges.count({edge.second, edge.first}) == 1);
  }
  for (std::size_t corner = 0; corner < both.corners.size(); ++corner)
  {
    double sum = 0;
    for (const auto &[node, value] : both.corners[corner])
      sum += value;
    CHECK(sum == 1);
  }
}

TEST_CASE("a surface's triangles close, point outwards and have its area", "[fe]")
{
  for (const unsigned int degree : {1u, 2u})
  {
    const ExplicitBody body = box(degree, 0);
    const auto &x = body.node_position();
    std::map<std::pair<unsigned int, unsigned int>, int> edges;
    double volume = 0;
    for (unsigned int id = 0; id < 6; ++id)
    {
      const Surface surface = boundary_surface(body.dof_handler(), id);
      const auto pieces = triangles(surface);
      CHECK(pieces.size() == surface.size() * (degree == 1 ? 2 : 8));
      Vector area{};
      for (const auto &t : pieces)
      {
        Vector a, b;
        for (int i = 0; i < 3; ++i)
        {
          a[i] = x[t[1]][i] - x[t[0]][i];
          b[i] = x[t[2]][i] - x[t[0]][i];
        }
        for (int i = 0; i < 3; ++i)
        {
          const double part = 0.5 * (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
          area[i] += part;
          volume += part * x[t[0]][i] / 3;
        }
        for (int k = 0; k < 3; ++k)
          ++edges[{t[k], t[(k + 1) % 3]}];
      }
      const double side[3] = {6, 3, 2};
      for (unsigned int i = 0; i < 3; ++i)
        CHECK(area[i] == Approx(i == id / 2 ? (id % 2 ? 1 : -1) * side[i] : 0.).margin(1e-12));
    }
    CHECK(volume == Approx(6)); // by Gauss' theorem
    for (const auto &[edge, count] : edges)
    {
      REQUIRE(count == 1);
      REQUIRE(edges.count({edge.second, edge.first}) == 1);
    }
  }
  CHECK_THROWS_WITH(boundary_surface(box(1, 0).dof_handler(), 9),
                    Catch::Contains("no boundary 9") && Catch::Contains("0 1 2 3 4 5"));
}

namespace
{

/// ∫ N dx of the nodes of a row of elements, by their places: Simpson's weights for three nodes an element, halves for
/// two.
std::map<double, double> shares_along(const std::set<double> &places, const unsigned int degree)
{
  const std::vector<double> x(places.begin(), places.end());
  std::map<double, double> shares;
  for (std::size_t first = 0; first + degree < x.size(); first += degree)
  {
    const double length = x[first + degree] - x[first];
    for (unsigned int k = 0; k <= degree; ++k)
      shares[x[first + k]] += length * (degree == 1 ? 1. / 2 : k == 1 ? 4. / 6 : 1. / 6);
  }
  return shares;
}

} // namespace

TEST_CASE("each node's part of a traction is that of its shape function, on faces of any size", "[fe]")
{
  const unsigned int degree = GENERATE(1u, 2u);
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 2, 3}, {3, 4, 2}, {3, 0.2, 1}}, mesh);
  ExplicitBodyParameters parameters;
  parameters.degree = degree;
  const ExplicitBody body(mesh, parameters);
  const auto &x = body.node_position();
  std::set<double> places[2];
  const std::vector<unsigned int> top = body.boundary_nodes(5);
  for (const unsigned int node : top)
    for (int i = 0; i < 2; ++i)
      places[i].insert(std::round(x[node][i] * 1e9) / 1e9);
  const auto along_x = shares_along(places[0], degree), along_y = shares_along(places[1], degree);
  std::vector<double> traction(3 * body.n_nodes(), 0.), pressure(traction.size(), 0.), none(traction.size(), 0.);
  const SurfaceLoad load(boundary_surface(body.dof_handler(), 5), x);
  load.add_traction({3, 0, -7}, traction);
  load.add_pressure(7, none, pressure);
  for (const unsigned int node : top)
  {
    const double area = along_x.at(std::round(x[node][0] * 1e9) / 1e9) * along_y.at(std::round(x[node][1] * 1e9) / 1e9);
    CHECK(traction[3 * node] == Approx(3 * area).epsilon(1e-7));
    CHECK(traction[3 * node + 2] == Approx(-7 * area).epsilon(1e-7));
    CHECK(pressure[3 * node + 2] == Approx(-7 * area).epsilon(1e-7));
  }
}

TEST_CASE("a traction on a face that widens acts in the middle of its area", "[fe]")
{
  const unsigned int degree = GENERATE(1u, 2u);
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 2, 1}, {2, 3, 1}}, mesh);
  dealii::GridTools::transform(
      [](const dealii::Point<3> &p) { return dealii::Point<3>(p[0] * (1 + 0.3 * p[1]), p[1], p[2]); }, mesh);
  ExplicitBodyParameters parameters;
  parameters.degree = degree;
  const ExplicitBody body(mesh, parameters);
  std::vector<double> force(3 * body.n_nodes(), 0.);
  SurfaceLoad(boundary_surface(body.dof_handler(), 5), body.node_position()).add_traction({0, 0, 1}, force);
  double area = 0, moment_x = 0, moment_y = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    area += force[3 * node + 2];
    moment_x += force[3 * node + 2] * body.node_position()[node][0];
    moment_y += force[3 * node + 2] * body.node_position()[node][1];
  }
  // Of the trapezoid with the sides 1 and 1.6 m at a distance of 2 m: ∫ (1 + 0.3 y) dy and its moments.
  CHECK(area == Approx(2.6));
  CHECK(moment_x == Approx(0.5 * (std::pow(1.6, 3) - 1) / 0.9));
  CHECK(moment_y == Approx(2 + 0.3 * 8. / 3));
}

TEST_CASE("tractions and pressures on a surface have the resultants of their areas", "[fe]")
{
  for (const unsigned int degree : {1u, 2u})
  {
    const ExplicitBody body = box(degree, 0.2);
    std::vector<double> closed(3 * body.n_nodes(), 0.), displacement(3 * body.n_nodes());
    // A turn by 90 degrees about z and a stretch by 1.5 along what was x.
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const Vector &x = body.node_position()[node];
      displacement[3 * node] = -x[1] - x[0];
      displacement[3 * node + 1] = 1.5 * x[0] - x[1];
    }
    double area = 0;
    for (unsigned int id = 0; id < 6; ++id)
    {
      const SurfaceLoad load(boundary_surface(body.dof_handler(), id), body.node_position());
      area += load.reference_area();
      std::vector<double> force(3 * body.n_nodes(), 0.);
      load.add_traction({1, 2, 3}, force);
      const Vector resultant = sum_of(force);
      for (int i = 0; i < 3; ++i)
        CHECK(resultant[i] == Approx((i + 1) * load.reference_area()));
      load.add_pressure(7, displacement, closed);
    }
    CHECK(area > 22); // that of the box, more where it is distorted
    // A pressure around a closed surface neither pushes nor turns, whatever its shape.
    const Vector resultant = sum_of(closed);
    Vector torque{};
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      for (int i = 0; i < 3; ++i)
      {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        torque[i] += (body.node_position()[node][a] + displacement[3 * node + a]) * closed[3 * node + b] -
                     (body.node_position()[node][b] + displacement[3 * node + b]) * closed[3 * node + a];
      }
    for (int i = 0; i < 3; ++i)
    {
      CHECK(std::abs(resultant[i]) < 1e-12 * 7 * 22);
      CHECK(std::abs(torque[i]) < 1e-12 * 7 * 22);
    }
    // Its power on a displacement x is −3 p V.
    double power = 0;
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      for (int i = 0; i < 3; ++i)
        power += closed[3 * node + i] * (body.node_position()[node][i] + displacement[3 * node + i]);
    double volume = 0;
    for (std::size_t e = 0; e < body.n_elements(); ++e)
      volume += body.elements().volume(e);
    CHECK(power == Approx(-3 * 7 * 1.5 * volume).epsilon(1e-9));
  }
}
