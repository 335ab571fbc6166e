#include "coupling/adapter/cell_stress.h"
#include "dem/measure/stress.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "tests/verification/pressed_model.h"

#include <catch2/catch.hpp>
#include <deal.II/grid/tria.h>

#include <algorithm>

using namespace bergamo;
using coupling::CellStress;

TEST_CASE("cells have an element's stress, component by component, by the part of it in them, where it is now")
{
  // Four elements of 1 x 1 x 1 along x, moved by 0.25 along x and 0.5 along z. Cells of 1.25 x 1 x 0.75.
  dealii::Triangulation<3> mesh;
  fe::make_box({{0., 0., 0.}, {4., 1., 1.}, {4, 1, 1}}, mesh);
  fe::ExplicitBodyParameters parameters;
  parameters.material = fe::LinearElastic({.young_modulus = 1e9, .poisson_ratio = 0.2});
  const fe::Stress stress{-1e3, -2e3, -3e3, 100., 200., 300.};
  parameters.initial_stress = [&](const auto &) { return stress; };
  auto body = std::make_unique<fe::ExplicitBody>(mesh, parameters);
  for (std::size_t dof = 0; dof < body->displacement().size(); dof += 3)
  {
    body->displacement()[dof] = 0.25;
    body->displacement()[dof + 2] = 0.5;
  }
  coupling::TwoScaleModel model(nullptr, std::move(body), 1e-6);
  model.compute_forces();
  const dem::HexahedronGrid grid{{Vec3(0., -1., 0.), Vec3(5., 1., 1.5)}, {4, 1, 2}};
  const std::vector<CellStress> cells = coupling::cell_stresses(model, grid);
  Mat3 expected;
  expected << stress[0], stress[3], stress[5], stress[3], stress[1], stress[4], stress[5], stress[4], stress[2];
  const double across = 0.5; // the cells are twice as deep as the body
  const double along[] = {0.8, 1., 1., 0.4}, upwards[] = {1. / 3., 1.};
  for (int z = 0; z < 2; ++z)
    for (int x = 0; x < 4; ++x)
    {
      CAPTURE(x, z);
      const CellStress &cell = cells[x + 4 * z];
      CHECK((cell.total() - across * along[x] * upwards[z] * expected).norm() < 1e-9 * expected.norm());
      CHECK(cell.grains == Mat3::Zero());
    }
}

TEST_CASE("through an overlap cells have the continuum's stress with its share of each height")
{
  // All of it in the lower third, none in the upper one, linear between. Cells that do not go with elements: two of
  // five layers are cut by the ends of the overlap.
  coupling::TwoScaleModel model = test::make_pressed_model({});
  model.compute_forces();
  const auto &places = model.body()->node_position();
  Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
  for (const auto &place : places)
    for (int d = 0; d < 3; ++d)
    {
      low[d] = std::min(low[d], place[d]);
      high[d] = std::max(high[d], place[d]);
    }
  high[2] += 0.5 * (high[2] - low[2]); // grains alone
  const dem::HexahedronGrid grid{{low, high}, {2, 2, 5}};
  const std::vector<CellStress> cells = coupling::cell_stresses(model, grid);
  const auto share_below = [](const double z) // integral of the share up to z, both over the height of all
  {
    const double third = 1. / 3., inside = std::clamp(z - third, 0., third);
    return std::min(z, third) + inside - 0.5 * inside * inside / third;
  };
  Mat3 grains = Mat3::Zero();
  for (int k = 0; k < 20; ++k)
  {
    const int layer = k / 4;
    const double share = 5. * (share_below(0.2 * (layer + 1)) - share_below(0.2 * layer));
    CAPTURE(k, share);
    // Parts of an element have the share of their middle. A layer's end cuts one part in 0.8 and 0.2: shares off by a
    // tenth of what they change by in it, 1/4, over 0.8 / 12 of the height of 1/5.
    CHECK(dem::pressure(cells[k].continuum) == Approx(share * test::confining_pressure).margin(0.01 * 1e5));
    grains += cells[k].grains * grid.box.volume() / 20.;
  }
  const dem::Simulation &sand = *model.grains();
  const Mat3 all = dem::force_moment(sand.contacts.touching(sand.particles)) +
                   dem::force_moment(sand.contacts.touching_walls(sand.particles));
  CHECK((grains - all).norm() < 0.01 * all.norm()); // but for grains that reach out of the box by a bit
}
