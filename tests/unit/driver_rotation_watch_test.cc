#include "drivers/common/progress.h"
#include "drivers/common/run/rotation_watch.h"
#include "drivers/common/run/snapshot.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "tests/deform.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

using namespace bergamo;
using namespace bergamo::driver;
using Catch::Matchers::Contains;

TEST_CASE("a body of small strain that turns by more than 5 degrees is warned of once, also after a restart")
{
  fe::ExplicitBody body = fe::make_box_body({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {});
  const auto turn = [&](const double degrees)
  {
    const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
    fe::deform(body, {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}});
  };
  std::ostringstream stream;
  ProgressOptions options;
  options.quiet = true;
  options.stream = &stream;
  Progress progress(options);
  RotationWatch watch;
  turn(4.9);
  watch.look(body, progress);
  CHECK(stream.str().empty());
  turn(5.1);
  watch.look(body, progress);
  CHECK_THAT(stream.str(), Contains("turned by 5.1 degrees") && Contains("load less"));
  const std::string first = stream.str();
  turn(1.);
  watch.look(body, progress);
  turn(8.);
  watch.look(body, progress);
  turn(3.);
  watch.look(body, progress);
  CHECK(stream.str() == first);
  CHECK(watch.greatest() == Approx(8.));

  TemporaryFolder folder;
  const Snapshot snapshot(folder / "s.h5", "test", "");
  snapshot.write([&](StateVisitor &v) { watch.visit(v); });
  RotationWatch after;
  snapshot.read([&](StateVisitor &v) { after.visit(v); });
  CHECK(after.greatest() == watch.greatest());
  turn(6.);
  after.look(body, progress);
  CHECK(stream.str() == first);
}
