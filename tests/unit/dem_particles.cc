#include "dem/neighbour/verlet_distance.h"
#include "dem/state/positions_by_id.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// Spheres on the x axis, each at its own radius.
Particles spheres(const std::vector<double> &radii)
{
  Particles particles;
  for (const double radius : radii)
    particles.add(Superquadric{Vec3::Constant(radius), 1., 1.}, 1., radius * Vec3::UnitX(), Quaternion::Identity());
  return particles;
}

} // namespace

TEST_CASE("positions by id do not notice the order of the particles")
{
  Particles particles = spheres({1., 2., 3.});
  particles.id = {2, 0, 1};
  CHECK(positions_by_id(particles) == std::vector<Vec3>{Vec3(2., 0., 0.), Vec3(3., 0., 0.), Vec3(1., 0., 0.)});
}

TEST_CASE("the Verlet distance is a share of the mean radius, to the same bits in any order")
{
  CHECK(verlet_distance_of(spheres({1., 2., 6.}), 0.1) == Approx(0.3));
  // A tenth added to 1e15 becomes an eighth.
  CHECK(verlet_distance_of(spheres({0.1, 0.1, 0.1, 1e15}), 1.) ==
        verlet_distance_of(spheres({1e15, 0.1, 0.1, 0.1}), 1.));
}
