#include "dem/force/separation.h"
#include "dem/geometry/contact_geometry.h"
#include "dem/motion/leapfrog.h"

#include <catch2/catch.hpp>
#include <random>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// Two grains apart that fly and spin freely, and what the engine remembers of them.
struct FlyingPair
{
  explicit FlyingPair(std::mt19937 &random, const double exponent) : random(random)
  {
    const Superquadric shape{Vec3(1.5e-3, 1.2e-3, 1e-3), exponent, exponent};
    for (const double x : {0., 3.2e-3})
      particles.add(shape, 2650., Vec3(x, 0., 0.), Quaternion(any(), any(), any(), any()).normalized());
  }

  double any() { return std::uniform_real_distribution<double>(-1., 1.)(random); }

  /// Width of the gap along a direction [m].
  double gap_along(const Vec3 &direction) const
  {
    const auto height = [&](const int i, const Vec3 &n)
    { return support(make_pose(particles.parts.shape[i], particles.position[i], particles.orientation[i]), n).height; };
    return direction.dot(particles.position[1] - particles.position[0]) - height(0, direction) - height(1, -direction);
  }

  std::mt19937 &random;
  Particles particles;
  const std::vector<PlaneWall> walls;
  const ContactLaw law{};
  const ContactParameters parameters{};
  const ContactSearch pair{0, 0, 1, 0, 1, own_image, -1};
  ContactScene scene{particles, walls, law, parameters, 1e-5};
};

} // namespace

TEST_CASE("what is left of a gap is known without a search, and never more than there is")
{
  std::mt19937 random(7);
  for (const double exponent : {0.3, 1., 1.8})
    for (int run = 0; run < 40; ++run)
    {
      FlyingPair f(random, exponent);
      Particles &p = f.particles;
      const Vec3 direction = Vec3(1., 0.3 * f.any(), 0.3 * f.any()).normalized();
      const double gap = f.gap_along(direction);
      Separation separation(direction, gap, f.pair, f.scene);
      CAPTURE(exponent, run);
      CHECK(separation.least_gap(f.pair, f.scene) == Approx(gap).margin(1e-17));
      // Both move together, fast, and apart from one another: the centres' motion counts as it is.
      const Vec3 together(3. * f.any(), 3. * f.any(), 3. * f.any());
      for (int i = 0; i < 2; ++i)
        p.velocity[i] = together + 0.1 * Vec3(f.any(), f.any(), f.any());
      for (int step = 0; step < 50; ++step)
        advance(p, {}, 0., f.scene.time_step);
      CHECK(separation.least_gap(f.pair, f.scene) == Approx(f.gap_along(direction)).margin(1e-15));
      // Turns can only be bounded.
      for (int i = 0; i < 2; ++i)
        p.angular_momentum[i] = 50. * p.inertia[i].mean() * Vec3(f.any(), f.any(), f.any());
      for (int step = 0; step < 50; ++step)
      {
        advance(p, {}, 0., f.scene.time_step);
        CHECK(separation.least_gap(f.pair, f.scene) <= f.gap_along(direction) + 1e-15);
      }
      const double left = separation.least_gap(f.pair, f.scene);
      CHECK(left < f.gap_along(direction)); // the bound is no equality
      CHECK(left > f.gap_along(direction) - 2. * 50. * std::sqrt(3.) * 1.5 * 50 * f.scene.time_step * 2.2e-3);
    }
}

TEST_CASE("a separation of pair 1, 2 is that of pair 2, 1")
{
  std::mt19937 random(8);
  FlyingPair f(random, 0.8);
  Separation separation(Vec3::UnitX(), f.gap_along(Vec3::UnitX()), f.pair, f.scene);
  const ContactSearch exchanged{0, 1, 0, 1, 0, own_image, -1};
  const double before = separation.least_gap(f.pair, f.scene);
  separation.exchange_bodies();
  CHECK(separation.least_gap(exchanged, f.scene) == before);
}
