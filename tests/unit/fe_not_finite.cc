// What is no finite number stops a body in the step in which it comes, with element, place and time.

#include "dem/core/error.h"
#include "fe_dealii/conditions/rigid_boundary.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/membrane_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>

using namespace bergamo;
using namespace bergamo::fe;
using Catch::Matchers::Contains;

namespace
{

using Maker = std::function<std::unique_ptr<MovingBody>()>;

/// A row of four elements of 1 m along x.
Maker row_of(const Material &material, const unsigned int degree)
{
  return [material, degree]
  {
    ExplicitBodyParameters parameters;
    parameters.material = material;
    parameters.degree = degree;
    return std::make_unique<ExplicitBody>(make_box_body({{0, 0, 0}, {4, 1, 1}, {4, 1, 1}}, parameters));
  };
}

std::unique_ptr<MovingBody> sheet()
{
  dealii::Triangulation<2> flat;
  dealii::GridGenerator::subdivided_hyper_rectangle(flat, {4, 1}, dealii::Point<2>(), dealii::Point<2>(4, 1), true);
  dealii::Triangulation<2, 3> mesh;
  dealii::GridGenerator::flatten_triangulation(flat, mesh);
  return std::make_unique<MembraneBody>(mesh, MembraneBodyParameters{});
}

Maker any_body()
{
  return GENERATE(row_of(LinearElastic({}), 1), row_of(LinearElastic({}), 2), row_of(MohrCoulomb({}), 1),
                  row_of(MohrCoulomb({.reference_pressure = 1e5}), 1), row_of(MohrCoulomb({}), 2),
                  row_of(NeoHooke(ElasticParameters{}), 1), row_of(NeoHooke(ElasticParameters{}), 2),
                  row_of(Ogden({}), 1), Maker(sheet));
}

/// A node of the last element alone.
unsigned int node_at_the_end(const MovingBody &body)
{
  for (unsigned int node = 0; node < body.n_nodes(); ++node)
    if (body.node_position()[node][0] > 3.999)
      return node;
  return 0;
}

void step(MovingBody &body, const double dt)
{
  body.compute_internal_force();
  body.kick(dt);
  body.drift(dt);
}

} // namespace

TEST_CASE("a displacement that is no number stops the step that meets it, whatever element and law", "[fe]")
{
  const std::unique_ptr<MovingBody> body = any_body()();
  const double wrong = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  for (int k = 0; k < 4; ++k)
    step(*body, 0.25e-5);
  body->displacement()[3 * node_at_the_end(*body) + 1] = wrong;
  CHECK_THROWS_WITH(body->compute_internal_force(), Contains("element 3 at (3.5, 0.5, ") &&
                                                        Contains("at time 1e-05 s") && Contains("smaller time step"));
}

TEST_CASE("a load or a motion that is no number stops the kick", "[fe]")
{
  const std::unique_ptr<MovingBody> body = any_body()();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const unsigned int node[] = {node_at_the_end(*body)};
  step(*body, 1e-5);
  body->compute_internal_force();
  SECTION("a load on a free node")
  {
    body->external_force()[3 * node[0] + 2] = nan;
    CHECK_THROWS_WITH(body->kick(1e-5),
                      Contains("element 3 at (3.5, 0.5, ") && Contains("at time 1e-05 s") && Contains("under nan N"));
  }
  SECTION("a load on a held node")
  {
    body->prescribe_velocity(node, 2, 0.5);
    body->external_force()[3 * node[0] + 2] = nan;
    CHECK_THROWS_WITH(body->kick(1e-5), Contains("element 3 at") && Contains("under nan N"));
  }
  SECTION("a prescribed velocity")
  {
    body->prescribe_velocity(node, 2, nan);
    CHECK_THROWS_WITH(body->kick(1e-5), Contains("element 3 at") && Contains("at nan m/s"));
  }
}

TEST_CASE("there is no stable step where an element's stiffness is no number", "[fe]")
{
  const std::unique_ptr<MovingBody> body =
      GENERATE(row_of(NeoHooke(ElasticParameters{}), 1), row_of(Ogden({}), 2), Maker(sheet))();
  CHECK(std::isfinite(stable_step(*body).time_step));
  body->displacement()[3 * node_at_the_end(*body)] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(stable_step(*body), Contains("element 3 at (3.5, 0.5, ") && Contains("stiffness"));
  CHECK_THROWS_AS(require_stable(*body, 1e-9), RunError);
}

TEST_CASE("a stress that is no number stops the next step, and a stiffness by pressure has no stable step", "[fe]")
{
  const std::unique_ptr<MovingBody> body = row_of(MohrCoulomb({.reference_pressure = 1e5}), 1)();
  for (auto &[name, values] : body->state())
    if (name == "element_history")
      values[values.size() / 4 * 2 + 1] = std::numeric_limits<double>::quiet_NaN(); // of element 2
  CHECK_THROWS_WITH(stable_step(*body), Contains("element 2 at (2.5, 0.5, 0.5) m"));
  CHECK_THROWS_WITH(body->compute_internal_force(), Contains("element 2 at (2.5, 0.5, 0.5) m"));
}
