#include "dem/core/error.h"
#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/membrane_body.h"
#include "fe_dealii/output.h"
#include "fe_dealii/stable_step.h"
#include "tests/temporary_folder.h"
#include "tests/unit/fe_rubber.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>

using bergamo::RunError;
using namespace bergamo::fe;

namespace
{

using Vector = std::array<double, 3>;
using Mesh = dealii::Triangulation<2, 3>;

constexpr double thickness = 0.3e-3, width = 0.1, height = 0.07;
// Orthonormal: the sheets lie across all axes.
constexpr Vector e1{2. / 3, 2. / 3, 1. / 3}, e2{-2. / 3, 1. / 3, 2. / 3};

double dot(const Vector &a, const Vector &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A sheet in the plane of e1 and e2 of distorted cells.
void make_sheet(const unsigned int n, Mesh &mesh)
{
  dealii::Triangulation<2> flat;
  dealii::GridGenerator::subdivided_hyper_rectangle(flat, {n, n}, dealii::Point<2>(), dealii::Point<2>(width, height));
  dealii::GridTools::distort_random(0.2, flat, /*keep_boundary=*/true, /*seed=*/3);
  dealii::GridGenerator::flatten_triangulation(flat, mesh);
  dealii::GridTools::transform(
      [](const dealii::Point<3> &x) {
        return dealii::Point<3>(x[0] * e1[0] + x[1] * e2[0], x[0] * e1[1] + x[1] * e2[1], x[0] * e1[2] + x[1] * e2[2]);
      },
      mesh);
}

MembraneBody sheet(const Rubber &law, const unsigned int n)
{
  Mesh mesh;
  make_sheet(n, mesh);
  return MembraneBody(mesh, {.material = law, .thickness = thickness});
}

/// Stretches a sheet along e1 and e2.
void stretch(MembraneBody &body, const double along_1, const double along_2)
{
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const Vector &x = body.node_position()[node];
    for (int i = 0; i < 3; ++i)
      body.displacement()[3 * node + i] = (along_1 - 1) * dot(x, e1) * e1[i] + (along_2 - 1) * dot(x, e2) * e2[i];
  }
}

void make_quadrilaterals(const std::vector<Vector> &vertices, const std::vector<std::array<unsigned int, 4>> &cells,
                         Mesh &mesh)
{
  std::vector<dealii::Point<3>> points;
  for (const Vector &x : vertices)
    points.emplace_back(x[0], x[1], x[2]);
  std::vector<dealii::CellData<2>> data;
  for (const auto &cell : cells)
    std::copy(cell.begin(), cell.end(), data.emplace_back().vertices.begin());
  mesh.create_triangulation(points, data, dealii::SubCellData());
}

template <class Law>
void check_uniform_stretch(const Law &law)
{
  MembraneBody body = sheet(law, 4);
  const double s1 = 1.6, s2 = 0.9, s3 = 1 / (s1 * s2);
  stretch(body, s1, s2);
  body.compute_internal_force();
  const double across = law.principal_slope(s3 * s3);
  const double principal[2] = {law.principal_slope(s1 * s1) - across, law.principal_slope(s2 * s2) - across};
  const double rounding = 1e-11 * law.shear_modulus();
  const double energy = law.principal_energy(s1 * s1) + law.principal_energy(s2 * s2) + law.principal_energy(s3 * s3);
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    const ElementState state = body.state_of(e);
    for (int c = 0; c < 6; ++c)
      CHECK(state.stress[c] ==
            Approx(principal[0] * e1[row[c]] * e1[column[c]] + principal[1] * e2[row[c]] * e2[column[c]])
                .margin(rounding));
    CHECK(state.energy_density == Approx(energy).epsilon(1e-11));
    const MembraneState in_plane = body.membrane_state_of(e);
    CHECK(in_plane.principal_stress[0] == Approx(principal[0]).margin(rounding));
    CHECK(in_plane.principal_stress[1] == Approx(principal[1]).margin(rounding));
    CHECK(in_plane.thickness == Approx(thickness * s3).epsilon(1e-12));
  }
  const std::vector<unsigned int> rim = body.boundary_nodes(0);
  CHECK(rim.size() == 16);
  double pull = 0; // of half the rim, along e1: nominal stress times section
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    if (std::binary_search(rim.begin(), rim.end(), node))
    {
      if (dot(body.node_position()[node], e1) > width * (1 - 1e-9))
        for (int i = 0; i < 3; ++i)
          pull += body.internal_force()[3 * node + i] * e1[i];
    }
    else
      for (int i = 0; i < 3; ++i)
        CHECK(std::abs(body.internal_force()[3 * node + i]) < rounding * thickness * width);
  CHECK(pull == Approx(principal[0] / s1 * thickness * height).epsilon(1e-11));
}

} // namespace

