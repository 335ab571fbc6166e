#include "dem/core/error.h"
#include "drivers/common/run/step_count.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace bergamo::driver;
using Catch::Matchers::Contains;

TEST_CASE("a duration takes as many steps as begin in it, one at least")
{
  const auto steps = [](const double duration, const double step) {
    return steps_over({"Loading/time", duration}, {"Loading/time step", step});
  };
  CHECK(steps(1., 0.3) == 4);
  CHECK(steps(0.3, 0.1) == 3);   // the quotient is a rounding below 3
  CHECK(steps(0.9, 0.03) == 30); // and here above 30
  CHECK(steps(0.1, 1.) == 1);
  CHECK(steps(1e6, 1e-9) == 1000000000000000);
  for (const double duration : {1e9, 1e30, std::numeric_limits<double>::infinity()})
  {
    CHECK_THROWS_WITH(steps(duration, 1e-9), Contains("Loading/time is") && Contains("(Loading/time step)"));
    CHECK_THROWS_AS(steps(duration, 1e-9), bergamo::ConfigError);
  }
}

TEST_CASE("a number of steps stays a whole one that can be counted")
{
  CHECK(whole_steps(0.) == 1);
  CHECK(whole_steps(7.9) == 7);
  CHECK(whole_steps(1e300) == 1000000000000000);
  CHECK(whole_steps(std::numeric_limits<double>::infinity()) == 1000000000000000);
}
