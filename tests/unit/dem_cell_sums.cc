#include "dem/core/error.h"
#include "dem/measure/cell_sums.h"
#include "dem/measure/stress.h"
#include "tests/unit/dem_measure_contacts.h"

#include <catch2/catch.hpp>

using namespace bergamo;
using namespace bergamo::dem;
using Catch::Matchers::Contains;

namespace
{

constexpr double rounding = 1e-13;

/// 4 x 2 x 3 cells of 0.5 x 1 x 2, from (-1, 0, 1).
HexahedronGrid grid()
{
  return {{Vec3(-1., 0., 1.), Vec3(1., 2., 7.)}, {4, 2, 3}};
}

std::size_t number_of(const int x, const int y, const int z)
{
  return x + 4 * (y + 2 * z);
}

/// The part of a whole that each cell has got.
std::vector<double> parts(const CellSums &cells)
{
  std::vector<double> parts;
  for (const Mat3 &sum : cells.sums())
    parts.push_back(sum(0, 1));
  return parts;
}

Mat3 whole()
{
  Mat3 tensor = Mat3::Zero();
  tensor(0, 1) = 1.;
  return tensor;
}

std::vector<double> along(const Vec3 &from, const Vec3 &to)
{
  CellSums cells(grid());
  cells.add_along(from, to, whole());
  return parts(cells);
}

std::vector<double> within(const Vec3 &low, const Vec3 &high)
{
  CellSums cells(grid());
  cells.add_within({low, high}, whole());
  return parts(cells);
}

double sum_of(const std::vector<double> &values)
{
  double sum = 0.;
  for (const double value : values)
    sum += value;
  return sum;
}

} // namespace

TEST_CASE("a line gives each cell the part of its way in it, from either end")
{
  // From x = -0.75 to 1.25: a quarter of a unit in the first cell, half of one each in three, a quarter outside.
  const Vec3 from(-0.75, 0.5, 4.), to(1.25, 0.5, 4.);
  for (const auto &got : {along(from, to), along(to, from)})
  {
    CHECK(got[number_of(0, 0, 1)] == Approx(0.125));
    for (const int x : {1, 2, 3})
      CHECK(got[number_of(x, 0, 1)] == Approx(0.25));
    CHECK(sum_of(got) == Approx(0.875));
  }
  // Through the edge where four cells meet: from one into the one across.
  const auto across = along({-0.25, 0.5, 1.5}, {0.25, 1.5, 1.5});
  CHECK(across[number_of(1, 0, 0)] == Approx(0.5));
  CHECK(across[number_of(2, 1, 0)] == Approx(0.5));
  // Askew: planes at a quarter (x = 0), a half (z = 3), three quarters (y = 1) of the way.
  const auto askew = along({-0.125, 0.25, 2.}, {0.375, 1.25, 4.});
  CHECK(askew[number_of(1, 0, 0)] == Approx(0.25));
  CHECK(askew[number_of(2, 0, 0)] == Approx(0.25));
  CHECK(askew[number_of(2, 0, 1)] == Approx(0.25));
  CHECK(askew[number_of(2, 1, 1)] == Approx(0.25));
  const Vec3 place(0.6, 1.6, 6.);
  CHECK(along(place, place)[number_of(3, 1, 2)] == 1.);
  CHECK(sum_of(along({-3., 0.5, 4.}, {-2., 0.5, 4.})) == 0.);
}

TEST_CASE("a box gives each cell the part of its volume in it")
{
  // Half of it in x below 0, a quarter in y above 1, and a third in z below the grid.
  const auto got = within({-0.25, 0.25, 0.}, {0.25, 1.25, 3.});
  CHECK(got[number_of(1, 0, 0)] == Approx(0.5 * 0.75 * 2. / 3.));
  CHECK(got[number_of(2, 0, 0)] == Approx(0.5 * 0.75 * 2. / 3.));
  CHECK(got[number_of(1, 1, 0)] == Approx(0.5 * 0.25 * 2. / 3.));
  CHECK(got[number_of(2, 1, 0)] == Approx(0.5 * 0.25 * 2. / 3.));
  CHECK(sum_of(got) == Approx(2. / 3.));
  const Vec3 place(0.6, 1.6, 6.);
  CHECK(within(place, place)[number_of(3, 1, 2)] == 1.);
  CHECK(sum_of(within({1.5, 0., 1.}, {2., 2., 7.})) == 0.);
}

TEST_CASE("an axis with one cell takes all along it")
{
  CellSums cells({{Vec3::Zero(), Vec3(2., 1., 1.)}, {2, 1, 1}});
  cells.add_along({0.5, -3., 9.}, {1.5, 8., 9.}, whole());
  cells.add_within({{0.5, -3., -4.}, {0.75, 8., 9.}}, whole());
  CHECK(parts(cells)[0] == Approx(1.5));
  CHECK(parts(cells)[1] == Approx(0.5));
}

TEST_CASE("cells bear together what their contacts bear, however fine they are")
{
  Particles particles = measured::unit_spheres(20);
  const std::vector<TouchingContact> contacts = measured::random_contacts(20, 200, 0.5);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-5., 5.);
  for (Vec3 &x : particles.position)
    x = {place(random), place(random), place(random)};
  const Box box{Vec3::Constant(-12.), Vec3::Constant(12.)};
  CellSums coarse({box, {3, 2, 2}}), fine({box, {9, 4, 6}});
  for (CellSums *cells : {&coarse, &fine})
  {
    add_contacts(*cells, contacts, particles);
    Mat3 sum = Mat3::Zero();
    for (const Mat3 &cell : cells->sums())
      sum += cell;
    CHECK((sum - force_moment(contacts)).norm() < rounding * sum.norm());
  }
  Mat3 corner = Mat3::Zero(); // the fine cells of a coarse one in the middle
  for (int x = 3; x < 6; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 3; z < 6; ++z)
        corner += fine.sums()[x + 9 * (y + 4 * z)];
  REQUIRE(corner.norm() > 0.);
  CHECK((corner - coarse.sums()[1 + 3 * (0 + 2 * 1)]).norm() < 1e-12 * corner.norm());
}

TEST_CASE("each cell of a lattice under pressure has its stress, wherever its chains are cut")
{
  // Simple cubic, spacing 1, normal force 3 N, chains along x through four lattice places of each cell's section: 3 N
  // over 1 m2. Cells of 0.7 m along x hold less than a contact.
  const measured::Lattice lattice = measured::simple_cubic(6, 3.);
  Particles particles = measured::unit_spheres(lattice.centres.size());
  particles.position = lattice.centres;
  std::vector<TouchingContact> chains;
  for (const TouchingContact &contact : lattice.contacts)
    if (std::abs(contact.branch[0]) > 0.5 && particles.position[contact.first][0] < 4.5)
      chains.push_back(contact);
  CellSums cells({{Vec3(0.6, -0.5, -0.5), Vec3(4.1, 5.5, 5.5)}, {5, 3, 3}});
  add_contacts(cells, chains, particles);
  Mat3 expected = Mat3::Zero();
  expected(0, 0) = -3.;
  for (const Mat3 &mean : cells.means())
    CHECK((mean - expected).norm() < 1e-12);
}

TEST_CASE("cells need a grid that is one")
{
  CHECK_THROWS_WITH(CellSums({{Vec3::Zero(), Vec3::Ones()}, {2, 0, 1}}), Contains("number of cells"));
}
