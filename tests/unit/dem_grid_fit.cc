#include "dem/core/error.h"
#include "dem/measure/grid_fit.h"

#include <catch2/catch.hpp>

#include <random>

using namespace bergamo;
using namespace bergamo::dem;
using Catch::Matchers::Contains;

namespace
{

const HexahedronGrid grid{{Vec3(-1., 2., 0.), Vec3(3., 2.5, 6.)}, {4, 1, 5}};

/// Grains at random with values and volumes.
struct Cloud
{
  std::vector<Vec3> place, value;
  std::vector<double> volume;
};

template <class Field>
Cloud cloud(const Box &box, const int n, Field field)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform;
  Cloud c;
  for (int i = 0; i < n; ++i)
  {
    Vec3 share;
    for (double &s : share)
      s = uniform(random);
    c.place.push_back(box.low + share.cwiseProduct(box.edges()));
    c.value.push_back(field(c.place.back()));
    c.volume.push_back(0.5 + uniform(random));
  }
  return c;
}

GridFit fit_of(const Cloud &c, const HexahedronGrid &on = grid)
{
  GridFit fit(on);
  fit.add(c.place, c.volume, c.value);
  return fit;
}

Vec3 trilinear(const Vec3 &x)
{
  return Vec3(1. + x.x() - 2. * x.y(), 3. * x.z() - x.x() * x.y(), x.x() * x.y() * x.z());
}

double largest_miss(const std::vector<Vec3> &values)
{
  double miss = 0.;
  for (std::size_t node = 0; node < values.size(); ++node)
    miss = std::max(miss, (values[node] - trilinear(grid.node(static_cast<std::int32_t>(node)))).norm());
  return miss;
}

} // namespace

TEST_CASE("the shape functions of a grid are those of its nodes")
{
  REQUIRE(grid.n_nodes() == 60);
  REQUIRE(grid.size() == 20);
  double volume = 0.;
  for (std::int32_t node = 0; node < 60; ++node)
  {
    CHECK(grid.node_number(grid.node_along_axes(node)) == node);
    const auto shares = grid.shares_at(grid.node(node)); // the far faces belong to the grid
    REQUIRE(shares);
    for (int k = 0; k < 8; ++k)
      CHECK(shares->share[k] == Approx(shares->node[k] == node ? 1. : 0.).margin(1e-14));
    volume += grid.node_volume(node);
  }
  CHECK(volume == Approx(grid.box.volume()).epsilon(1e-14));
  CHECK_FALSE(grid.shares_at(Vec3(-1.01, 2.2, 1.)));
  CHECK_FALSE(grid.shares_at(Vec3(0., 2.2, 6.01)));
  CHECK_FALSE(grid.shares_at(Vec3(0., std::numeric_limits<double>::quiet_NaN(), 1.)));

  const Vec3 point(0.3, 2.1, 4.4);
  std::vector<Vec3> values;
  for (std::int32_t node = 0; node < 60; ++node)
    values.push_back(trilinear(grid.node(node)) - Vec3::UnitZ() * grid.node(node).prod()); // linear but for x y
  CHECK(value_at(grid, values, point).x() == Approx(trilinear(point).x()).epsilon(1e-13));
  CHECK_THROWS_WITH(value_at(grid, values, Vec3(9., 2., 1.)), Contains("(9, 2, 1)") && Contains("outside"));
}

TEST_CASE("a field that is linear along each axis is fitted exactly")
{
  const auto values = fit_of(cloud(grid.box, 400, trilinear)).solve();
  REQUIRE(values);
  CHECK(largest_miss(*values) < 1e-10); // values up to 45
}

TEST_CASE("nodes without grains go on from the others, and grains outside do not count")
{
  Cloud c = cloud({grid.box.low, Vec3(0.9, 2.5, 2.2)}, 100, trilinear);
  c.place.push_back(Vec3(-2., 2.2, 1.));
  c.value.push_back(Vec3::Constant(1e6));
  c.volume.push_back(1.);
  const GridFit fit = fit_of(c);
  const auto values = fit.solve();
  REQUIRE(values);
  CHECK(largest_miss(*values) < 1e-7); // far from the grains rounding has grown
  CHECK(fit.solid_fraction().back() == 0.);
}

