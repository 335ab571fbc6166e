#include "dem/core/error.h"
#include "drivers/common/command_line.h"
#include "drivers/common/driver_main.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>
#include <omp.h>

#include <iostream>
#include <sstream>

using namespace bergamo::driver;
using bergamo::ConfigError;
using Catch::Matchers::Contains;

namespace
{

using Files = std::vector<std::filesystem::path>;

std::optional<CommandLine> parse(std::vector<std::string> words)
{
  words.insert(words.begin(), "triaxial");
  std::vector<const char *> arguments;
  for (const std::string &word : words)
    arguments.push_back(word.c_str());
  return parse_command_line(static_cast<int>(arguments.size()), arguments.data(), {"triaxial", "A test."});
}

/// What is written to a stream meanwhile.
class Output
{
public:
  explicit Output(std::ostream &stream = std::cout) : stream(stream), before(stream.rdbuf(buffer.rdbuf())) {}
  ~Output() { stream.rdbuf(before); }
  std::string text() const { return buffer.str(); }

private:
  std::ostringstream buffer;
  std::ostream &stream;
  std::streambuf *before;
};

} // namespace

TEST_CASE("a command line is read, and its defaults filled in")
{
  TemporaryFolder folder;
  const std::string file = (folder / "sand.prm").string();
  put(file, "");
  const auto plain = parse({file});
  REQUIRE(plain);
  CHECK(plain->parameter_files == Files{file});
  CHECK(plain->output == "results/sand");
  CHECK(plain->plots);
  CHECK_FALSE(plain->threads);

  const auto full = parse({"--set", "Grains/friction=-0.5", file, "--set=Run/title=[a, b]", "--threads", "1",
                           "--output", "out", "--force", "--quiet", "--no-plots"});
  REQUIRE(full);
  CHECK(full->settings == std::vector<std::string>{"Grains/friction=-0.5", "Run/title=[a, b]"});
  CHECK(full->parameter_files == Files{file});
  CHECK(full->threads == 1);
  CHECK(full->output == "out");
  CHECK(parse({file, "--output", "./-out"})->output == "./-out");
  CHECK(full->force);
  CHECK(full->quiet);
  CHECK_FALSE(full->plots);
  CHECK_FALSE(full->restart);

  CHECK(parse({"--print-parameters"})->print_parameters);
}

TEST_CASE("several parameter files keep their order, and the first one names the folder")
{
  TemporaryFolder folder;
  const std::string sand = (folder / "sand.prm").string(), fit = (folder / "fit.prm").string();
  put(sand, "");
  put(fit, "");
  const auto command_line = parse({sand, "--set", "Grains/friction=0.5", fit});
  REQUIRE(command_line);
  CHECK(command_line->parameter_files == Files{sand, fit});
  CHECK(command_line->output == "results/sand");
}

TEST_CASE("of several parameter files, later ones win, --set wins over all, and what none names keeps its default")
{
  TemporaryFolder folder;
  const std::string sand = (folder / "sand.prm").string(), fit = (folder / "fit.prm").string();
  put(sand, "subsection Grains\n set friction = 0.1\n set density = 2000\n set damping = 0.5\nend\n");
  put(fit, "subsection Grains\n set density = 2500\n set damping = 0.6\nend\n");
  double friction = 0, density = 0, damping = 0, hardness = 7;
  ParameterFile file("Test");
  file.add("Grains", "friction", friction, "of grains");
  file.add("Grains", "density", density, "of grains [kg/m3]");
  file.add("Grains", "damping", damping, "of contacts");
  file.add("Grains", "hardness", hardness, "of grains");
  REQUIRE(read_parameters(file, *parse({sand, fit, "--set", "Grains/damping=0.7"})));
  CHECK(friction == 0.1);
  CHECK(density == 2500);
  CHECK(damping == 0.7);
  CHECK(hardness == 7);

  put(fit, "subsection Grains\n set densty = 2500\nend\n");
  CHECK_THROWS_WITH(read_parameters(file, *parse({sand, fit})), Contains("fit.prm") && Contains("densty"));
}

