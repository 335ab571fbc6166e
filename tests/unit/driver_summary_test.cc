#include "dem/core/error.h"
#include "drivers/common/report_run.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <iostream>
#include <limits>
#include <sstream>

using namespace bergamo::driver;

namespace
{

/// While it lives, standard output is a text.
class CapturedOutput
{
public:
  CapturedOutput() : terminal_(std::cout.rdbuf(text_.rdbuf())) {}
  ~CapturedOutput() { std::cout.rdbuf(terminal_); }
  std::string text() const { return text_.str(); }

private:
  std::ostringstream text_;
  std::streambuf *terminal_;
};

/// The end of a run without pictures. @return what it printed
std::string report(const Summary &summary, const RunFolder &folder, const bool quiet)
{
  CommandLine command_line;
  command_line.quiet = quiet;
  command_line.plots = false;
  const CapturedOutput output;
  report_run(summary, folder, command_line, {});
  return output.text();
}

} // namespace

TEST_CASE("a summary keeps its order, its exact numbers and its names")
{
  Summary summary;
  summary.set("model", "Arlequin");
  summary.set(RunFigures{.wall_time_s = 1.0 / 3.0, .steps = 123456789012345, .particles = 10});
  summary.set("converged", true);
  summary.set("axis", std::vector<double>{1, 0.1 + 0.2});
  summary.set("gap", std::numeric_limits<double>::infinity());
  summary.set("model", "DEM"); // changes it in its place
  TemporaryFolder folder;
  summary.write(folder / "summary.json");
  const auto json = nlohmann::ordered_json::parse(content_of(folder / "summary.json"));
  CHECK(json.begin().key() == "model");
  CHECK(json["model"] == "DEM");
  CHECK(json["wall_time_s"].get<double>() == 1.0 / 3.0);
  CHECK(json["steps"].get<std::int64_t>() == 123456789012345);
  CHECK(json["converged"] == true);
  CHECK(json["axis"][1].get<double>() == 0.1 + 0.2);
  CHECK(json["gap"].is_null());
  for (const char *name : {"wall_time_s", "core_hours", "core_time_per_step_s", "steps", "particles", "threads",
                           "particle_steps_per_second", "time_step_s", "stable_time_step_s", "energy_residual",
                           "undecided_contacts", "max_overlap_over_radius"})
    CHECK(json.contains(name));
}

TEST_CASE("the table of results is aligned")
{
  Summary summary;
  summary.set("model", "Arlequin");
  summary.set("wall_time_s", 12.3456789, "s");
  summary.set("steps", 1000);
  CHECK(summary.table() == "  model        Arlequin\n"
                           "  wall_time_s  12.3457 s\n"
                           "  steps           1000\n");
  CHECK(Summary().table().empty());
}

TEST_CASE("a summary has a figure that is set twice once, in its place and with the last value")
{
  Summary summary;
  summary.set("wall_time_s", 1.5, "min");
  summary.set("steps", 1000);
  summary.set("wall_time_s", 90, "s"); // of another type and unit
  CHECK(summary.table() == "  wall_time_s    90 s\n"
                           "  steps        1000\n");
  CHECK(summary.json() == "{\n  \"wall_time_s\": 90,\n  \"steps\": 1000\n}\n");
}

TEST_CASE("the end of a run leaves the whole summary in its folder, and shows it unless it shall be quiet")
{
  TemporaryFolder parent;
  Summary summary;
  summary.set("model", "Arlequin");
  summary.set(RunFigures{.wall_time_s = 1.0 / 3.0, .steps = 42, .particles = 10});
  RunFolder folder(parent / "run", FolderMode::fresh);
  folder.open();
  const bool quiet = GENERATE(true, false);
  CHECK(report(summary, folder, quiet) == (quiet ? "" : summary.table()));
  REQUIRE(std::filesystem::exists(parent / "run/summary.json"));
  const std::string written = content_of(parent / "run/summary.json");
  CHECK(written == summary.json());
  const auto figures = nlohmann::json::parse(written);
  CHECK(figures["model"] == "Arlequin");
  CHECK(figures["wall_time_s"].get<double>() == 1.0 / 3.0);
  CHECK(figures["steps"] == 42);
}

TEST_CASE("what the parameters have that is unusual stays in the summary, and out of the table")
{
  TemporaryFolder parent;
  RunFolder folder(parent / "run", FolderMode::fresh);
  folder.open();
  Summary summary;
  summary.set("steps", 1);
  CommandLine command_line;
  command_line.plots = false;
  command_line.warnings = {"a density of 1.8", "a step that is \"short\""};
  const CapturedOutput output;
  report_run(summary, folder, command_line, {});
  CHECK(output.text() == summary.table());
  const auto figures = nlohmann::json::parse(content_of(folder.summary()));
  CHECK(figures["warnings"].get<std::vector<std::string>>() == command_line.warnings);
}

TEST_CASE("the end of a run says where its summary cannot be written")
{
  TemporaryFolder parent;
  RunFolder folder(parent / "run", FolderMode::fresh);
  folder.open();
  put(parent / "run/summary.json/file", "x"); // a folder in its place
  CHECK_THROWS_AS(report(Summary(), folder, true), bergamo::RunError);
}
