#include "dem/core/tangent_frame.h"
#include "dem/geometry/pair_search.h"
#include "tests/unit/dem_contact_pairs.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace bergamo;
using namespace bergamo::dem;
using namespace contact_pairs;

TEST_CASE("a warm update equals the cold search along rolling, spinning and sliding motion")
{
  // The pair is made anew in every step for a moving common normal c and moving orientations, with an overlap that
  // swings through zero: contact is lost and regained. Overlaps agree with the made one to rounding (the minimum is
  // stationary), for exponents near one, where it is the only minimum nearby. The
  // same holds in packs. Between two steps that touch the normal turns by no more than it is led, to 1e-6.
  enum Motion
  {
    rolling,
    spinning,
    sliding
  };
  for (const Motion motion : {rolling, spinning, sliding})
    for (int run = 0; run < 12; ++run)
    {
      RandomPairs random(31 + run, 0.6, 1.2);
      Grain body1{random.shape(), Vec3::Zero(), random.orientation()},
          body2{random.shape(), Vec3::Zero(), random.orientation()};
      Vec3 c = random.direction();
      const Vec3 axis = tangent_frame(c).col(0);
      Vec3 guess = Vec3::Zero();
      int n_lost = 0, n_regained = 0, n_evaluations = 0, n_warm = 0;
      bool was_touching = false;
      Vec3 last_normal = Vec3::Zero();
      CAPTURE(motion, run);
      for (int step = 0; step < 400; ++step)
      {
        const double angle = 2e-3;
        const auto turn = [&](const Vec3 &a, const double size) { return Quaternion(Eigen::AngleAxisd(size, a)); };
        if (motion == rolling)
        {
          body1.orientation = turn(axis, angle) * body1.orientation;
          body2.orientation = turn(axis, -angle) * body2.orientation;
        }
        else if (motion == spinning)
        {
          body1.orientation = turn(c, angle) * body1.orientation;
          body2.orientation = turn(c, -2. * angle) * body2.orientation;
        }
        else
          c = turn(axis, angle) * c;
        const double overlap = 1e-3 * std::sin(0.05 * step + 0.3);
        place(body1, body2, c, overlap);
        const BodyPose a = body1.pose(), b = body2.pose();
        const ContactGeometry cold = find_contact(a, b);
        const ContactGeometry warm = step == 0 ? cold : update_contact(a, b, guess);
        const Vector3<Pack> guesses = guess.cast<Pack>();
        const FoundContacts<Pack> packed = search_pairs<Pack>(in_every_lane(a), in_every_lane(b), guesses, pack_width);
        guess = warm.normal;
        REQUIRE(warm.status == cold.status);
        REQUIRE(warm.status == (overlap > 0. ? ContactStatus::touching : ContactStatus::separated));
        const bool is_touching = warm.status == ContactStatus::touching;
        if (is_touching)
        {
          CHECK(std::abs(warm.overlap - cold.overlap) < 1e-12);
          CHECK(std::abs(warm.overlap - overlap) < 1e-12);
          const double radius = std::max(cold.radii1.norm(), cold.radii2.norm());
          CHECK((warm.arm1 - cold.arm1).norm() < 1e-9 + 1e-14 * radius);
          for (const int lane : {0, pack_width - 1})
          {
            CHECK(std::abs(math::lane(packed.overlap, lane) - cold.overlap) < 1e-12);
            CHECK((math::lane<Pack>(packed.arm1, lane) - cold.arm1).norm() < 1e-9 + 1e-14 * radius);
          }
          if (was_touching)
            CHECK((warm.normal - last_normal).norm() < angle + 1e-6);
          last_normal = warm.normal;
          n_evaluations += warm.n_evaluations;
          ++n_warm;
        }
        else
          CHECK(-warm.overlap <= -overlap + 1e-14);
        n_lost += step > 0 && was_touching && !is_touching;
        n_regained += step > 0 && !was_touching && is_touching;
        was_touching = is_touching;
      }
      // 400 steps of 0.05 are three periods.
      CHECK(n_lost == 3);
      CHECK(n_regained == 3);
      CHECK(n_evaluations < 12. * n_warm);
    }
}

TEST_CASE("a warm update equals the cold search over flat and sharp regions")
{
  // As above, with boxes that roll over their faces and edges and grains with sharp ends, exponents down to 0.2 and up
  // to 1.5, and smaller turns. The overlap is half a thousandth of the half-axes: the bodies have one minimum nearby in
  // all of these runs. At a sharp edge the normal may turn fast, at a flat face the point runs; the overlap agrees.
  for (int run = 0; run < 16; ++run)
  {
    RandomPairs random(61 + run, run % 2 ? 0.2 : 1.1, run % 2 ? 0.6 : 1.5);
    Grain body1{random.shape(), Vec3::Zero(), random.orientation()},
        body2{random.shape(), Vec3::Zero(), random.orientation()};
    const Vec3 c = random.direction();
    place(body1, body2, c, 5e-4);
    const Vec3 axis = tangent_frame(c).col(run % 2);
    Vec3 guess = find_contact(body1.pose(), body2.pose()).normal;
    CAPTURE(run);
    for (int step = 0; step < 600; ++step)
    {
      // Body 2 rolls over body 1 and is kept at a depth of 5e-4 along the normal of the last step.
      body2.orientation = Quaternion(Eigen::AngleAxisd(1e-3, axis)) * body2.orientation;
      const double depth = find_contact(body1.pose(), body2.pose()).overlap;
      body2.position += (depth - 5e-4) * guess;
      const BodyPose a = body1.pose(), b = body2.pose();
      const ContactGeometry cold = find_contact(a, b), warm = update_contact(a, b, guess);
      const FoundContacts<Pack> packed =
          search_pairs<Pack>(in_every_lane(a), in_every_lane(b), guess.cast<Pack>(), pack_width);
      REQUIRE(warm.status == cold.status);
      if (warm.status == ContactStatus::touching)
      {
        CHECK(std::abs(warm.overlap - cold.overlap) < 1e-12);
        CHECK(std::abs(math::lane(packed.overlap, 0) - cold.overlap) < 1e-12);
      }
      guess = warm.normal;
    }
  }
}
