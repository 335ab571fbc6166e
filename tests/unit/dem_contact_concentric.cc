#include "dem/geometry/centre_line.h"
#include "dem/geometry/pair_search.h"
#include "tests/unit/dem_contact_pairs.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

// Grains whose centres coincide: phi(c) = h1(c) + h2(-c) has its least minimum there as anywhere.

using namespace bergamo;
using namespace bergamo::dem;
using namespace contact_pairs;

namespace
{

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();

/// No line; lines whose squares are zero, denormal, or just large enough; a line far below the rounding of a contact.
const std::vector<double> distances{0., 5e-324, 1e-200, 1e-160, 1e-145, 1e-140, 1e-30, 1e-14};

FoundContacts<Pack> in_packs(const BodyPose &a, const BodyPose &b)
{
  const Pack zero(0.);
  return search_pairs<Pack>(in_every_lane(a), in_every_lane(b), {zero, zero, zero}, pack_width);
}

} // namespace

TEST_CASE("equal aligned grains at one centre overlap by twice their inscribed sphere")
{
  // phi(c) = 2 h(c), and the least support height of a body about its centre is the radius of the largest sphere in it:
  // of an ellipsoid or a rounder box the smallest half-axis. Where that minimum cannot be proven in the search's budget
  // (a sphere: all directions are alike) any direction has it. Solver: 3e-10 of the smallest half-axis.
  RandomPairs random(23, 0.1, 1.);
  for (int i = 0; i < 60; ++i)
  {
    Superquadric shape = random.shape();
    if (i % 3 == 0)
      shape.eps1 = shape.eps2 = 1.;
    if (i % 10 == 0)
      shape.half_axes.setConstant(0.7);
    const Quaternion turn = random.orientation();
    const Vec3 place = random.direction(), line = random.direction();
    for (const double distance : distances)
    {
      const Grain body1{shape, Vec3::Zero(), turn}, body2{shape, distance * line, turn};
      const double expected = 2. * shape.half_axes.minCoeff();
      const ContactGeometry g = find_contact(body1.pose(), body2.pose());
      CAPTURE(shape.half_axes.transpose(), shape.eps1, shape.eps2, distance);
      CHECK(g.status == ContactStatus::touching);
      CHECK(std::abs(g.normal.norm() - 1.) < 1e-14);
      CHECK(std::abs(g.overlap - expected) < 1e-9);
      const FoundContacts<Pack> found = in_packs(body1.pose(), body2.pose());
      for (int k = 0; k < pack_width; ++k)
      {
        CHECK_FALSE(found.is_undecided[k]);
        CHECK(std::abs(math::lane(found.overlap, k) - expected) < 1e-9);
      }
    }
    // Elsewhere in space: the same place for both.
    const Grain moved{shape, place, turn};
    CHECK(std::abs(find_contact(moved.pose(), moved.pose()).overlap - 2. * shape.half_axes.minCoeff()) < 1e-9);
  }
}

TEST_CASE("any two grains at one centre are in contact, with the least overlap there is")
{
  // No direction among many, the axes of both bodies included, has less; the result is phi of its own normal.
  for (const auto &[low, high] : {std::pair(1., 1.), std::pair(0.7, 1.3), std::pair(0.05, 1.9)})
  {
    RandomPairs random(29, low, high);
    for (int i = 0; i < 60; ++i)
    {
      const Superquadric shape1 = random.shape(), shape2 = random.shape();
      const Quaternion turn1 = random.orientation(), turn2 = i % 4 == 0 ? turn1 : random.orientation();
      const Vec3 line = random.direction();
      const double distance = distances[i % distances.size()];
      const BodyPose a = make_pose(shape1, Vec3::Zero(), turn1), b = make_pose(shape2, distance * line, turn2);
      const ContactGeometry g = find_contact(a, b);
      CAPTURE(low, high, i, distance);
      CHECK(g.status == ContactStatus::touching);
      CHECK(std::abs(phi(a, b, g.normal) - g.overlap) < 1e-13);
      double least = infinite;
      for (int d = 0; d < 3; ++d)
        for (const BodyPose &body : {a, b})
          least = std::min(least, phi(a, b, body.rotation.col(d)));
      for (int k = 0; k < 2000; ++k)
        least = std::min(least, phi(a, b, random.direction()));
      CHECK(g.overlap <= least + 1e-9);
      CHECK(std::abs(find_contact(b, a).overlap - g.overlap) < 1e-9);
      const FoundContacts<Pack> found = in_packs(a, b);
      CHECK_FALSE(found.is_undecided[0]);
      CHECK(std::abs(math::lane(found.overlap, 0) - g.overlap) < 1e-9);
    }
  }
}

TEST_CASE("the direction between centres is a unit vector, whatever their distance")
{
  for (const double distance : {0., 5e-324, 1e-200, 1e-146, 1e-144, 1e-30, 1., 1e140, 1e200, 1e308})
  {
    const Vec3 line = distance * Vec3(0.6, 0., -0.8);
    const Vec3 direction = centre_direction<double>(line);
    CAPTURE(distance);
    CHECK(std::abs(direction.norm() - 1.) < 1e-15);
    if (distance > 1e-144 && distance < 1e144)
      CHECK((direction - Vec3(0.6, 0., -0.8)).norm() < 1e-15);
    const Vector3<Pack> packed = centre_direction<Pack>({Pack(line[0]), Pack(line[1]), Pack(line[2])});
    for (int k = 0; k < pack_width; ++k)
      CHECK((math::lane<Pack>(packed, k) - direction).norm() < 1e-15);
  }
}

TEST_CASE("a pair whose pose is no number is undecided, and its neighbours in a pack are not disturbed")
{
  RandomPairs random(31, 0.3, 1.7);
  Grain first{random.shape(), Vec3::Zero(), random.orientation()},
      second{random.shape(), Vec3::Zero(), random.orientation()};
  place(first, second, random.direction(), 1e-3);
  const BodyPose a = first.pose(), b = second.pose();
  const double overlap = find_contact(a, b).overlap;
  for (int where = 0; where < 5; ++where)
  {
    BodyPose c = b;
    (where < 3 ? c.position[where] : where == 3 ? c.rotation(1, 2) : c.shape.r2) = no_number;
    CAPTURE(where);
    CHECK(find_contact(a, c).status == ContactStatus::undecided);
    CHECK(find_contact(c, a).status == ContactStatus::undecided);
    CHECK(update_contact(a, c, Vec3::UnitX()).status == ContactStatus::undecided);
    for (const double guess : {0., 1.})
    {
      const Pose<Pack> packed = gather_poses([&](const int k) -> const BodyPose & { return k == 1 ? c : b; });
      const Vector3<Pack> start{Pack(guess), Pack(0.), Pack(0.)};
      const FoundContacts<Pack> found = search_pairs<Pack>(in_every_lane(a), packed, start, pack_width);
      for (int k = 0; k < pack_width; ++k)
      {
        CHECK(found.is_undecided[k] == (k == 1));
        CHECK(math::lane(found.overlap > 0., k) == (k != 1));
        if (k != 1 && guess == 0.)
          CHECK(std::abs(math::lane(found.overlap, k) - overlap) < 1e-9);
      }
    }
  }
  // Infinitely far away: never in contact.
  for (const double far : {infinite, -infinite, 1e300})
  {
    BodyPose c = b;
    c.position[1] = far;
    CHECK(find_contact(a, c).status != ContactStatus::touching);
    CHECK(find_contact(c, a).status != ContactStatus::touching);
  }
}