TEST_CASE("a body of membranes, patch test: an even stretch gives its stress, energy and thickness anywhere", "[fe]")
{
  for_each_law([](const auto &law) { check_uniform_stretch(law); });
}

TEST_CASE("a membrane's stress and thickness are those of its last forces, wherever it has moved since", "[fe]")
{
  MembraneBody body = sheet(neo_hooke(), 2);
  stretch(body, 1.3, 1.1);
  body.compute_internal_force();
  const MembraneState before = body.membrane_state_of(0);
  stretch(body, 2, 1.1);
  CHECK(body.membrane_state_of(0).thickness == before.thickness);
  CHECK(body.membrane_state_of(0).principal_stress == before.principal_stress);
  body.compute_internal_force();
  CHECK(body.membrane_state_of(0).thickness < 0.9 * before.thickness);
}

TEST_CASE("the lumped mass of membranes is positive and makes up the sheet's", "[fe]")
{
  const MembraneBody body = sheet(neo_hooke(), 5);
  CHECK(*std::min_element(body.mass().begin(), body.mass().end()) > 0);
  CHECK(std::accumulate(body.mass().begin(), body.mass().end(), 0.) / 3 ==
        Approx(rubber.density * width * height * thickness).epsilon(1e-12));
}

TEST_CASE("the bound of the stable step of membranes against the true one: flat, stretched and slack", "[fe]")
{
  for_each_law(
      [](const auto &law)
      {
        for (const double along : {0.8, 1., 1.8})
        {
          MembraneBody body = sheet(law, 3);
          stretch(body, along, along < 1 ? along : 1.2);
          const unsigned int n = 3 * body.n_nodes();
          dealii::LAPACKFullMatrix<double> matrix(n);
          std::vector<double> k(12 * 12);
          for (std::size_t e = 0; e < body.n_elements(); ++e)
          {
            body.elements().stiffness(e, body.displacement().data(), k.data());
            const auto nodes = body.element_nodes(e);
            for (std::size_t i = 0; i < 12; ++i)
              for (std::size_t j = 0; j < 12; ++j)
              {
                const unsigned int r = 3 * nodes[i / 3] + i % 3, c = 3 * nodes[j / 3] + j % 3;
                matrix(r, c) += k[12 * i + j] / std::sqrt(body.mass()[r] * body.mass()[c]);
              }
          }
          matrix.compute_eigenvalues();
          double largest = 0;
          for (unsigned int i = 0; i < n; ++i)
            largest = std::max(largest, matrix.eigenvalue(i).real());
          const double bound = stable_step(body).time_step * std::sqrt(largest) / 2;
          CAPTURE(along, bound);
          CHECK(bound <= 1 + 1e-6);
          CHECK(bound > 0.6);
        }
      });
}

TEST_CASE("the stiffness of membranes is the derivative of their forces, with the part of the stress", "[fe]")
{
  MembraneBody body = sheet(mooney_rivlin(), 1);
  stretch(body, 1.5, 1.2);
  std::vector<double> k(12 * 12);
  body.elements().stiffness(0, body.displacement().data(), k.data());
  // Across its plane a stretched square is a net of strings; without the part of the stress it resists nothing.
  const Vector normal{1. / 3, -2. / 3, 2. / 3};
  double corner = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      corner += normal[i] * k[12 * i + j] * normal[j];
  body.compute_internal_force();
  const ElementState state = body.state_of(0);
  double s1 = 0, s2 = 0;
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int c = 0; c < 6; ++c)
  {
    s1 += (c < 3 ? 1 : 2) * state.stress[c] * e1[row[c]] * e1[column[c]];
    s2 += (c < 3 ? 1 : 2) * state.stress[c] * e2[row[c]] * e2[column[c]];
  }
  // ∫ σ : ∇N ⊗ ∇N dv of the bilinear function of a corner of an a × b rectangle, t (σ1 b/a + σ2 a/b)/3.
  const double a = 1.5 * width, b = 1.2 * height, t = thickness / (1.5 * 1.2);
  CHECK(corner == Approx(t * (s1 * b / a + s2 * a / b) / 3).epsilon(1e-6));
}

