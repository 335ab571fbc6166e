#include "dem/core/error.h"
#include "drivers/common/run/picture_series.h"
#include "drivers/common/run/snapshot.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace bergamo::driver;
using bergamo::ConfigError;
using bergamo::RunError;
using bergamo::Vec3;
using Catch::Matchers::Contains;

namespace
{

enum class Phase
{
  packing = 1,
  loading = 2
};

/// One of each kind that a driver may keep.
struct State
{
  double time = 0;
  std::int64_t step = 0;
  Phase phase = Phase::packing;
  Vec3 edges = Vec3::Zero();
  std::vector<double> times;
  std::vector<Vec3> places;
  double fixed[2] = {0, 0};

  void visit(StateVisitor &v)
  {
    v("time", time);
    v("loading/step", step);
    v("phase", phase);
    v("edges", edges);
    v("times", times);
    v("places", places);
    v("fixed", std::span<double>(fixed));
  }
};

Visit visit_of(State &state)
{
  return [&state](StateVisitor &v) { state.visit(v); };
}

} // namespace

TEST_CASE("one visit writes a state and reads it back to the last bit")
{
  TemporaryFolder folder;
  State state{.time = 1.0 / 3.0,
              .step = (std::int64_t(1) << 60) + 1,
              .phase = Phase::loading,
              .edges = {0.1, -0.0, std::numeric_limits<double>::infinity()},
              .times = {0, std::nextafter(1.0, 2.0)},
              .places = {{1, 2, 3}, {4, 5, 6}},
              .fixed = {7, 8}};
  const Snapshot snapshot(folder / "snapshot.h5", "test", "set a = 1");
  snapshot.write(visit_of(state));
  State read;
  read.times = {1, 2, 3}; // of another length than those in the file
  snapshot.read(visit_of(read));
  CHECK(read.time == state.time);
  CHECK(read.step == state.step);
  CHECK(read.phase == Phase::loading);
  CHECK(read.edges == state.edges);
  CHECK(std::signbit(read.edges[1]));
  CHECK(read.times == state.times);
  CHECK(read.places == state.places);
  CHECK(read.fixed[1] == 8);

  State empty;
  snapshot.write(visit_of(empty));
  snapshot.read(visit_of(read));
  CHECK(read.times.empty());
  CHECK(read.places.empty());
}

TEST_CASE("a snapshot of other parameters, of another kind or without a name is refused")
{
  TemporaryFolder folder;
  State state;
  Snapshot(folder / "s.h5", "test", "subsection A\n  set b = 1\nend\n").write(visit_of(state));
  const Snapshot other(folder / "s.h5", "test", "subsection A\n  set b = 2\nend\n");
  CHECK_THROWS_AS(other.read(visit_of(state)), ConfigError);
  CHECK_THROWS_WITH(other.read(visit_of(state)), Contains("('set b = 1' there, 'set b = 2' here)"));
  CHECK_THROWS_WITH(Snapshot(folder / "s.h5", "test", "subsection A\n").read(visit_of(state)), Contains("longer"));
  CHECK_THROWS_AS(Snapshot(folder / "s.h5", "else", "").read(visit_of(state)), RunError);
  const Snapshot same(folder / "s.h5", "test", "subsection A\n  set b = 1\nend\n");
  double missing = 0;
  CHECK_THROWS_AS(same.read([&](StateVisitor &v) { v("missing", missing); }), RunError);
  double three[3];
  CHECK_THROWS_AS(same.read([&](StateVisitor &v) { v("fixed", std::span<double>(three)); }), RunError);
}

TEST_CASE("a state that cannot be written leaves the snapshot before it whole")
{
  TemporaryFolder folder;
  State state;
  const Snapshot snapshot(folder / "s.h5", "test", "");
  snapshot.write(visit_of(state));
  const std::string before = content_of(folder / "s.h5");
  CHECK_THROWS(snapshot.write([](StateVisitor &) { throw RunError("diverged"); }));
  CHECK(content_of(folder / "s.h5") == before);
}

TEST_CASE("pictures are numbered and joined, also after a restart")
{
  TemporaryFolder folder;
  const auto write = [](const std::filesystem::path &path) { put(path, "picture"); };
  const std::vector<std::pair<std::string, PictureWriter>> models{{"grains", write}, {"continuum", write}};
  const Snapshot snapshot(folder / "s.h5", "test", "");
  {
    PictureSeries pictures(folder.path());
    pictures.add(0, models);
    pictures.add(0.5, models);
    snapshot.write([&](StateVisitor &v) { pictures.visit(v); });
    pictures.add(1, models); // lost with the kill that follows
  }
  PictureSeries pictures(folder.path());
  snapshot.read([&](StateVisitor &v) { pictures.visit(v); });
  pictures.add(1.5, models);
  CHECK(std::filesystem::exists(folder / "grains_0002.vtu"));
  CHECK(std::filesystem::exists(folder / "continuum_0002.vtu"));
  CHECK_FALSE(std::filesystem::exists(folder / "grains_0003.vtu"));
  CHECK_THAT(content_of(folder / "grains.pvd"), Contains("0.5") && Contains("1.5") && Contains("grains_0002.vtu"));
}

TEST_CASE("a snapshot written behind is that of the moment, and in place after the next call at the latest")
{
  TemporaryFolder folder;
  State state;
  state.step = 1;
  Snapshot snapshot(folder / "s.h5", "test", "");
  snapshot.write_behind(visit_of(state));
  state.step = 2; // on it goes
  snapshot.wait();
  State found;
  snapshot.read(visit_of(found));
  CHECK(found.step == 1);
  snapshot.write_behind(visit_of(state));
  snapshot.read(visit_of(found)); // waits by itself
  CHECK(found.step == 2);
  CHECK_THROWS_WITH(snapshot.write_behind([](StateVisitor &) { throw RunError("diverged"); }), Contains("diverged"));
  snapshot.read(visit_of(found));
  CHECK(found.step == 2);

  // What goes wrong on the disk comes at the next call, and is told once.
  Snapshot lost(folder / "t.h5", "test", "");
  CHECK_NOTHROW(
      lost.write_behind([&](StateVisitor &) { std::filesystem::create_directories(folder / "t.h5/in_the_way"); }));
  CHECK_THROWS_WITH(lost.write_behind(visit_of(state)), Contains("t.h5"));
  CHECK_NOTHROW(lost.wait());
}
