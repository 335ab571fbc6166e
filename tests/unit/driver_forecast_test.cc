#include "dem/motion/stable_step.h"
#include "drivers/common/forecast/forecast_text.h"
#include "drivers/common/forecast/grain_trial.h"
#include "drivers/common/forecast/step_trial.h"
#include "drivers/common/step_advice.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace bergamo;
using namespace bergamo::driver;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;

namespace
{

Forecast two_stages()
{
  Forecast f;
  f.n_grains = 1234;
  f.n_contacts = 5678;
  f.n_elements = 64;
  f.n_nodes = 125;
  f.stages = {{"packing", 3170, false, 2e-6, 5e-6, 0.01}, {"shear", 400, true, 1e-6, 0, 0.02}};
  f.files = {{"pictures", 3, 2e6}, {"history", 1, 4e3}};
  f.bytes_of_memory = 1e9;
  f.unknown = {"the weather"};
  return f;
}

const MachineRoom large{.bytes_of_memory = 8e9, .bytes_of_disk = 1e12, .n_threads = 2};

} // namespace

TEST_CASE("a forecast adds up its stages and its files")
{
  Forecast f = two_stages();
  CHECK(f.n_steps() == 3570);
  CHECK(f.bytes() == 6'004'000);
  const double alone = f.seconds();
  CHECK(alone >= 3170 * 0.01 + 400 * 0.02);
  f.n_side_by_side = 2;
  CHECK(f.seconds() < 0.6 * alone);
  CHECK(f.seconds() >= 0.5 * (3170 * 0.01 + 400 * 0.02));
}

TEST_CASE("a snapshot counts where the run is long enough for one")
{
  for (const double interval : {10., 1000.})
  {
    Forecast f = two_stages(); // 39.7 s
    const double before = f.bytes();
    f.add_own_files(interval, 1e9);
    CHECK((f.bytes() > before + 1e9) == (interval < 30));
    CHECK(f.bytes() > before);
  }
}

TEST_CASE("a forecast is told with what is exact and what is about")
{
  const std::string text = text_of(two_stages(), "results/x", large);
  CHECK_THAT(text, Contains("  grains     1234, in about 5700 contacts\n"));
  CHECK_THAT(text, Contains("  elements   64 hexahedra, 125 nodes\n"));
  CHECK_THAT(text, Contains("  steps      about 3200 of 2e-06 s: packing (stable below about 5e-06 s)\n"));
  CHECK_THAT(text, Contains("\n             400 of 1e-06 s: shear\n             about 3600 in all\n"));
  CHECK_THAT(text, Contains("half to twice as long") && Contains("on 2 threads"));
  CHECK_THAT(text, Contains("about 6 MB in results/x; 1 TB are free\n") && Contains("6 MB      pictures, 3\n"));
  CHECK_THAT(text, Contains("about 1.16 GB; 8 GB are free\n"));
  CHECK_THAT(text, Contains("  not known  the weather\n") && !Contains("WARNING"));
  CHECK_THAT(text, EndsWith("the weather\nNothing was computed or written: --dry-run.\n"));
}

TEST_CASE("a forecast warns where memory or disk would not do")
{
  MachineRoom room = large;
  room.bytes_of_disk = 5e6;
  CHECK_THAT(text_of(two_stages(), "x", room), Contains("about 6 MB in x; WARNING: only 5 MB are free"));
  room.bytes_of_memory = 1.1e9;
  CHECK_THAT(text_of(two_stages(), "x", room), Contains("about 1.16 GB; WARNING: only 1.1 GB are free"));
  room.bytes_of_disk = room.bytes_of_memory = 0; // the system does not say
  CHECK_THAT(text_of(two_stages(), "x", room), !Contains("WARNING") && !Contains("are free"));
}

TEST_CASE("the room for a run is that of the nearest folder there is, and none is made")
{
  TemporaryFolder folder;
  const MachineRoom room = room_for(folder / "a" / "b");
  CHECK(room.bytes_of_disk == Approx(room_for(folder.path()).bytes_of_disk).epsilon(0.2));
  CHECK(room.bytes_of_disk > 0);
  CHECK(room.bytes_of_memory > 0);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("bytes read well")
{
  CHECK(text_of_bytes(0) == "0 kB");
  CHECK(text_of_bytes(1234) == "1.23 kB");
  CHECK(text_of_bytes(999'600) == "1 MB");
  CHECK(text_of_bytes(2.5e9) == "2.5 GB");
}

TEST_CASE("a trial has the grains of the run, and moves them in a dense packing")
{
  GradingParameters sizes;
  sizes.kind = SizeKind::uniform;
  constexpr double edge = 6e-3, solid_fraction = 0.5;
  constexpr std::uint64_t seed = 3;
  GrainTrial trial(sizes, solid_fraction * std::pow(edge, 3), seed);
  dem::PackingParameters packing;
  packing.solid_fraction = solid_fraction;
  const auto cell = dem::PackingSpace::periodic({Vec3::Zero(), Vec3::Constant(edge)});
  CHECK(trial.n_grains() == static_cast<double>(sizes.pack(cell, packing, seed).particles.size()));

  dem::SimulationParameters parameters;
  parameters.gravity = Vec3(0, 0, -9.81); // of the run; a cell has none
  CHECK(trial.seconds_of_step(parameters) > 0);
  const double contacts = 2 * trial.n_contacts() / trial.n_grains(); // of a grain: of packings from random to dense
  CHECK(contacts > 3);
  CHECK(contacts < 10);
  CHECK(trial.stable_step(1e3) > 0);
  CHECK(trial.stable_step(64e3) == Approx(0.5 * trial.stable_step(1e3)));
  CHECK(trial.stable_step(1e3) < dem::stable_step_of_two_spheres(1e-3, parameters.grain(), 1e-5));
}

TEST_CASE("seconds of a step come from making it")
{
  int n = 0;
  CHECK(seconds_of([&] { ++n; }) >= 0);
  CHECK(n > 5);
}

TEST_CASE("a step far below the stable one gets advice, with the remedy")
{
  const dem::Material grain{.young_modulus = 5e7, .poisson_ratio = 0.2, .density = 2650};
  const double limit = dem::stable_step_of_two_spheres(1e-3, grain, 1e-5);
  CHECK(advice_on_step({"Loading/time step", 0.02 * limit}, 1e-3, grain).empty());
  CHECK(advice_on_step({"Loading/time step", 2 * limit}, 1e-3, grain).empty()); // which is refused elsewhere
  const auto advice = advice_on_step({"Loading/time step", 0.005 * limit}, 1e-3, grain);
  REQUIRE(advice.size() == 1);
  CHECK_THAT(advice[0], Contains("Loading/time step is ") && Contains("0.5 %") && Contains("20 times fewer steps"));
}

TEST_CASE("a penalty far from the continuum's stiffness gets advice, with the usual range")
{
  constexpr double modulus = 1e8, diameter = 1e-3; // 1e14 Pa/m2
  for (const double usual : {1.1e12, 1e14, 0.9e18})
    CHECK(advice_on_penalty(usual, diameter, modulus).empty());
  const auto soft = advice_on_penalty(1e11, diameter, modulus), stiff = advice_on_penalty(1e19, diameter, modulus);
  REQUIRE((soft.size() == 1 && stiff.size() == 1));
  CHECK_THAT(soft[0], Contains("Coupling/penalty is 1e+11 Pa/m2") && Contains("drift apart") &&
                          Contains("between 1e+12 and 1e+18 is usual"));
  CHECK_THAT(stiff[0], Contains("shorter steps"));
}
