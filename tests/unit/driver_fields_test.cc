#include "drivers/pile_installation/fields.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace bergamo;
using namespace bergamo::driver;
using dem::Sphere;

namespace
{

constexpr double pi = std::numbers::pi;

/// Transform of a ball of radius 1 over its volume.
double of_ball(const double k)
{
  return 3. * (std::sin(k) - k * std::cos(k)) / (k * k * k);
}

/// Spheres that touch, on a simple cubic lattice of that spacing about the origin.
std::vector<Sphere> lattice(const double spacing, const int reach)
{
  std::vector<Sphere> spheres;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z)
        spheres.push_back({spacing * Vec3(x, y, z), 0.5 * spacing});
  return spheres;
}

} // namespace

TEST_CASE("Fields: the solid fraction of a lattice of spheres is its closed form", "[driver]")
{
  // The fraction in a sampling sphere is the lattice's, pi / 6, times the sum of cos(k . x) f(k r) f(k R) over the
  // reciprocal lattice k = 2 pi n / a, f the transform of a ball. A mean over m x m places of one cell of the lattice
  // at y = 0 leaves those k whose n_x and n_z are multiples of m.
  constexpr double spacing = 1e-3, radius = 1.7e-3;
  constexpr int m = 5;
  const double edge = spacing / m, half = 0.5 * spacing;
  const dem::HexahedronGrid grid{{Vec3(-half, -half, -half), Vec3(half, half, half)}, {m, 1, m}};
  double mean = 0.;
  for (const double fraction : solid_fractions(lattice(spacing, 3), grid, {1., -1.}, radius))
    mean += fraction / (m * m);
  double expected = 0.;
  for (int x = -8; x <= 8; ++x)
    for (int y = -40; y <= 40; ++y)
      for (int z = -8; z <= 8; ++z)
      {
        // Centres of an odd number of cells: one of them at x = z = 0, so that all terms have the sign of cos(0).
        const double k = 2. * pi / spacing * std::hypot(m * x, y, m * z);
        expected += k == 0. ? pi / 6. : pi / 6. * of_ball(0.5 * spacing * k) * of_ball(radius * k);
      }
  CAPTURE(mean, expected, edge);
  CHECK(mean == Approx(expected).epsilon(1e-5)); // terms beyond fall with the fourth power: 40^-2 of 0.005 in all
  CHECK(std::abs(mean - pi / 6.) < 0.01);
}

TEST_CASE("Fields: no solid fraction where a sphere reaches beyond the grains' own ground", "[driver]")
{
  const dem::HexahedronGrid grid{{Vec3(-5., -0.5, 0.), Vec3(5., 0.5, 4.)}, {10, 1, 4}};
  const std::vector<double> fractions = solid_fractions(lattice(1., 7), grid, {3.5, 1.}, 1.);
  REQUIRE(fractions.size() == 40);
  for (int z = 0; z < 4; ++z)
    for (int x = 0; x < 10; ++x)
    {
      CAPTURE(x, z);
      const bool inside = std::abs(x - 4.5) <= 2.5 && z + 0.5 >= 2.;
      CHECK(std::isnan(fractions[x + 10 * z]) != inside);
    }
}

TEST_CASE("Fields: one grid for both kinds of ground, square cells from end to end, and above the heaving surface",
          "[driver]")
{
  InstallationParameters p;
  InstallationStart start;
  start.sand.height = 24e-3;
  const dem::HexahedronGrid two = stress_grid(p, start), fractions = solid_fraction_grid(p, start);
  p.kind = GroundKind::grains;
  const dem::HexahedronGrid alone = stress_grid(p, start);
  CHECK(alone.n_cells == two.n_cells);
  CHECK(alone.box.low == two.box.low);
  for (const dem::HexahedronGrid &grid : {two, fractions})
  {
    const Vec3 edges = grid.cell_edges();
    CHECK(edges[0] == Approx(edges[2]).epsilon(1e-12));
    CHECK(edges[1] == p.sand.box[1]);
    CHECK(grid.box.low[0] == -grid.box.high[0]);
    CHECK(grid.box.high[2] >= start.sand.height + p.pile.width - 1e-12);
    CHECK(grid.box.high[2] < start.sand.height + p.pile.width + edges[2]);
  }
  CHECK(two.box.edges()[0] == Approx(p.sand.box[0]).epsilon(1e-12));
  CHECK(fractions.cell_edges()[0] == Approx(p.fields.spacing).epsilon(1e-12));
  p.kind = GroundKind::two_scale;
  p.beyond_sides = 10e-3;
  p.beyond_bottom = 5e-3;
  CHECK(stress_grid(p, start).box.low[0] == Approx(-0.5 * p.sand.box[0] - 10e-3));
  CHECK(stress_grid(p, start).box.low[2] == Approx(-5e-3));
}
