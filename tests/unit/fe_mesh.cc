#include "dem/core/error.h"
#include "fe_dealii/boundary/surface.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/output.h"

#include "tests/temporary_folder.h"

#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace bergamo;
using namespace bergamo::fe;
using Catch::Matchers::Contains;

namespace
{

ExplicitBody box(const BoxMeshParameters &mesh, const ExplicitBodyParameters &parameters = {})
{
  dealii::Triangulation<3> triangulation;
  make_box(mesh, triangulation);
  return ExplicitBody(triangulation, parameters);
}

} // namespace

TEST_CASE("Box mesh: size, boundaries and outward faces", "[fe]")
{
  const BoxMeshParameters mesh{{-1, 0, 2}, {1, 3, 6}, {2, 3, 4}};
  const ExplicitBody body = box(mesh);
  CHECK(body.n_elements() == 24);
  CHECK(body.n_nodes() == 3 * 4 * 5);
  for (unsigned int id = 0; id < 6; ++id)
  {
    const unsigned int axis = id / 2;
    const double plane = id % 2 ? mesh.maximum[axis] : mesh.minimum[axis];
    for (const unsigned int node : body.boundary_nodes(id))
      CHECK(body.node_position()[node][axis] == Approx(plane));
    const Surface surface = boundary_surface(body.dof_handler(), id);
    for (const auto &face : triangles(surface))
    {
      const auto &a = body.node_position()[face[0]], &b = body.node_position()[face[1]],
                 &c = body.node_position()[face[2]];
      const unsigned int j = (axis + 1) % 3, k = (axis + 2) % 3;
      const double normal = (b[j] - a[j]) * (c[k] - b[k]) - (b[k] - a[k]) * (c[j] - b[j]);
      CHECK((id % 2 ? normal : -normal) > 0);
    }
  }
  CHECK(body.boundary_nodes(4).size() == 12);
  CHECK(boundary_surface(body.dof_handler(), 1).size() == 12);

  double mass = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    mass += body.mass()[3 * node];
  CHECK(mass == Approx(24 * density(body.material())));
}

TEST_CASE("Box mesh: bricks that grow along an axis", "[fe]")
{
  const ExplicitBody body = box({{0, 0, 0}, {1, 1, 15}, {1, 2, 4}, {1, 1, 8}});
  std::vector<double> height;
  for (const auto &x : body.node_position())
    if (x[0] == 0 && x[1] == 0)
      height.push_back(x[2]);
  std::sort(height.begin(), height.end());
  const std::vector<double> expected{0, 1, 3, 7, 15};
  REQUIRE(height.size() == expected.size());
  for (std::size_t k = 0; k < height.size(); ++k)
    CHECK(height[k] == Approx(expected[k]).margin(1e-12));
}

TEST_CASE("boundary nodes of quadratic elements include those on edges and faces", "[fe]")
{
  ExplicitBodyParameters parameters;
  parameters.degree = 2;
  const ExplicitBody body = box({{0, 0, 0}, {1, 1, 1}, {2, 3, 1}}, parameters);
  CHECK(body.boundary_nodes(5).size() == 5 * 7);
  for (const unsigned int node : body.boundary_nodes(5))
    CHECK(body.node_position()[node][2] == 1);
}

TEST_CASE("Mesh and body: user's mistakes are named", "[fe]")
{
  CHECK_THROWS_WITH(box({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}, {1, -2, 1}}), Contains("grading along y = -2"));
  CHECK_THROWS_WITH(box({{0, 0, 0}, {1, 0, 1}, {1, 1, 1}}), Contains("along y"));
  CHECK_THROWS_WITH(box({{0, 0, 0}, {1, 1, NAN}, {1, 1, 1}}), Contains("along z"));
  CHECK_THROWS_WITH(box({{0, 0, 0}, {1, 1, 1}, {0, 1, 1}}), Contains("subdivisions along x"));
  CHECK_THROWS_AS(box({{0, 0, 0}, {1, 1, 1}, {0, 1, 1}}), ConfigError);

  dealii::Triangulation<3> mesh;
  CHECK_THROWS_WITH(ExplicitBody(mesh, {}), Contains("no cells"));
  make_box({}, mesh);
  CHECK_THROWS_WITH(make_box({}, mesh), Contains("already holds"));
  mesh.begin_active()->vertex(0) = dealii::Point<3>(2, 2, 2);
  CHECK_THROWS_WITH(ExplicitBody(mesh, {}), Contains("inside out"));

  dealii::Triangulation<3> hanging;
  make_box({{0, 0, 0}, {2, 1, 1}, {2, 1, 1}}, hanging);
  hanging.begin_active()->set_refine_flag();
  hanging.execute_coarsening_and_refinement();
  CHECK_THROWS_WITH(ExplicitBody(hanging, {}), Contains("hanging"));

  ExplicitBodyParameters parameters;
  parameters.damping = -1;
  CHECK_THROWS_WITH(box({}, parameters), Contains("damping"));
  parameters = {};
  parameters.initial_stress = uniform_pressure(-1e3);
  CHECK_THROWS_WITH(box({}, parameters), Contains("initial stress at") && Contains("beyond the yield surface"));
  parameters = {};
  parameters.gravity[1] = NAN;
  CHECK_THROWS_WITH(box({}, parameters), Contains("gravity"));

  ExplicitBody body = box({});
  CHECK_THROWS_WITH(body.prescribe_velocity(7u, 0), Contains("no boundary 7"));
  CHECK_THROWS_WITH(body.prescribe_velocity(0u, 3), Contains("component 3"));
  const unsigned int far_node = 8;
  CHECK_THROWS_WITH(body.prescribe_velocity(std::span(&far_node, 1), 0), Contains("node 8"));
  CHECK_THROWS_WITH(body.set_share(std::vector<double>(7, 0.)), Contains("7 nodal weights"));
  CHECK_THROWS_WITH(body.set_share(std::vector<double>(8, 1.5)), Contains("node 0 is 1.5"));
  CHECK_THROWS_WITH(body.set_share(std::vector<double>(8, 1.)), Contains("no element with a share"));
  CHECK(body.mass()[0] > 0); // the refused share changed nothing
}

TEST_CASE("VTU output: no leftovers, a clear error", "[fe]")
{
  const TemporaryFolder folder;
  const ExplicitBody body = box({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  write_vtu(body, folder / "body.vtu");
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
  CHECK_THROWS_AS(write_vtu(body, folder / "missing" / "body.vtu"), RunError);
  CHECK_THROWS_WITH(write_vtu(body, folder / "missing" / "body.vtu"), Contains("missing"));
}