TEST_CASE("the surface of a closed membrane points outwards, and its pressure is the slope of its volume", "[fe]")
{
  double error[2];
  for (const unsigned int k : {0u, 1u})
  {
    Mesh mesh;
    dealii::GridGenerator::hyper_sphere(mesh, dealii::Point<3>(0.1, 0.2, 0.3), 0.05);
    mesh.refine_global(2 + k);
    MembraneBody body(mesh, {});
    const Surface surface = membrane_surface(body.dof_handler());
    REQUIRE(surface.size() == body.n_elements());
    std::map<std::pair<unsigned int, unsigned int>, int> edges;
    for (const auto &t : triangles(surface))
      for (int i = 0; i < 3; ++i)
        ++edges[{t[i], t[(i + 1) % 3]}];
    for (const auto &[edge, count] : edges)
    {
      REQUIRE(count == 1);
      REQUIRE(edges.count({edge.second, edge.first}) == 1);
    }
    const SurfaceLoad load(surface, body.node_position());
    error[k] = load.volume(body.displacement()) / (4. / 3 * std::numbers::pi * std::pow(0.05, 3)) - 1;
    CHECK(error[k] < 0); // flat cells lie inside
    std::vector<double> force(3 * body.n_nodes(), 0.);
    load.add_pressure(1, body.displacement(), force);
    for (const std::size_t dof : {0ul, 7ul, 50ul})
    {
      const double step = 1e-5;
      body.displacement()[dof] = step;
      const double more = load.volume(body.displacement());
      body.displacement()[dof] = -step;
      const double less = load.volume(body.displacement());
      body.displacement()[dof] = 0;
      // The volume is linear in each coordinate; what is left is its rounding over the step.
      CHECK(-force[dof] == Approx((more - less) / (2 * step)).margin(1e-15 * 5e-4 / step));
    }
  }
  CHECK(std::log2(error[0] / error[1]) == Approx(2).margin(0.1));
}

TEST_CASE("cells ordered against each other get one side all the same; a band with one side only is refused", "[fe]")
{
  Mesh mesh;
  const std::vector<Vector> ladder{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  make_quadrilaterals(ladder, {{0, 2, 1, 3}, {2, 3, 4, 5}}, mesh);
  const MembraneBody body(mesh, {});
  const SurfaceLoad load(membrane_surface(body.dof_handler()), body.node_position());
  std::vector<double> force(3 * body.n_nodes(), 0.);
  load.add_pressure(1, body.displacement(), force);
  double resultant = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    resultant += force[3 * node + 2];
  CHECK(std::abs(resultant) == Approx(2));

  // Möbius' band: five cells, the last one joined to the first upside down. Pressure on it means nothing.
  std::vector<Vector> vertices;
  for (int k = 0; k < 5; ++k)
    for (const double side : {-0.2, 0.2})
    {
      const double angle = 2 * std::numbers::pi * k / 5, out = 1 + side * std::cos(angle / 2);
      vertices.push_back({out * std::cos(angle), out * std::sin(angle), side * std::sin(angle / 2)});
    }
  Mesh band;
  const auto use_band = [&]
  {
    make_quadrilaterals(vertices, {{0, 1, 2, 3}, {2, 3, 4, 5}, {4, 5, 6, 7}, {6, 7, 8, 9}, {8, 9, 1, 0}}, band);
    membrane_surface(MembraneBody(band, {}).dof_handler());
  };
  CHECK_THROWS_WITH(use_band(), Catch::Contains("cells 0 and 4 at (") && Catch::Contains("one side only"));
}

TEST_CASE("a membrane falls freely, and one that collapses ends the run with its place", "[fe]")
{
  Mesh mesh;
  make_sheet(3, mesh);
  MembraneBody body(mesh, {.thickness = thickness, .gravity = {0, 0, -9.81}});
  const double dt = 0.5 * stable_step(body).time_step;
  for (int k = 0; k < 10; ++k)
  {
    body.compute_internal_force();
    body.kick(dt);
    body.drift(dt);
  }
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    CHECK(body.displacement()[3 * node + 2] == Approx(-9.81 * dt * dt * 55).epsilon(1e-9));
  for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof) // all into one point
    body.displacement()[dof] = 1. + double(dof % 3) - body.node_position()[dof / 3][dof % 3];
  CHECK_THROWS_WITH(body.compute_internal_force(),
                    Catch::Contains("membrane: element 0 at (1, 2, 3) m") && Catch::Contains("collapsed"));
}

