#include "drivers/common/run/snapshot.h"
#include "drivers/common/run/visit_models.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/step_control.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace bergamo;
using namespace bergamo::driver;

TEST_CASE("a restarted run takes no longer a step than the one that it goes on from would have")
{
  fe::ExplicitBody body = fe::make_box_body({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {});
  fe::StepControl before(body);
  const double stable = before.stable().time_step;
  before.next(0.2); // it may grow by a percent from here

  TemporaryFolder folder;
  const Snapshot snapshot(folder / "s.h5", "test", "");
  snapshot.write([&](StateVisitor &v) { visit_steps(v, before); });
  fe::StepControl after(body);
  snapshot.read([&](StateVisitor &v) { visit_steps(v, after); });
  CHECK(after.smallest_step() == before.smallest_step());
  CHECK(after.next(0.5) == before.next(0.5));
  CHECK(after.next(0.5) < 0.21 * stable);
}
