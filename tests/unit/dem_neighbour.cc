#include "dem/neighbour/cell_grid.h"
#include "dem/neighbour/spatial_order.h"
#include "dem/neighbour/verlet_list.h"

#include "tests/threads.h"
#include <algorithm>

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <omp.h>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

struct Cloud
{
  std::vector<Vec3> positions;
  std::vector<double> radii;
};

Cloud random_cloud(const int n, const Vec3 &extent, const double smallest, const double largest, const int seed)
{
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> unit(0., 1.), radius(smallest, largest);
  Cloud cloud;
  for (int i = 0; i < n; ++i)
  {
    cloud.positions.push_back(extent.cwiseProduct(Vec3(unit(generator), unit(generator), unit(generator))) -
                              0.3 * extent);
    cloud.radii.push_back(radius(generator));
  }
  return cloud;
}

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

Pairs brute_force(const Cloud &c, const double verlet_distance)
{
  Pairs pairs;
  for (std::size_t i = 0; i < c.positions.size(); ++i)
    for (std::size_t j = i + 1; j < c.positions.size(); ++j)
      if ((c.positions[i] - c.positions[j]).norm() < c.radii[i] + c.radii[j] + verlet_distance)
        pairs.emplace_back(i, j);
  return pairs;
}

Pairs pairs_of(const VerletList &list)
{
  Pairs pairs;
  for (std::size_t k = 0; k < list.size(); ++k)
    pairs.emplace_back(list.first[k], list.second[k]);
  return pairs;
}

/// The list is the brute-force one in its order, and its rows point into it.
void check_list(const Cloud &cloud, const double verlet_distance)
{
  const VerletList list = build_verlet_list(cloud.positions, cloud.radii, verlet_distance);
  const Pairs expected = brute_force(cloud, verlet_distance);
  const std::size_t n = cloud.positions.size();
  CHECK(pairs_of(list) == expected); // made in ascending order of i and then j: equality means sorted, whole and unique
  REQUIRE(list.first.size() == list.second.size());
  REQUIRE(list.row.size() == n + 1);
  CHECK(list.row[0] == 0);
  CHECK(list.row[n] == static_cast<std::int32_t>(list.size()));
  bool rows_hold = true;
  for (std::size_t i = 0; i < n; ++i)
  {
    for (auto k = list.row[i]; k < list.row[i + 1]; ++k)
      rows_hold = rows_hold && list.first[k] == static_cast<std::int32_t>(i) && list.second[k] > list.first[k];
  }
  CHECK(rows_hold);
}

} // namespace

TEST_CASE("the Verlet list holds the pairs of a search over all pairs")
{
  for (int seed = 0; seed < 10; ++seed)
  {
    check_list(random_cloud(400, {10., 8., 6.}, 0.2, 0.5, seed), 0.05);
    check_list(random_cloud(300, {10., 10., 10.}, 0.05, 2., seed), 0.3); // wide range of sizes
    check_list(random_cloud(200, {5., 5., 5.}, 0.3, 0.3, seed), 0.);     // no Verlet distance
  }
}

TEST_CASE("the Verlet list of degenerate sets")
{
  check_list({}, 0.1);
  check_list(random_cloud(1, {1., 1., 1.}, 0.3, 0.5, 1), 0.1);
  check_list({{{0., 0., 0.}, {1., 0., 0.}}, {0.5, 0.4}}, 0.05); // apart
  check_list({{{0., 0., 0.}, {1., 0., 0.}}, {0.5, 0.4}}, 0.2);  // near
  CHECK(build_verlet_list(std::vector<Vec3>{{0., 0., 0.}, {1., 0., 0.}}, std::vector<double>{0.5, 0.4}, 0.2).size() ==
        1);
  check_list(random_cloud(100, {0.1, 0.1, 0.1}, 0.3, 0.5, 2), 0.1);                         // all in one cell
  check_list({std::vector<Vec3>(20, Vec3(1., 2., 3.)), std::vector<double>(20, 0.1)}, 0.1); // all in one place
  check_list(random_cloud(300, {1000., 1., 1.}, 0.2, 0.5, 3), 0.1);                         // a long thread
  check_list(random_cloud(300, {1e9, 1., 1e-3}, 0.2, 0.5, 4), 0.1); // far more cells than grains
  check_list(random_cloud(300, {1e7, 1e7, 1e7}, 0.2, 0.5, 5), 0.1); // a gas
  check_list(random_cloud(300, {10., 10., 0.}, 0.2, 0.5, 6), 0.1);  // a layer
  Cloud two_heaps = random_cloud(100, {3., 3., 3.}, 0.2, 0.5, 7);
  const Cloud far = random_cloud(100, {3., 3., 3.}, 0.2, 0.5, 8);
  for (std::size_t i = 0; i < far.positions.size(); ++i)
  {
    two_heaps.positions.push_back(far.positions[i] + Vec3(1e6, -1e6, 1e5));
    two_heaps.radii.push_back(far.radii[i]);
  }
  check_list(two_heaps, 0.1);
}