TEST_CASE("a membrane's file has its stresses, thickness and energy, or is not there", "[fe]")
{
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "membrane.vtu";
  MembraneBody body = sheet(neo_hooke(), 2);
  stretch(body, 1.3, 1.1);
  body.compute_internal_force();
  write_vtu(body, path);
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  for (const char *name :
       {"displacement", "velocity", "principal_stress_1", "principal_stress_2", "thickness", "elastic_energy_density"})
    CHECK_THAT(text.str(), Catch::Contains('"' + std::string(name) + '"'));
  CHECK_THAT(text.str(), Catch::Contains("</VTKFile>"));
  CHECK_FALSE(std::filesystem::exists(path.string() + ".part"));
  CHECK_THROWS_AS(write_vtu(body, folder.path() / "nowhere" / "membrane.vtu"), RunError);
}

TEST_CASE("bad input of membranes is refused", "[fe]")
{
  Mesh mesh;
  make_sheet(2, mesh);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {0., -1e-3, nan, infinite})
    CHECK_THROWS_WITH(MembraneBody(mesh, {.thickness = bad}),
                      Catch::Contains("membrane: thickness [m] = ") && Catch::Contains("positive"));
  CHECK_THROWS_WITH(MembraneBody(mesh, {.gravity = {0, nan, 0}}), Catch::Contains("membrane: gravity component 1"));
  CHECK_THROWS_WITH(MembraneBody(mesh, {.damping = -1}), Catch::Contains("membrane: damping = -1"));
  CHECK_THROWS_WITH(MembraneBody(Mesh(), {}), Catch::Contains("no cells"));
  Mesh triangle;
  dealii::CellData<2> corners(3);
  corners.vertices = {0, 1, 2};
  triangle.create_triangulation({dealii::Point<3>(0, 0, 0), dealii::Point<3>(1, 0, 0), dealii::Point<3>(0, 1, 0)},
                                {corners}, dealii::SubCellData());
  CHECK_THROWS_WITH(MembraneBody(triangle, {}), Catch::Contains("quadrilaterals"));
  Mesh hanging;
  make_sheet(2, hanging);
  hanging.begin_active()->set_refine_flag();
  hanging.execute_coarsening_and_refinement();
  CHECK_THROWS_WITH(MembraneBody(hanging, {}), Catch::Contains("hanging nodes"));

  const std::vector<Vector> line{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}};
  Mesh degenerate;
  make_quadrilaterals(line, {{0, 1, 2, 3}}, degenerate);
  CHECK_THROWS_WITH(MembraneBody(degenerate, {}), Catch::Contains("cell 0 at (") && Catch::Contains("degenerate") &&
                                                      Catch::Contains("repair the mesh"));
  Mesh folded;
  make_quadrilaterals({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, folded);
  CHECK_THROWS_WITH(MembraneBody(folded, {}), Catch::Contains("folded over"));

  MembraneBody body(mesh, {});
  CHECK_THROWS_WITH(body.boundary_nodes(7), Catch::Contains("membrane: the mesh has no boundary 7; it has 0"));
  CHECK_THROWS_WITH(body.prescribe_velocity(7, 0), Catch::Contains("no boundary 7"));
  CHECK_THROWS_WITH(body.prescribe_velocity(0, 3), Catch::Contains("membrane: component 3"));
  CHECK_THROWS_WITH(body.elements().set_share(std::vector<double>(body.n_nodes(), 1.)), Catch::Contains("membrane"));
}
