#include "drivers/common/progress.h"
#include "drivers/common/run/snapshot.h"
#include "drivers/common/run/stable_step_watch.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

#include <sstream>
#include <string>

using namespace bergamo::driver;
using Catch::Matchers::Contains;

TEST_CASE("a step beyond the stable one is warned of once, and the smallest stable one is kept")
{
  std::ostringstream stream;
  ProgressOptions options;
  options.quiet = true;
  options.stream = &stream;
  Progress progress(options);
  StableStepWatch watch("Loading/time step");
  CHECK(watch.smallest() == 0.);
  watch.look(1e-6, 1e-6, progress); // just stable
  CHECK(stream.str().empty());
  watch.look(1e-6, 0.5e-6, progress);
  CHECK_THAT(stream.str(), Contains("Loading/time step is 1e-06 s") && Contains("estimated at 5e-07 s"));
  const std::string first = stream.str();
  watch.look(1e-6, 0.25e-6, progress);
  watch.look(1e-6, 2e-6, progress);
  CHECK(stream.str() == first);
  CHECK(watch.smallest() == 0.25e-6);
}

TEST_CASE("the smallest stable step is that of the whole run, also after a restart")
{
  std::ostringstream stream;
  ProgressOptions options;
  options.stream = &stream;
  Progress progress(options);
  StableStepWatch before("Loading/time step"), after("Loading/time step");
  before.look(1e-6, 2e-6, progress);
  TemporaryFolder folder;
  const Snapshot snapshot(folder / "s.h5", "test", "");
  snapshot.write([&](StateVisitor &v) { before.visit(v); });
  snapshot.read([&](StateVisitor &v) { after.visit(v); });
  after.look(1e-6, 3e-6, progress);
  CHECK(after.smallest() == 2e-6);
}