TEST_CASE("the fit is the least sum of squares, weighted by volumes")
{
  // Two values at each of the eight nodes of one cell: their means by volume.
  const HexahedronGrid cell{{Vec3::Zero(), Vec3::Ones()}, {1, 1, 1}};
  Cloud two;
  for (std::int32_t node = 0; node < 8; ++node)
    for (const double k : {1., 3.})
    {
      two.place.push_back(cell.node(node));
      two.value.push_back(Vec3(k + node, k, 0.));
      two.volume.push_back(k);
    }
  const auto means = fit_of(two, cell).solve();
  REQUIRE(means);
  for (std::int32_t node = 0; node < 8; ++node)
    CHECK(((*means)[node] - Vec3(2.5 + node, 2.5, 0.)).norm() < 1e-12);

  // What is left is orthogonal to every shape function of the cell, where no second difference has a say.
  Cloud noisy = cloud(cell.box, 50, trilinear);
  for (std::size_t i = 0; i < noisy.value.size(); ++i)
    noisy.value[i].x() += i % 2 == 0 ? 1. : -1.;
  const auto values = fit_of(noisy, cell).solve();
  REQUIRE(values);
  std::array<double, 8> product{};
  for (std::size_t i = 0; i < noisy.place.size(); ++i)
  {
    const double left = noisy.value[i].x() - value_at(cell, *values, noisy.place[i]).x();
    const GridShares shares = *cell.shares_at(noisy.place[i]);
    for (int k = 0; k < 8; ++k)
      product[shares.node[k]] += noisy.volume[i] * shares.share[k] * left;
  }
  for (const double p : product)
    CHECK(std::abs(p) < 1e-12);
}

TEST_CASE("second differences have next to no say where grains are")
{
  const auto bent = [](const Vec3 &x) { return Vec3(x.z() * x.z(), 0., 0.); };
  const Cloud c = cloud(grid.box, 2000, bent);
  const auto values = fit_of(c).solve();
  REQUIRE(values);
  // The best straight lines between nodes h apart miss a parabola by h^2/8 at most, at the nodes by h^2/4 by far.
  const double h = grid.cell_edges().z();
  for (std::int32_t node = 0; node < 60; ++node)
    CHECK(std::abs((*values)[node].x() - bent(grid.node(node)).x()) < 0.25 * h * h);
}

TEST_CASE("too few grains determine no field")
{
  CHECK_FALSE(GridFit(grid).solve());
  CHECK_FALSE(fit_of(cloud(grid.box, 7, trilinear)).solve()); // of eight functions that are linear along each axis
  CHECK(fit_of(cloud(grid.box, 60, trilinear)).solve());
}

TEST_CASE("several looks are one fit of all, and the mean of their solid fractions")
{
  const Cloud first = cloud(grid.box, 80, trilinear);
  Cloud second = first;
  for (Vec3 &v : second.value)
    v *= 3.;
  GridFit fit = fit_of(first);
  const std::vector<double> once = fit.solid_fraction();
  fit.add(second.place, second.volume, second.value);
  CHECK(fit.n_looks() == 2);
  const auto one = fit_of(first).solve(), both = fit.solve();
  REQUIRE((one && both));
  for (std::size_t node = 0; node < 60; ++node)
  {
    CHECK(((*both)[node] - 2. * (*one)[node]).norm() < 1e-8);
    CHECK(fit.solid_fraction()[node] == Approx(once[node]).epsilon(1e-13));
  }
  double volume = 0., expected = 0.;
  for (std::int32_t node = 0; node < 60; ++node)
    volume += once[node] * grid.node_volume(node);
  for (const double v : first.volume)
    expected += v;
  CHECK(volume == Approx(expected).epsilon(1e-13));
}

TEST_CASE("velocities are those of the grains that are free")
{
  Particles grains;
  std::mt19937_64 random(1);
  const Cloud c = cloud(grid.box, 300, trilinear);
  for (std::size_t i = 0; i < c.place.size(); ++i)
  {
    grains.add({Vec3::Constant(0.01 * (1. + c.volume[i])), 1., 1.}, 1., c.place[i], Quaternion::Identity());
    grains.velocity[i] = c.value[i];
  }
  grains.add({Vec3::Constant(0.1), 1., 1.}, 1., grid.box.low, Quaternion::Identity());
  grains.fix(300);
  GridFit fit(grid);
  fit.add_velocities(grains);
  const auto values = fit.solve();
  REQUIRE(values);
  CHECK(largest_miss(*values) < 1e-9);
}

TEST_CASE("a grid or a cloud that is none is refused")
{
  HexahedronGrid flat = grid;
  flat.box.high.y() = flat.box.low.y();
  CHECK_THROWS_WITH(GridFit(flat), Contains("edge of a grid's box"));
  HexahedronGrid empty = grid;
  empty.n_cells[2] = 0;
  CHECK_THROWS_WITH(GridFit(empty), Contains("number of cells"));
  HexahedronGrid huge = grid;
  huge.n_cells = {1000, 1000, 1000};
  CHECK_THROWS_WITH(GridFit(huge), Contains("at most 1e8"));
  GridFit fit(grid);
  CHECK_THROWS_WITH(fit.add(std::vector{Vec3(0., 2., 1.)}, std::vector<double>{}, std::vector{Vec3(0., 2., 1.)}),
                    Contains("that of the places, 1"));
}
