#include "dem/geometry/common_normal.h"
#include "dem/packing/distribution.h"
#include "dem/packing/grain_move.h"
#include "dem/packing/overlap.h"
#include "dem/packing/random_stream.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

TEST_CASE("grains apart by their spheres, their centre line or a plane")
{
  // find_contact decides every pair with proof: what it calls touching is not apart; what it separates by more than
  // rounding is found apart but for few pairs, where the search from the centre line ends beside.
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(0., 1.);
  int n_apart = 0, n_touching = 0, n_missed = 0;
  for (int n = 0; n < 4000; ++n)
  {
    const Superquadric a = draw_grain({}, generator), b = draw_grain({}, generator);
    const BodyPose first = make_pose(a, Vec3::Zero(), draw_orientation(generator));
    const Vec3 line = draw_orientation(generator) * Vec3(0.5e-3 + 1e-3 * uniform(generator), 0., 0.);
    const BodyPose second = make_pose(b, line, draw_orientation(generator));
    const bool apart = are_apart({a, first, bounding_radius(a), inscribed_radius(a)},
                                 {b, second, bounding_radius(b), inscribed_radius(b)}, line);
    const ContactGeometry g = find_contact(first, second);
    if (g.status == ContactStatus::touching)
    {
      ++n_touching;
      REQUIRE_FALSE(apart);
    }
    else
    {
      ++n_apart;
      n_missed += !apart;
    }
  }
  CHECK(n_touching > 1000);
  CHECK(n_apart > 1000);
  CHECK(n_missed < 5);
}

TEST_CASE("a moved grain stays below its planes")
{
  std::mt19937_64 generator(9);
  std::uniform_real_distribution<double> uniform(0., 1.);
  int n_turned = 0, n_shifted = 0, n_grown = 0;
  for (int n = 0; n < 2000; ++n)
  {
    const Superquadric grain = draw_grain({}, generator);
    const double r = bounding_radius(grain);
    const Quaternion orientation = draw_orientation(generator);
    const BodyPose pose = make_pose(grain, Vec3(1., 2., 3.), orientation);
    std::vector<TangentPlane> planes;
    for (int k = 0; k < 12; ++k)
    {
      const Vec3 normal = draw_orientation(generator) * Vec3::UnitX();
      planes.push_back({normal, 0.1 * r * uniform(generator), support(pose, normal).height});
    }
    const std::vector<TangentPlane> before = planes;
    RandomStream random(1, 2, n);
    const MoveLimits limits{0.2 * r, 0.5, 0.1, 0.5};
    const GrainMove move = choose_move(pose, planes, limits, random);
    CHECK(move.translation.norm() <= limits.translation * (1. + 1e-12));
    CHECK(Eigen::AngleAxisd(move.rotation).angle() <= limits.angle);
    CHECK(move.growth <= limits.growth);
    CHECK(move.growth >= 0.);
    Superquadric grown = grain;
    grown.half_axes *= 1. + move.growth;
    const BodyPose after = make_pose(grown, move.translation, move.rotation * orientation);
    for (const TangentPlane &plane : before)
      REQUIRE(plane.normal.dot(move.translation) + support(after, plane.normal).height <=
              plane.height + plane.room + 1e-12 * r);
    n_turned += !move.rotation.isApprox(Quaternion::Identity());
    n_shifted += move.translation.norm() > 0.;
    n_grown += move.growth > 0.001;
  }
  CHECK(n_turned > 300);
  CHECK(n_shifted > 900); // half of them
  CHECK(n_shifted < 1100);
  CHECK(n_grown > 1000);
}

TEST_CASE("the numbers of a grain depend on seed, iteration and grain alone")
{
  // Different streams share no number; n uniform numbers have the mean 1/2 with deviation 1/sqrt(12 n).
  std::set<double> seen;
  double sum = 0.;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (std::uint64_t iteration = 0; iteration < 10; ++iteration)
      for (std::uint64_t item = 0; item < 10; ++item)
      {
        RandomStream random(seed, iteration, item), again(seed, iteration, item);
        for (int k = 0; k < 10; ++k)
        {
          const double x = random.uniform();
          REQUIRE((x >= 0. && x < 1.));
          REQUIRE(x == again.uniform());
          seen.insert(x);
          sum += x;
        }
      }
  CHECK(seen.size() == 10000);
  CHECK(std::abs(sum / 10000. - 0.5) < 5. / std::sqrt(12. * 10000.));
}