TEST_CASE("--help takes the name of a parameter, needs no file then, and leaves parameter files alone")
{
  TemporaryFolder folder;
  const std::string file = (folder / "sand.prm").string();
  put(file, "");
  CHECK(parse({"--help", "Grains/friction"})->help_topic == "Grains/friction");
  CHECK(parse({"-h", "Grains"})->help_topic == "Grains");
  CHECK(parse({"--help=Grains"})->help_topic == "Grains");
  const auto with_file = parse({file, "--set", "Grains/friction=1", "--help", "Grains/friction"});
  CHECK(with_file->parameter_files == Files{file});
  CHECK(with_file->help_topic == "Grains/friction");
  const Output output;
  CHECK_FALSE(parse({"--help"}));
  CHECK_FALSE(parse({"--help", "--quiet"}));
  CHECK_FALSE(parse({"--help", file}));
  CHECK_FALSE(parse({file, "-h"}));
  CHECK_THAT(output.text(), Contains("Usage: triaxial"));
}

TEST_CASE("the explanation of a parameter comes also where a file has a mistake, which is told after it")
{
  TemporaryFolder folder;
  const std::string sand = (folder / "sand.prm").string();
  put(sand, "subsection Grains\n set friction = -1\nend\n");
  double friction = 0.5;
  ParameterFile file("Test");
  file.add("Grains", "friction", friction, "of grains", Range::non_negative());
  const Output output;
  CHECK_THROWS_WITH(read_parameters(file, *parse({sand, "--help", "friction"})), Contains("'-1' is out of range"));
  CHECK_THAT(output.text(), Contains("allowed    a number >= 0"));

  put(sand, "subsection Grains\n set friction = 1\nend\n");
  CHECK_FALSE(read_parameters(file, *parse({sand, "--help", "friction"})));
  CHECK_THAT(output.text(), Contains("in force   1, set by sand.prm line 2"));
}

TEST_CASE("what is unusual is told on standard error and kept with the command line")
{
  TemporaryFolder folder;
  const std::string sand = (folder / "sand.prm").string();
  put(sand, "subsection Grains\n set density = 2.6\nend\n");
  double density = 2600;
  ParameterFile file("Test");
  file.add("Grains", "density", density, "of grains [kg/m3]", Range::positive().usual(500, 20000));
  const CommandLine words = *parse({sand});
  REQUIRE(read_parameters(file, words));
  const Output output(std::cerr);
  const CommandLine warned = warned_of(file, words, {"the moon is full"});
  REQUIRE(warned.warnings.size() == 2);
  CHECK_THAT(warned.warnings[0], Contains("Grains/density is 2.6 kg/m3 (sand.prm line 2)"));
  CHECK(output.text() == "warning: " + warned.warnings[0] + "\nwarning: the moon is full\n");
  CHECK(warned.parameter_files == words.parameter_files);
}

TEST_CASE("mistakes on the command line are explained")
{
  TemporaryFolder folder;
  const std::string file = (folder / "sand.prm").string();
  put(file, "");
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{}, "no parameter file given"},
      {{(folder / "sound.prm").string()}, "does not exist"},
      {{folder.path().string()}, "is a folder"},
      {{file, "--theads", "2"}, "unknown option '--theads'; did you mean '--threads'?"},
      {{file, "second.prm"}, "'second.prm' does not exist"},
      {{file, (folder / "." / "sand.prm").string()}, "is given twice"},
      {{file, "--threads", "0"}, "--threads 0 is out of range; allowed: 1 to "},
      {{file, "--threads", "-3"}, "--threads -3 is out of range"},
      {{file, "--threads", std::to_string(4 * omp_get_num_procs() + 1)}, "is out of range"}, // four a core
      {{file, "--threads", "100000"}, "--threads 100000 is out of range"},
      {{file, "--threads", "two"}, "--threads"},
      {{file, "--set", "Grains/friction"}, "has no '='"},
      {{file, "--set"}, "--set"},
      {{file, "--set", "--quiet"}, "has no '='"},
      {{file, "--threads", "--quiet"}, "--threads"},
      {{file, "--output"}, "--output"},
      {{file, "--output", "--no-plots"}, "--output --no-plots names no folder"},
      {{file, "--output=-q", "--force"}, "--output -q names no folder"},
      {{file, "--force", "--restart"}, "contradict"},
  };
  for (const auto &[words, message] : wrong)
  {
    CHECK_THROWS_WITH(parse(words), Contains(message));
    CHECK_THROWS_AS(parse(words), ConfigError);
  }
}
