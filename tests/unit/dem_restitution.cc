#include "dem/core/error.h"
#include "dem/law/hertz.h"
#include "dem/law/restitution.h"
#include "dem/simulation/simulation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// Leading coefficients of Schwager & Poeschel (1998), e = 1 - C1 b + C2 b^2, b = (3/2) A (k/m)^(2/5) v^(1/5),
/// and C2 = (3/5) C1^2 (Ramirez et al. 1999).
constexpr double c1 = 1.15344;

} // namespace

TEST_CASE("glass beads of known restitution")
{
  // Wellmann, section 3.2: A = 5.05e-8 s gives 0.97 at 1.18 m/s, d = 3.18 mm. A is given to 0.1 %, of 1 - e = 0.03.
  const Material glass{71e9, 0.22, 2500.};
  const double d = 3.18e-3, mass = glass.density * std::numbers::pi / 6. * d * d * d;
  const double stiffness = 4. / 3. * std::sqrt(0.25 * d) * elastic_pair(glass, glass).effective_modulus;
  CHECK(std::abs(restitution(5.05e-8, stiffness, 0.5 * mass, 1.18) - 0.97) < 5e-5);
  CHECK(relaxation_time(0.97, stiffness, 0.5 * mass, 1.18) == Approx(5.05e-8).epsilon(1e-3));
}

TEST_CASE("weak damping follows the series")
{
  // The next term is of order b^(5/2), from the end of the impact before the overlap is gone (Schwager & Poeschel
  // 2008), with a coefficient below one; C1 is known to 1e-5, the integration errs by 4e-12.
  const double k = 3e7, m = 2e-5;
  for (const double speed : {1e-3, 0.1, 10.})
    for (double number = 1e-8; number < 0.05; number *= 3.)
    {
      const double a = number / (std::pow(k / m, 0.4) * std::pow(speed, 0.2)), b = 1.5 * number;
      const double series = c1 * b - 0.6 * c1 * c1 * b * b;
      CHECK(std::abs(1. - restitution(a, k, m, speed) - series) < std::pow(b, 2.5) + 1e-5 * b + 1e-11);
    }
}

TEST_CASE("relaxation time and restitution are inverse to one another")
{
  // Integration to 1e-13, root to 2^-45: e is kept to 1e-11.
  for (const double e : {0.01, 0.05, 0.3, 0.6, 0.9, 0.97, 0.999, 0.99999, 1. - 1e-6, 1. - 1e-7, 1. - 1e-12, 1.})
    for (const double speed : {1e-4, 1., 100.})
    {
      const double a = relaxation_time(e, 2e7, 3e-6, speed);
      CHECK(std::abs(restitution(a, 2e7, 3e-6, speed) - e) < 1e-11);
    }
  CHECK(relaxation_time(1., 2e7, 3e-6, 1.) == 0.);
  CHECK(restitution(0., 2e7, 3e-6, 1.) == 1.);
}

TEST_CASE("damping ratio and restitution of the dashpot are inverse to one another")
{
  double last = 2.;
  for (const double e : {1., 1. - 1e-12, 1. - 1e-7, 0.999, 0.9, 0.6, 0.3, 0.05, 0.01})
  {
    const double ratio = damping_ratio_of(e);
    CHECK(std::abs(restitution_of_ratio(ratio) - e) < 1e-9);
    CHECK(e < last);
    last = e;
    // Antypov & Elliott's closed form lets the bodies pull at the end: they lose more, so it needs less damping for e.
    const double pulling = std::sqrt(5. / 6.) * -std::log(e) / std::hypot(std::numbers::pi, std::log(e));
    CHECK(ratio >= pulling * (1. - 1e-6));
    if (e > 0.99)
      CHECK(ratio == Approx(pulling).epsilon(0.05).margin(1e-15));
  }
  CHECK_THROWS_WITH(damping_ratio_of(1.5), Catch::Contains("coefficient of restitution is 1.5"));
  CHECK_THROWS_WITH(restitution_of_ratio(-1.), Catch::Contains("damping ratio is -1"));
}

TEST_CASE("a drop onto a floor gives back the restitution that was asked for")
{
  using namespace bergamo::dem;
  for (const double e : {0.9, 0.5, 0.2})
  {
    SimulationParameters p;
    p.grain() = p.wall() = {1e8, 0.25, 2500.};
    p.with_walls().damping_ratio = damping_ratio_of(e);
    p.time_step = 2e-8;
    Particles grains;
    grains.add({Vec3::Constant(1e-3), 1., 1.}, 2500., Vec3(0., 0., 1.000001e-3), Quaternion::Identity());
    grains.velocity[0] = Vec3(0., 0., -0.3);
    Simulation s(p, grains, {PlaneWall()});
    s.step();
    while (s.contacts.n_touching_walls() > 0 || s.particles.velocity[0][2] < 0.)
      s.step();
    CHECK(s.particles.velocity[0][2] == Approx(0.3 * e).epsilon(2e-3)); // dashpots act with a step's delay
  }
}

TEST_CASE("restitution falls with damping and with speed, and scales by one number")
{
  double last = 1.;
  for (double a = 1e-9; a < 1e-3; a *= 2.)
  {
    const double e = restitution(a, 2e7, 3e-6, 1.);
    CHECK(e < last);
    CHECK(e > 0.);
    last = e;
  }
  // a (k/m)^(2/5) v^(1/5) alone counts.
  const double e = restitution(1e-6, 2e7, 3e-6, 1.);
  CHECK(restitution(1e-6, 2e10, 3e-3, 1.) == Approx(e).epsilon(1e-12));
  CHECK(restitution(5e-7, 2e7, 3e-6, 32.) == Approx(e).epsilon(1e-12));
}

TEST_CASE("impacts out of range are refused by name and value")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](auto &&call) -> std::string
  {
    try
    {
      call();
    }
    catch (const ConfigError &error)
    {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(message([] { relaxation_time(1.2, 1., 1., 1.); }), Catch::Contains("coefficient of restitution is 1.2"));
  CHECK_THAT(message([] { relaxation_time(0., 1., 1., 1.); }), Catch::Contains("coefficient of restitution is 0"));
  CHECK_THAT(message([] { relaxation_time(0.5, 1., 1., 0.); }), Catch::Contains("speed of the impact is 0"));
  CHECK_THAT(message([] { restitution(-1., 1., 1., 1.); }), Catch::Contains("relaxation time is -1"));
  CHECK_THAT(message([] { restitution(1., -1., 1., 1.); }), Catch::Contains("normal stiffness of the impact is -1"));
  CHECK_THAT(message([] { restitution(1., 1., 0., 1.); }), Catch::Contains("reduced mass of the impact is 0"));
  CHECK_THAT(message([] { restitution(1e4, 1., 1., 1.); }), Catch::Contains("at most 1000 s"));
  CHECK_THROWS_AS(relaxation_time(nan, 1., 1., 1.), ConfigError);
  CHECK_THROWS_AS(restitution(nan, 1., 1., 1.), ConfigError);
}
