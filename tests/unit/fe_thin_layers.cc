// Where a body is so thin that plain elements of 8 nodes cannot bend as they should.

#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/thin_layers.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace bergamo::fe;

namespace
{

ExplicitBody plate(const BoxMeshParameters &shape, const Hourglass hourglass = Hourglass::at_points,
                   const unsigned int degree = 1)
{
  ExplicitBodyParameters parameters;
  parameters.material = LinearElastic({});
  parameters.degree = degree;
  parameters.kind.hourglass = hourglass;
  return make_box_body(shape, parameters);
}

/// 8 × 4 × 1 m of n elements over the thickness, each 2 m long.
BoxMeshParameters of_layers(const unsigned int n)
{
  return {{0, 0, 0}, {8, 4, 1}, {4, 2, n}};
}

} // namespace

TEST_CASE("plates are thin with one element over the thickness, or with long ones", "[fe]")
{
  for (const unsigned int n : {1u, 2u, 5u}) // 2 m in a thickness of 1 m
  {
    const ThinLayers thin = thin_layers(plate(of_layers(n)));
    CHECK(thin.n_elements == 8 * n);
    CHECK(thin.n_layers == int(n));
    CHECK(thin.thickness == Approx(1));
    CHECK(thin.length == Approx(2));
  }
  CHECK(thin_layers(plate({{0, 0, 0}, {8, 4, 1}, {80, 40, 1}})).n_elements == 3200); // short, but alone
  CHECK(thin_layers(plate({{0, 0, 0}, {8, 4, 1}, {16, 8, 2}})).n_elements == 0);     // half of the thickness
  CHECK(thin_layers(plate({{0, 0, 0}, {8, 4, 1}, {15, 8, 2}})).n_elements == 240);   // a little more
}

TEST_CASE("elements that bend are in no thin layer", "[fe]")
{
  CHECK(thin_layers(plate(of_layers(1), Hourglass::bending)).n_elements == 0);
  CHECK(thin_layers(plate(of_layers(1), Hourglass::at_points, 2)).n_elements == 0);
  ExplicitBodyParameters parameters;
  parameters.material = NeoHooke({});
  CHECK(thin_layers(make_box_body(of_layers(1), parameters)).n_elements == 8);
  parameters.kind.hourglass = Hourglass::bending;
  CHECK(thin_layers(make_box_body(of_layers(1), parameters)).n_elements == 0);
}

TEST_CASE("a stubby body is not thin, however few its elements", "[fe]")
{
  CHECK(thin_layers(plate({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}})).n_elements == 0);
  CHECK(thin_layers(plate({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}})).n_elements == 0);
}

TEST_CASE("a layer that is held across one of its surfaces does not bend", "[fe]")
{
  ExplicitBody body = plate(of_layers(1));
  body.prescribe_velocity(4u, 0); // along
  CHECK(thin_layers(body).n_elements == 8);
  std::vector<unsigned int> below = body.boundary_nodes(4);
  below.pop_back();
  body.prescribe_velocity(below, 2);
  const std::size_t at_the_free_node = thin_layers(body).n_elements;
  CHECK(at_the_free_node >= 1);
  CHECK(at_the_free_node <= 4);
  body.prescribe_velocity(4u, 2);
  CHECK(thin_layers(body).n_elements == 0);

  // Plane strain: one element between two planes.
  ExplicitBody strip = plate({{0, 0, 0}, {8, 1, 8}, {8, 1, 8}});
  CHECK(thin_layers(strip).n_elements == 64);
  for (const unsigned int side : {2u, 3u})
    strip.prescribe_velocity(side, 1);
  CHECK(thin_layers(strip).n_elements == 0);
}

TEST_CASE("rigid elements do not bend", "[fe]")
{
  ExplicitBody body = plate(of_layers(1));
  const auto nodes = body.element_nodes(3);
  body.make_rigid(nodes);
  CHECK(thin_layers(body).n_elements == 7);
}