TEST_CASE("a row of touching cells misses no pair across its borders")
{
  // Grains of equal size on a lattice as wide as their range: neighbours sit just within or just without range of it.
  Cloud cloud;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k)
      {
        cloud.positions.emplace_back(i, j, k);
        cloud.radii.push_back(0.5);
      }
  check_list(cloud, 1e-9);
  check_list(cloud, 0.5);
  // 6^3 lattice: 3 * 5 * 36 nearest neighbours at distance 1.
  CHECK(build_verlet_list(cloud.positions, cloud.radii, 1e-9).size() == 540);
}

TEST_CASE("the Verlet list is the same for any number of threads")
{
  const Cloud cloud = random_cloud(2000, {10., 10., 10.}, 0.2, 0.5, 9);
  std::vector<VerletList> lists;
  for (const int n : {1, 2, 3})
  {
    const Threads threads(n);
    lists.push_back(build_verlet_list(cloud.positions, cloud.radii, 0.1));
  }
  CHECK(lists[0].size() > 1000);
  for (const VerletList &list : lists)
  {
    CHECK(list.row == lists[0].row);
    CHECK(list.first == lists[0].first);
    CHECK(list.second == lists[0].second);
  }
}

TEST_CASE("the spatial order is a permutation that goes from cell to next cell")
{
  for (const auto &[n, extent] : {std::pair(1, 1.), std::pair(2, 1e6), std::pair(1000, 10.)})
  {
    const Cloud cloud = random_cloud(n, Vec3::Constant(extent), 0.1, 0.2, n);
    std::vector<std::int32_t> order = spatial_order(cloud.positions, 1.);
    const std::vector<std::int32_t> inverse = inverse_order(order);
    for (int i = 0; i < n; ++i)
      CHECK(order[inverse[i]] == i);
    std::sort(order.begin(), order.end());
    std::vector<std::int32_t> all(n);
    std::iota(all.begin(), all.end(), 0);
    CHECK(order == all);
  }
  // With a particle in every cell of a cube, each step along the curve leads to a cell that shares a face.
  std::vector<Vec3> lattice;
  for (int cell = 0; cell < 512; ++cell)
    lattice.emplace_back(cell % 8 + 0.25, cell / 8 % 8 + 0.25, cell / 64 + 0.25);
  const std::vector<std::int32_t> curve = spatial_order(lattice, 1.);
  for (std::size_t k = 1; k < curve.size(); ++k)
    CHECK((lattice[curve[k]] - lattice[curve[k - 1]]).lpNorm<1>() == 1.);
  // The grid holds every particle once, in the cell that it claims.
  const Cloud cloud = random_cloud(500, {3., 9., 27.}, 0.1, 0.2, 12);
  const CellGrid grid(cloud.positions, 1.);
  CHECK(grid.begin.size() == static_cast<std::size_t>(grid.n[0] * grid.n[1] * grid.n[2]) + 1);
  CHECK(grid.begin.back() == 500);
  for (std::size_t cell = 0; cell + 1 < grid.begin.size(); ++cell)
    for (auto k = grid.begin[cell]; k < grid.begin[cell + 1]; ++k)
      CHECK(grid.cell_of[grid.particles[k]] == static_cast<std::int32_t>(cell));
}

TEST_CASE("the spatial order does not depend on the order in which the particles came")
{
  // Cells much wider than the particles are apart, so that many share one, and layers with coordinates in common.
  std::mt19937_64 generator(13);
  for (const double step : {0., 0.5})
  {
    Cloud cloud = random_cloud(500, {3., 4., 5.}, 0.1, 0.2, 14);
    if (step > 0.)
      for (Vec3 &x : cloud.positions)
        x.head<2>() = step * (x.head<2>() / step).array().round(); // ties in x and y: z decides
    std::vector<std::int32_t> shuffled(cloud.positions.size());
    std::iota(shuffled.begin(), shuffled.end(), 0);
    std::shuffle(shuffled.begin(), shuffled.end(), generator);
    std::vector<Vec3> positions;
    for (const std::int32_t i : shuffled)
      positions.push_back(cloud.positions[i]);
    const std::vector<std::int32_t> order = spatial_order(cloud.positions, 1.), other = spatial_order(positions, 1.);
    bool is_same = true;
    for (std::size_t i = 0; i < order.size(); ++i)
      is_same = is_same && shuffled[other[i]] == order[i];
    CHECK(is_same);
  }
}
