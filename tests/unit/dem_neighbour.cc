#include "dem/neighbour/size_classes.h"
#include "dem/neighbour/spatial_order.h"
#include "dem/neighbour/sphere_rows.h"
#include "dem/neighbour/verlet_list.h"

#include "tests/threads.h"
#include <algorithm>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
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
  std::vector<double> radii, masses = {};
  std::vector<std::int32_t> body = {};
  PeriodicCell cell = {};
  std::vector<std::uint8_t> sought = {};

  BoundingSpheres spheres() const { return {positions, radii, masses, body, sought}; }
  void add(const Vec3 &position, const double radius)
  {
    positions.push_back(position);
    radii.push_back(radius);
  }
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

using Pairs = std::vector<std::tuple<std::int32_t, std::int32_t, int>>; // both partners, the image of the second

/// Not of a direction in which nothing repeats itself.
bool is_image_of(const PeriodicCell &cell, const Image image)
{
  for (int d = 0; d < 3; ++d)
    if (shift_of(image)[d] != 0. && !cell.is_periodic(d))
      return false;
  return true;
}

Pairs brute_force(const Cloud &c, const double verlet_distance)
{
  Pairs pairs;
  for (std::size_t i = 0; i < c.positions.size(); ++i)
    for (std::size_t j = i + 1; j < c.positions.size(); ++j)
    {
      if (!c.masses.empty() && std::isinf(c.masses[i]) && std::isinf(c.masses[j]))
        continue;
      if (!c.body.empty() && c.body[i] == c.body[j])
        continue;
      if (!c.sought.empty() && !c.sought[i] && !c.sought[j])
        continue;
      const Vec3 line = c.positions[j] - c.positions[i];
      for (int image = 0; image < (c.cell.is_periodic() ? n_images : 1);
           ++image) // all of them: none is presumed nearest
      {
        const int shift = c.cell.is_periodic() ? image : own_image;
        if (!is_image_of(c.cell, static_cast<Image>(shift)))
          continue;
        if ((line + c.cell.place[shift]).norm() < c.radii[i] + c.radii[j] + verlet_distance)
          pairs.emplace_back(i, j, shift);
      }
    }
  return pairs;
}

Pairs pairs_of(const VerletList &list)
{
  Pairs pairs;
  for (std::size_t k = 0; k < list.size(); ++k)
    pairs.emplace_back(list.first[k], list.second[k], list.image[k]);
  return pairs;
}

VerletList list_of(const Cloud &cloud, const double verlet_distance)
{
  return build_verlet_list(cloud.spheres(), verlet_distance, cloud.cell);
}

/// The list is the brute-force one in its order, and its rows point into it.
void check_list(const Cloud &cloud, const double verlet_distance)
{
  const VerletList list = list_of(cloud, verlet_distance);
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
  CHECK(list_of({{{0., 0., 0.}, {1., 0., 0.}}, {0.5, 0.4}}, 0.2).size() == 1);
  check_list(random_cloud(100, {0.1, 0.1, 0.1}, 0.3, 0.5, 2), 0.1);                         // all in one cell
  check_list({std::vector<Vec3>(20, Vec3(1., 2., 3.)), std::vector<double>(20, 0.1)}, 0.1); // all in one place
  check_list(random_cloud(300, {1000., 1., 1.}, 0.2, 0.5, 3), 0.1);                         // a long thread
  check_list(random_cloud(300, {1e9, 1., 1e-3}, 0.2, 0.5, 4), 0.1);                       // far more cells than grains
  check_list(random_cloud(300, {1e7, 1e7, 1e7}, 0.2, 0.5, 5), 0.1);                       // a gas
  check_list(random_cloud(300, {10., 10., 0.}, 0.2, 0.5, 6), 0.1);                        // a layer
  check_list({std::vector<Vec3>(20, Vec3(1., 2., 3.)), std::vector<double>(20, 0.)}, 0.); // points touch nothing
  Cloud points = random_cloud(100, {3., 3., 3.}, 0., 0., 10);
  points.radii[50] = 1.;
  check_list(points, 0.); // but a sphere touches them
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
  CHECK(list_of(cloud, 1e-9).size() == 540);
}

