// What the VTU files of a body hold, number by number.

#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/mesh/material_box.h"
#include "fe_dealii/output.h"
#include "tests/solid_shapes.h"
#include "tests/temporary_folder.h"
#include "tests/unit/fe_vtu_reader.h"

#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace bergamo::fe;

namespace
{

constexpr float rounding = 1e-6f; // of the numbers in the file

/// 1 × 2 × 3 m, two elements along z, each of one stress.
ExplicitBody block(const Shape shape)
{
  ExplicitBodyParameters parameters;
  set_shape(parameters, shape);
  parameters.material =
      MohrCoulomb({.young_modulus = 2e6, .poisson_ratio = 0.25, .friction_angle = 30, .cohesion = 7e3});
  parameters.initial_stress = [](const std::array<double, 3> &place)
  { return place[2] < 1.5 ? Stress{-9e3, -8e3, -7e3, 300, 200, 100} : Stress{-3e3, -4e3, -5e3, -100, 250, -350}; };
  return make_box_body({{0, 0, 0}, {1, 2, 3}, {1, 1, 2}}, parameters);
}

} // namespace

TEST_CASE("displacements and velocities of all nodes are in the file, those between the corners too", "[fe]")
{
  const Shape shape = GENERATE(Shape::plain, Shape::bending, Shape::quadratic);
  CAPTURE(static_cast<int>(shape));
  ExplicitBody body = block(shape);
  // Of second order in each coordinate: nothing at the corners of the elements from u_x.
  const auto u = [](const double x, const double y, const double z, const int i)
  {
    const double bulge = z * (1.5 - z) * (3 - z);
    return i == 0 ? 0.1 * x * (1 - x) + 0.2 * y * (2 - y) + 0.3 * bulge : i == 1 ? 0.4 * x * y + 0.1 : -0.2 * y * z * z;
  };
  for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
  {
    const auto &p = body.node_position()[dof / 3];
    body.displacement()[dof] = u(p[0], p[1], p[2], dof % 3);
    body.velocity()[dof] = -7 * body.displacement()[dof];
  }
  const TemporaryFolder folder;
  write_vtu(body, folder / "body.vtu");
  const VtuReader file(folder / "body.vtu");
  const std::vector<double> points = file.points(), displacement = file.array("displacement"),
                            velocity = file.array("velocity");
  const std::size_t per_cell = shape == Shape::quadratic ? 27 : 8;
  REQUIRE(points.size() == 3 * 2 * per_cell);
  REQUIRE(displacement.size() == points.size());
  REQUIRE(velocity.size() == points.size());
  std::set<std::array<double, 3>> places;
  for (std::size_t dof = 0; dof < points.size(); ++dof)
  {
    const double *const p = &points[dof / 3 * 3];
    places.insert({p[0], p[1], p[2]});
    REQUIRE(displacement[dof] == Approx(u(p[0], p[1], p[2], dof % 3)).margin(rounding));
    REQUIRE(velocity[dof] == Approx(-7 * u(p[0], p[1], p[2], dof % 3)).margin(10 * rounding));
  }
  CHECK(places.size() == body.n_nodes());
  CHECK(file.array("types") ==
        std::vector<double>(2, shape == Shape::quadratic ? 72 : 12)); // VTK's hexahedron, Lagrange's
  const std::vector<double> connectivity = file.array("connectivity");
  REQUIRE(connectivity.size() == 2 * per_cell);
  CHECK(std::set<double>(connectivity.begin(), connectivity.end()).size() == 2 * per_cell);
}

