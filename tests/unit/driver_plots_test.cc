#include "drivers/common/plots.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace bergamo::driver;
using Catch::Matchers::Contains;

TEST_CASE("the diagram of the stresses is drawn, also when the last row is incomplete")
{
  TemporaryFolder folder;
  put(folder / "history.csv",
      "time_s,stage,stress_1_Pa,stress_2_Pa,stress_3_Pa\n0,0,0,0,0\n1,1,-1e5,-1e5,-2e5\n2,1,-1");
  const PlotResult result = make_plots({{"stresses.py", {folder.path().string()}}});
  CHECK(result.warnings.empty());
  REQUIRE(result.pictures.size() == 1);
  CHECK(result.pictures[0] == folder / "plots/stresses.png");
  CHECK_THAT(content_of(result.pictures[0]), Contains("PNG"));
}

TEST_CASE("a picture that cannot be drawn is a warning with the reason, and the others go on")
{
  TemporaryFolder folder;
  const std::string name = folder.path().string();
  const PlotResult result = make_plots({{"stresses.py", {name}}, {"picture.py", {name}}, {"no_such_script.py", {}}});
  CHECK(result.pictures.empty());
  REQUIRE(result.warnings.size() == 3);
  CHECK_THAT(result.warnings[0], Contains("stresses.py not drawn") && Contains("history.csv"));
  CHECK_THAT(result.warnings[1], Contains("neither grains_*.vtu nor continuum_*.vtu"));
}

TEST_CASE("a script runs in a process group of its own, so that one signal ends it with all that it has started")
{
  TemporaryFolder folder;
  put(folder / "head_of_group.py", "import os, sys\nsys.exit(os.getpgrp() != os.getpid())\n");
  CHECK(make_plots({{(folder / "head_of_group.py").string(), {}}}).warnings.empty());
}