namespace
{

/// Radii between 0.01 and 1 by their distribution.
struct Sizes
{
  const char *name;
  std::function<double(std::mt19937_64 &)> draw;
};

const std::vector<Sizes> sizes_of_all_kinds{
    {"a hundredth", [](auto &) { return 0.01; }},
    {"cubic", // number density ~ r^-3: 1 / r^2 is uniform
     [](auto &generator) { return 1. / std::sqrt(std::uniform_real_distribution<double>(1., 1e4)(generator)); }},
    {"Gaussian",
     [](auto &generator) { return std::clamp(std::normal_distribution<double>(0.2, 0.1)(generator), 0.01, 1.); }},
    {"as many at every scale",
     [](auto &generator) { return std::exp(std::uniform_real_distribution<double>(std::log(0.01), 0.)(generator)); }}};

/// One of the lowest, a middle or one of the highest indices, by the seed, has radius 1.
Cloud cloud_of_sizes(const Sizes &sizes, const bool is_periodic, const int seed)
{
  std::mt19937_64 generator(seed);
  Cloud cloud = random_cloud(600, {5., 4.5, 6.}, 0., 0., seed);
  for (double &radius : cloud.radii)
    radius = sizes.draw(generator);
  cloud.radii[299 * seed % 600] = 1.;
  if (!is_periodic)
    return cloud;
  cloud.cell = PeriodicCell({5., 4.5, 6.});
  for (Vec3 &x : cloud.positions)
    x += 0.3 * Vec3(5., 4.5, 6.);
  return cloud;
}

} // namespace

TEST_CASE("the Verlet list for sizes of a hundred to one, in a box and in a periodic cell")
{
  for (const Sizes &sizes : sizes_of_all_kinds)
    for (int seed = 0; seed < 6; ++seed)
    {
      INFO(sizes.name);
      check_list(cloud_of_sizes(sizes, seed % 2, seed), 0.02);
      check_list(cloud_of_sizes(sizes, seed % 2, seed), 0.);
    }
}

TEST_CASE("classes of size follow their own largest sphere")
{
  // Rows of small spheres stay as they are when a large one comes.
  Cloud cloud = random_cloud(2000, {3., 3., 3.}, 0.1, 0.1, 3);
  const SphereRows alone(cloud.spheres(), 0.01, {});
  REQUIRE(alone.classes.size() == 1);
  cloud.add({1., 1., 1.}, 10.);
  const SphereRows beside(cloud.spheres(), 0.01, {});
  REQUIRE(beside.classes.size() == 2);
  CHECK(beside.classes[0].range == 2. * 10. + 0.01);
  CHECK(beside.classes[1].range == alone.classes[0].range);
  REQUIRE(beside.rows.size() == alone.rows.size() + 1);
  bool is_same = true;
  for (std::size_t k = 0; k < alone.rows.size(); ++k)
  {
    const SphereRow &row = beside.rows[k + 1];
    is_same = is_same && row.end - row.begin == alone.rows[k].end - alone.rows[k].begin;
  }
  CHECK(is_same);
}

TEST_CASE("in no class of size are spheres much smaller than rows are wide")
{
  // What a sphere meets in rows wide enough for the largest of its class, over what it meets among equals: the cube of
  // the largest range over the mean cube. A single large sphere among many has a class by itself.
  const auto crowd = [](const std::vector<double> &radii)
  {
    const SizeClasses classes = divide_by_size(radii, 0.);
    std::vector<double> n(classes.range.size(), 0.), cubes(n);
    bool is_in_range = true;
    for (std::size_t i = 0; i < radii.size(); ++i)
    {
      const std::int32_t k = classes.size_class[i];
      is_in_range = is_in_range && 2. * radii[i] <= classes.range[k];
      ++n[k];
      cubes[k] += std::pow(2. * radii[i] / classes.range[k], 3);
    }
    CHECK(is_in_range);
    double sum = 0.;
    for (std::size_t k = 0; k < n.size(); ++k)
      sum += n[k] * std::min(n[k] / cubes[k], n[k]);
    return sum / radii.size();
  };
  for (const double ratio : {1., 1.2, 1.5, 2., 3., 5., 10., 30., 100., 1e6, 1e12})
  {
    std::vector<double> radii(5000, 1.);
    radii[2500] = ratio;
    CHECK(crowd(radii) < 8.);
  }
  std::mt19937_64 generator(4);
  for (const Sizes &sizes : sizes_of_all_kinds)
  {
    INFO(sizes.name);
    std::vector<double> radii;
    for (int i = 0; i < 5000; ++i)
      radii.push_back(sizes.draw(generator));
    radii[0] = 1.;
    CHECK(crowd(radii) < 16.);
  }
  CHECK(divide_by_size(std::vector<double>{1., 1.1, 1.05, 1.01}, 0.1).range.size() == 1);
}

