#include "drivers/common/run/discharge_record.h"
#include "drivers/common/run/snapshot.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace bergamo;
using namespace bergamo::driver;

namespace
{

const dem::HalfSpace below{Vec3::UnitZ(), -1.};

/// Balls of 1, 2, 4, .. kg at heights, the last one fixed.
dem::Particles balls(const std::vector<double> &heights)
{
  dem::Particles grains;
  double mass = 1.;
  for (const double z : heights)
  {
    grains.add({Vec3::Ones(), 1., 1.}, 1., Vec3(0., 0., z), Quaternion::Identity());
    grains.mass.back() = mass;
    mass *= 2.;
  }
  grains.fix(grains.size() - 1);
  return grains;
}

} // namespace

TEST_CASE("what is below the orifice, and what the outlet has taken, has passed")
{
  DischargeRecord record(below);
  CHECK(record.flow() == 0.);
  record.look(0., balls({0., 0., 0., -9.}), {});
  CHECK(record.mass() == 0.);
  record.look(2., balls({-2., 0., -1., -9.}), {.n_grains = 3, .mass = 0.5});
  CHECK(record.mass() == 5.5);
  CHECK(record.n_grains() == 5);
  CHECK(record.flow() == 2.75);
  CHECK(record.quiet_time() == 0.);
  record.look(3., balls({0., 0., -2., -9.}), {.n_grains = 3, .mass = 0.5}); // one has come back
  CHECK(record.mass() == 5.5);
  CHECK(record.flow() == 0.);
  CHECK(record.quiet_time() == 1.);
  CHECK(record.times() == std::vector<double>{0., 2., 3.});
  CHECK(record.masses() == std::vector<double>{0., 5.5, 5.5});
}

TEST_CASE("a record goes on after a restart")
{
  TemporaryFolder folder;
  const Snapshot snapshot(folder / "s.h5", "test", "");
  DischargeRecord before(below), after(below);
  before.look(1., balls({0., 0.}), {});
  before.look(2., balls({-2., 0.}), {});
  before.look(4., balls({-2., 0.}), {});
  snapshot.write([&](StateVisitor &v) { before.visit(v); });
  snapshot.read([&](StateVisitor &v) { after.visit(v); });
  const Table one(before.columns()), other(after.columns());
  CHECK(one.row() == other.row());
  CHECK(one.names() == std::vector<std::string>{"discharged_mass_kg", "discharged_grains", "mass_flow_kg_s"});
  CHECK(after.quiet_time() == 2.);
  CHECK(after.masses() == before.masses());
}