TEST_CASE("VTK's order of a quadratic cell: corners, then the nodes of edges, faces and the middle", "[fe]")
{
  const ExplicitBody body = make_box_body({{0, 0, 0}, {2, 2, 2}, {1, 1, 1}},
                                          []
                                          {
                                            ExplicitBodyParameters parameters;
                                            parameters.degree = 2;
                                            return parameters;
                                          }());
  const TemporaryFolder folder;
  write_vtu(body, folder / "body.vtu");
  const VtuReader file(folder / "body.vtu");
  const std::vector<double> points = file.points(), connectivity = file.array("connectivity");
  // vtkLagrangeHexahedron of order 2 in files before version 2.1, as deal.II's say they are: VTK 9 exchanges the edges
  // 18 and 19 as it reads these, and its shape functions then are 1 at their nodes.
  constexpr int expected[27][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
                                   {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
                                   {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {0, 2, 1}, {2, 2, 1}, {0, 1, 1},
                                   {2, 1, 1}, {1, 0, 1}, {1, 2, 1}, {1, 1, 0}, {1, 1, 2}, {1, 1, 1}};
  for (int k = 0; k < 27; ++k)
    for (int i = 0; i < 3; ++i)
    {
      CAPTURE(k, i);
      CHECK(points[3 * static_cast<std::size_t>(connectivity[k]) + i] == expected[k][i]);
    }
}

TEST_CASE("stresses and what follows from them are in the file, cell by cell", "[fe]")
{
  const Shape shape = GENERATE(Shape::plain, Shape::bending, Shape::quadratic);
  CAPTURE(static_cast<int>(shape));
  const ExplicitBody body = block(shape);
  const TemporaryFolder folder;
  write_vtu(body, folder / "body.vtu");
  const VtuReader file(folder / "body.vtu");
  const std::vector<double> points = file.points();
  const std::size_t n = shape == Shape::quadratic ? 27 : 8;
  const Stress stress[2] = {{-9e3, -8e3, -7e3, 300, 200, 100}, {-3e3, -4e3, -5e3, -100, 250, -350}};
  const char *const names[] = {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
  for (std::size_t cell = 0; cell < 2; ++cell)
  {
    double middle = 0;
    for (std::size_t k = 0; k < n; ++k)
      middle += points[3 * (n * cell + k) + 2] / n;
    const Stress &s = stress[middle > 1.5];
    const auto value = [&](const char *name)
    {
      const std::vector<double> values = file.array(name);
      REQUIRE(values.size() == 2 * n);
      for (std::size_t k = 0; k < n; ++k)
        REQUIRE(values[n * cell + k] == values[n * cell]);
      return values[n * cell];
    };
    for (int i = 0; i < 6; ++i)
      CHECK(value(names[i]) == Approx(s[i]).epsilon(rounding));
    const double p = -(s[0] + s[1] + s[2]) / 3, j2 = second_invariant(s);
    CHECK(value("pressure") == Approx(p).epsilon(rounding));
    CHECK(value("deviatoric_stress") == Approx(std::sqrt(3 * j2)).epsilon(rounding));
    const double first = value("principal_stress_1"), second = value("principal_stress_2"),
                 third = value("principal_stress_3");
    CHECK(first >= second);
    CHECK(second >= third);
    CHECK(first + second + third == Approx(-3 * p).epsilon(rounding));
    CHECK(first * second * third == Approx(s[0] * s[1] * s[2] + 2 * s[3] * s[4] * s[5] - s[0] * s[4] * s[4] -
                                           s[1] * s[5] * s[5] - s[2] * s[3] * s[3])
                                        .epsilon(10 * rounding));
    // Φ at 30 degrees: σ1 − σ3 + (σ1 + σ3)/2 − √3 c.
    CHECK(value("yield_function") == Approx(first - third + 0.5 * (first + third) - std::sqrt(3.) * 7e3).epsilon(1e-5));
    const double bulk = 2e6 / 1.5, shear = 2e6 / 2.5;
    CHECK(value("elastic_energy_density") == Approx(p * p / (2 * bulk) + j2 / (2 * shear)).epsilon(rounding));
    CHECK(value("equivalent_plastic_strain") == 0);
    CHECK(value("material_id") == 0);
  }
}

TEST_CASE("the material ids of the mesh are in the file", "[fe]")
{
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 1, 3}, {1, 1, 3}}, mesh);
  set_material({{0, 0, 1}, {1, 1, 2}, 9}, mesh);
  ExplicitBodyParameters parameters;
  parameters.layers = {{0, LinearElastic(ElasticParameters{})}, {9, LinearElastic(ElasticParameters{})}};
  const TemporaryFolder folder;
  write_vtu(ExplicitBody(mesh, parameters), folder / "body.vtu");
  const VtuReader file(folder / "body.vtu");
  const std::vector<double> points = file.points(), id = file.array("material_id");
  REQUIRE(id.size() == 24);
  for (std::size_t cell = 0; cell < 3; ++cell)
  {
    double middle = 0;
    for (std::size_t k = 0; k < 8; ++k)
      middle += points[3 * (8 * cell + k) + 2] / 8;
    CHECK(id[8 * cell] == (middle > 1 && middle < 2 ? 9 : 0));
  }
}

TEST_CASE("the void ratio of sand is in the file, cell by cell, and no other law's", "[fe]")
{
  ExplicitBodyParameters parameters;
  HypoplasticParameters sand;
  sand.initial_void_ratio = 0.7;
  parameters.material = HypoplasticSand(sand);
  set_shape(parameters, GENERATE(Shape::plain, Shape::bending, Shape::quadratic));
  parameters.initial_stress = uniform_pressure(50e3);
  ExplicitBody body = make_box_body({{0, 0, 0}, {1, 1, 2}, {1, 1, 2}}, parameters);
  // Both elements shrink along x, the upper one more.
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const auto &place = body.node_position()[node];
    body.displacement()[3 * node] = -1e-3 * place[0] * std::max(0., place[2] - 1);
  }
  body.compute_internal_force();
  const TemporaryFolder folder;
  write_vtu(body, folder / "body.vtu");
  const VtuReader file(folder / "body.vtu");
  const std::vector<double> void_ratio = file.array("void_ratio"), pressure = file.array("pressure");
  const std::size_t n = parameters.degree == 1 ? 8 : 27;
  REQUIRE(void_ratio.size() == 2 * n);
  for (std::size_t cell = 0; cell < 2; ++cell)
  {
    CHECK(void_ratio[n * cell] == Approx(body.state_of(cell).void_ratio).epsilon(rounding));
    CHECK(pressure[n * cell] == Approx(-mean_stress(body.state_of(cell).stress)).epsilon(rounding));
  }
  const double least = std::min(void_ratio[0], void_ratio[n]), most = std::max(void_ratio[0], void_ratio[n]);
  CHECK(most == Approx(0.7).epsilon(rounding));
  CHECK(0.7 - least == Approx(1.7 * 0.5e-3).epsilon(1e-3)); // (1 + e) tr ε, to its square

  write_vtu(block(Shape::plain), folder / "other.vtu");
  CHECK_THROWS(VtuReader(folder / "other.vtu").array("void_ratio"));
}