TEST_CASE("grains that have left change nothing for the others")
{
  const Cloud bulk = random_cloud(500, {4., 4., 4.}, 0.2, 0.3, 21);
  const SphereRows rows(bulk.spheres(), 0.05, {});
  for (const double distance : {1e4, 1e9, 1e18, 1e300, 1.7e308})
    for (const Vec3 &direction : {Vec3(1., 0., 0.), Vec3(0., -1., 0.), Vec3(0., 0., 1.), Vec3(-1., 1., -1.)})
    {
      Cloud cloud = bulk;
      cloud.positions.insert(cloud.positions.begin() + 100, distance * direction);
      cloud.radii.insert(cloud.radii.begin() + 100, 0.2);
      cloud.add(-distance * direction, 0.2);
      cloud.add(distance * direction + Vec3(0.1, 0.1, 0.1), 0.2);
      check_list(cloud, 0.05);
      // Rows of the bulk are no wider: the far ones lie in others or at the ends of these.
      const SphereRows with_far(cloud.spheres(), 0.05, {});
      CHECK(with_far.classes[0].width == rows.classes[0].width);
      CHECK(with_far.rows.size() >= rows.rows.size());
    }
  // As many far away as near, each alone: there are no more rows than spheres.
  Cloud gas = bulk;
  for (const Vec3 &x : random_cloud(500, Vec3::Constant(1e300), 0., 0., 22).positions)
    gas.add(x, 0.2);
  check_list(gas, 0.05);
  CHECK(SphereRows(gas.spheres(), 0.05, {}).rows.size() <= gas.positions.size());
}

TEST_CASE("the Verlet list in cells that repeat themselves in some directions alone")
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (int seed = 0; seed < 2; ++seed)
    for (int open = 1; open < 7; ++open) // a bit for each direction
      for (const Vec3 &edges : {Vec3(2.2, 2.7, 3.4), Vec3(6., 5.5, 7.)})
      {
        // Far beyond the cell where it is open, on both sides of the origin.
        Cloud cloud = random_cloud(200, 1.3 * edges, 0.2, 0.5, seed);
        Vec3 open_edges = edges;
        for (int d = 0; d < 3; ++d)
          if (open >> d & 1)
            open_edges[d] = infinite;
          else
            for (Vec3 &x : cloud.positions)
              x[d] += 0.3 * edges[d];
        cloud.cell = PeriodicCell(open_edges);
        CAPTURE(open, seed);
        check_list(cloud, 0.1);
        Cloud of_sizes = random_cloud(250, edges, 0.03, 0.1, 10 + seed); // classes of their own
        for (int k = 0; k < 8; ++k)
          of_sizes.radii[31 * k] = 0.5;
        of_sizes.cell = cloud.cell;
        check_list(of_sizes, 0.1);
        of_sizes.sought.resize(of_sizes.positions.size());
        for (std::size_t i = 0; i < of_sizes.sought.size(); ++i)
          of_sizes.sought[i] = i % 5 == 0;
        check_list(of_sizes, 0.1);
      }
}

TEST_CASE("the Verlet list in a periodic cell of the least size and in long ones")
{
  for (int seed = 0; seed < 5; ++seed)
    for (const Vec3 &edges : {Vec3(2.2, 2.2, 2.2), Vec3(2.2, 2.7, 3.4), Vec3(40., 2.2, 2.3), Vec3(2.2, 3.3, 40.)})
    {
      Cloud cloud = random_cloud(150, edges, 0.2, 0.5, seed);
      cloud.cell = PeriodicCell(edges);
      cloud.radii[seed] = 0.5;
      for (Vec3 &x : cloud.positions)
        x += 0.3 * edges;
      cloud.positions[0].setZero();
      cloud.positions[1] = edges.cwiseProduct(Vec3(0.5, 0., 0.5));
      check_list(cloud, 0.1);
      // Parts of bodies whose centres lie in the cell lie outside by up to their radius.
      for (std::size_t i = 0; i < cloud.positions.size(); ++i)
        cloud.positions[i] += cloud.radii[i] * random_cloud(1, {1.4, 1.4, 1.4}, 0., 0., i).positions[0];
      check_list(cloud, 0.1);
      for (std::size_t i = 0; i < cloud.positions.size(); ++i) // a rounding beyond the face
        if (i % 3 == 0)
          cloud.positions[i] = cloud.positions[i].cwiseMin(Vec3::Constant(-1e-18));
      check_list(cloud, 0.1);
    }
}

