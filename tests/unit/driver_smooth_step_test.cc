#include "drivers/common/smooth_step.h"

#include <catch2/catch.hpp>

using bergamo::driver::smooth_step;

TEST_CASE("a smooth step rises from 0 to 1, even about its middle, and begins and ends without a slope")
{
  CHECK(smooth_step(-1.) == 0.);
  CHECK(smooth_step(0.) == 0.);
  CHECK(smooth_step(0.25) == 0.15625); // 3 s² − 2 s³
  CHECK(smooth_step(0.5) == 0.5);
  CHECK(smooth_step(1.) == 1.);
  CHECK(smooth_step(2.) == 1.);
  constexpr double h = 1e-6;
  CHECK(smooth_step(h) < 3.1 * h * h);
  CHECK(1. - smooth_step(1. - h) < 4. * h * h);
  for (const double share : {0.1, 0.2, 0.3, 0.4})
    CHECK(smooth_step(share) + smooth_step(1. - share) == Approx(1.).epsilon(1e-15));
}
