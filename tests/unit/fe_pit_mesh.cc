#include "dem/core/error.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/pit_mesh.h"

#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <numeric>

using namespace bergamo;
using namespace bergamo::fe;
using Catch::Matchers::Contains;

namespace
{

/// 5 x 2 x 3 bricks of several sizes; the middle three of the upper two layers are taken out.
PitMeshParameters pit()
{
  return {{{{-3., -1., -0.5, 0.5, 1., 3.}, {0., 1., 3.}, {0., 0.5, 1., 2.}}}, {-1., -10., 0.5}, {1., 10., 10.}};
}

ExplicitBody body_of(const PitMeshParameters &parameters)
{
  dealii::Triangulation<3> mesh;
  make_pit(parameters, mesh);
  return ExplicitBody(mesh, {});
}

} // namespace

TEST_CASE("Pit mesh: bricks between planes but for a hole, with its own boundary", "[fe]")
{
  const PitMeshParameters parameters = pit();
  const ExplicitBody body = body_of(parameters);
  CHECK(body.n_elements() == 5 * 2 * 3 - 3 * 2 * 2);
  CHECK(body.n_nodes() == 6 * 3 * 4 - 2 * 3 * 2); // none is left in the hole
  double volume = 0;
  for (std::size_t element = 0; element < body.n_elements(); ++element)
    volume += body.elements().volume(element);
  CHECK(volume == Approx(6. * 3. * 2. - 2. * 3. * 1.5));
  for (unsigned int id = 0; id < 6; ++id)
  {
    const auto &planes = parameters.planes[id / 2];
    for (const unsigned int node : body.boundary_nodes(id))
      CHECK(body.node_position()[node][id / 2] == Approx(id % 2 ? planes.back() : planes.front()).margin(1e-12));
  }
  CHECK(body.boundary_nodes(5).size() == 4 * 3); // the top, on both sides of the pit
  CHECK(body.boundary_nodes(pit_faces).size() == (4 + 2 * 2) * 3);
  for (const unsigned int node : body.boundary_nodes(pit_faces))
  {
    const auto &x = body.node_position()[node];
    CHECK((std::abs(std::abs(x[0]) - 1.) < 1e-12 || std::abs(x[2] - 0.5) < 1e-12));
  }
}

TEST_CASE("Pit mesh: a hole of no size takes nothing, bad parameters are named", "[fe]")
{
  PitMeshParameters parameters = pit();
  parameters.hole_maximum = parameters.hole_minimum;
  CHECK(body_of(parameters).n_elements() == 30);
  dealii::Triangulation<3> mesh;
  parameters = pit();
  parameters.planes[2] = {0., 1., 1.};
  CHECK_THROWS_WITH(make_pit(parameters, mesh), Contains("across z a plane at 1 m follows one at 1 m"));
  parameters = pit();
  parameters.planes[1] = {0.};
  CHECK_THROWS_WITH(make_pit(parameters, mesh), Contains("1 planes across y"));
  parameters = pit();
  parameters.hole_maximum[0] = -2.;
  CHECK_THROWS_WITH(make_pit(parameters, mesh), Contains("the hole reaches along x from -1 to -2 m"));
  parameters = pit();
  parameters.hole_minimum = {-10., -10., -10.};
  parameters.hole_maximum = {10., 10., 10.};
  CHECK_THROWS_WITH(make_pit(parameters, mesh), Contains("leaves no brick"));
  parameters = pit();
  parameters.hole_minimum[2] = -10.; // through the bottom: two pieces
  CHECK_THROWS_AS(make_pit(parameters, mesh), ConfigError);
}

TEST_CASE("Pit mesh: planes of steps that grow evenly fill a length", "[fe]")
{
  CHECK(graded_planes(0., 1., 1.2) == std::vector<double>{0.});
  CHECK(graded_planes(4., 1., 1.).size() == 5);
  const std::vector<double> planes = graded_planes(10., 1., 1.5);
  REQUIRE(planes.size() == 6); // 1 + 1.5 + 2.25 + 3.375 + 5.0625 is the first sum above 10
  CHECK(planes.back() == 10.);
  CHECK(planes[1] == Approx(10. / 13.1875));
  for (std::size_t k = 2; k < planes.size(); ++k)
    CHECK(planes[k] - planes[k - 1] == Approx(1.5 * (planes[k - 1] - planes[k - 2])));
}