TEST_CASE("pairs of fixed grains and of parts of one body are left out")
{
  for (const bool is_periodic : {false, true})
    for (const Sizes &sizes : sizes_of_all_kinds)
    {
      Cloud cloud = cloud_of_sizes(sizes, is_periodic, 8 + is_periodic);
      const std::size_t n_all = list_of(cloud, 0.3).size();
      for (std::size_t i = 0; i < cloud.positions.size(); ++i)
        cloud.masses.push_back(i % 3 == 0 ? std::numeric_limits<double>::infinity() : 1.);
      check_list(cloud, 0.3);
      const std::size_t n_free = list_of(cloud, 0.3).size();
      CHECK(n_free < n_all);
      for (std::size_t i = 0; i < cloud.positions.size(); ++i)
        cloud.body.push_back(static_cast<std::int32_t>(i % 7)); // far-off indices of one body
      check_list(cloud, 0.3);
      CHECK(list_of(cloud, 0.3).size() < n_free);
      std::iota(cloud.body.begin(), cloud.body.end(), 0); // each by itself
      CHECK(list_of(cloud, 0.3).size() == n_free);
    }
}

TEST_CASE("a Verlet list for some spheres holds the pairs that they have")
{
  for (const bool is_periodic : {false, true})
    for (const Sizes &sizes : sizes_of_all_kinds)
      for (const double share : {0., 0.01, 0.2, 0.9, 1.})
        for (const bool the_large_ones : {false, true})
        {
          Cloud cloud = cloud_of_sizes(sizes, is_periodic, 11);
          std::mt19937_64 generator(12);
          for (const double radius : cloud.radii)
            cloud.sought.push_back(std::uniform_real_distribution<double>(0., 1.)(generator) < share ||
                                   (the_large_ones && radius > 0.5));
          INFO(sizes.name << ", sought " << share);
          check_list(cloud, 0.1);
        }
}

TEST_CASE("the Verlet list is the same for any number of threads")
{
  for (const bool is_periodic : {false, true})
    for (const Sizes &sizes : sizes_of_all_kinds)
    {
      Cloud cloud = random_cloud(9000, {4., 4., 4.}, 0., 0., 9); // more than one run of a sort
      std::mt19937_64 generator(9);
      for (double &radius : cloud.radii)
        radius = 0.5 * sizes.draw(generator);
      if (is_periodic)
        cloud.cell = PeriodicCell(Vec3::Constant(4.));
      for (int i = 0; i < 9000; ++i)
        cloud.sought.push_back(i % 3 == 0);
      std::vector<VerletList> lists;
      std::vector<std::vector<std::int32_t>> orders;
      for (const int n : {1, 2, 3, 8})
      {
        const Threads threads(n);
        lists.push_back(list_of(cloud, 0.1));
        orders.push_back(spatial_order(cloud.positions, 0.5));
      }
      CHECK(lists[0].size() > 1000);
      for (std::size_t k = 1; k < lists.size(); ++k)
      {
        CHECK(lists[k].row == lists[0].row);
        CHECK(lists[k].first == lists[0].first);
        CHECK(lists[k].second == lists[0].second);
        CHECK(lists[k].image == lists[0].image);
        CHECK(orders[k] == orders[0]);
      }
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
}

TEST_CASE("the spatial order keeps neighbours together when grains have left")
{
  std::vector<Vec3> bulk;
  for (int cell = 0; cell < 4096; ++cell)
    bulk.emplace_back(cell % 16 + 0.25, cell / 16 % 16 + 0.25, cell / 256 + 0.25);
  const auto path = [&](const std::vector<std::int32_t> &order)
  {
    double length = 0.;
    std::int32_t last = -1;
    for (const std::int32_t i : order)
      if (i < 4096) // of the bulk
      {
        length += last < 0 ? 0. : (bulk[i] - bulk[last]).norm();
        last = i;
      }
    return length;
  };
  CHECK(path(spatial_order(bulk, 1.)) == 4095.);
  for (const double distance : {1e4, 1e7, 1e300, 1.7e308})
    for (const Vec3 &direction : {Vec3(1., 0., 0.), Vec3(0., -1., 0.), Vec3(-1., 1., -1.)})
    {
      std::vector<Vec3> positions = bulk;
      positions.push_back(distance * direction);
      positions.push_back(-0.5 * distance * direction);
      const std::vector<std::int32_t> order = spatial_order(positions, 1.);
      // The cube may lie across cells of the curve, which costs some longer ways; by x, y and z each step were one of a
      // row, but every sixteenth a way back of sixteen: twice as far.
      CHECK(path(order) < 1.5 * 4095.);
    }
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
