// Sand of the drivers: its parameters, its settling, its packing, and the flow out of it.

#include "dem/core/error.h"
#include "dem/motion/stable_step.h"
#include "dem/packing/pack_grains.h"
#include "drivers/common/packing_target.h"
#include "drivers/common/sand_parameters.h"
#include "drivers/common/steady_flow_parameters.h"

#include <catch2/catch.hpp>

using namespace bergamo;
using namespace bergamo::driver;
using Catch::Matchers::Contains;

TEST_CASE("sand gets what the file says, and settles under its own gravity, step and damping")
{
  SandParameters sand;
  ParameterFile file("test");
  sand.declare(file);
  for (const char *assignment : {"Sand/box=1, 2, 3", "Sand/smallest half-axis=1e-4", "Sand/solid fraction=0.4",
                                 "Sand/seed=7", "Sand/Settling/gravity=500", "Sand/Settling/time=1e-2",
                                 "Sand/Settling/time step=1e-5", "Sand/Settling/damping ratio=0.7"})
    file.set(assignment);
  CHECK(sand.box == Vec3(1, 2, 3));
  CHECK(sand.distribution.smallest_half_axis == 1e-4);
  CHECK(sand.solid_fraction == 0.4);
  CHECK(sand.seed == 7);
  CHECK(sand.n_settling_steps() == 1000);

  dem::SimulationParameters after;
  after.gravity = {1., 2., 3.};
  after.time_step = 3e-7;
  after.set_damping(0.1);
  const dem::SimulationParameters settling = sand.settling(after);
  CHECK(settling.gravity == Vec3(0., 0., -500.));
  CHECK(settling.time_step == 1e-5);
  CHECK(settling.materials.between(0, 0).damping_ratio == 0.7);
  CHECK(settling.materials.between(0, 0).friction == after.materials.between(0, 0).friction);
}

TEST_CASE("a step beyond the stable one of the smallest grains is refused by its name")
{
  const SandParameters sand;
  const dem::Material grain;
  const double limit = dem::stable_step_of_two_spheres(sand.distribution.smallest_half_axis, grain, 1e-5);
  CHECK_NOTHROW(sand.require_stable({"Pull/time step", 0.99 * limit}, grain));
  CHECK_THROWS_WITH(sand.require_stable({"Pull/time step", 1.01 * limit}, grain),
                    Contains("Pull/time step is") && Contains("smallest grains"));
  SandParameters fast;
  fast.settling_step = 1.01 * limit;
  CHECK_THROWS_WITH(fast.validate(grain, {Vec3::Zero(), fast.box}), Contains("Sand/Settling/time step"));
}

TEST_CASE("a packing that got stuck below its target is refused with the remedy")
{
  dem::PackedGrains packed;
  packed.report.solid_fraction = 0.55;
  CHECK_NOTHROW(require_target(packed, 0.55, "Sand/solid fraction"));
  packed.report.has_reached_target = false;
  CHECK_THROWS_AS(require_target(packed, 0.6, "Sand/solid fraction"), RunError);
  CHECK_THROWS_WITH(require_target(packed, 0.6, "Sand/solid fraction"),
                    Contains("0.55") && Contains("of 0.6") && Contains("choose a smaller Sand/solid fraction"));
}

TEST_CASE("a steady flow ends after it has begun, and no later than the discharge")
{
  SteadyFlowParameters flow;
  ParameterFile file("test");
  flow.declare(file);
  for (const char *assignment : {"Steady flow/first share=0.2", "Steady flow/last share=0.5", "Steady flow/windows=4"})
    file.set(assignment);
  CHECK(flow.n_windows == 4);
  CHECK(flow.span(10.).first == 2.);
  CHECK(flow.span(10.).last == 5.);
  CHECK_NOTHROW(flow.validate(0.5));
  CHECK_THROWS_WITH(flow.validate(0.4), Contains("Steady flow/last share is 0.5") && Contains("Discharge/last share"));
  flow.first_share = 0.5;
  CHECK_THROWS_WITH(flow.validate(1.), Contains("more than its first share"));
}
