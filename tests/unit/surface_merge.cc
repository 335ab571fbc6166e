#include "dem/geometry/merge_nodes.h"

#include <catch2/catch.hpp>

#include <random>

using namespace bergamo;
using namespace bergamo::dem;

TEST_CASE("a node goes to the first one kept that is near, wherever all are")
{
  constexpr double tolerance = 0.01;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1., 1.);
  for (int k = 0; k < 500; ++k)
  {
    const Vec3 shift = 3. * Vec3(unit(random), unit(random), unit(random));
    const Vec3 along = Vec3(unit(random), unit(random), unit(random)).normalized();
    // The middle one of three in a row is near to both others, which are not near to one another.
    std::vector<Vec3> node{Vec3(9., 9., 9.), shift, shift + 1.6 * tolerance * along, shift + 0.8 * tolerance * along,
                           Vec3(50., 0., 0.)};
    for (int n = 0; n < 3; ++n)
      node.emplace_back(10. + n, 0., 0.);
    std::vector<Triangle> triangles{{1, 5, 6}, {2, 6, 7}, {3, 7, 5}};
    const std::vector<Vec3> given = node;
    merge_nodes(node, triangles, tolerance);
    // Nodes 0 and 4 belong to no triangle; node 3 became node 1.
    REQUIRE(node == std::vector<Vec3>{given[1], given[2], given[5], given[6], given[7]});
    REQUIRE(triangles == std::vector<Triangle>{{0, 2, 3}, {1, 3, 4}, {0, 4, 2}});
  }
}
