#include "dem/core/error.h"
#include "drivers/common/command_line.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace bergamo::driver;
using bergamo::dem::ConfigError;
using Catch::Matchers::Contains;

namespace
{

std::optional<CommandLine> parse(std::vector<std::string> words)
{
  words.insert(words.begin(), "triaxial");
  std::vector<const char *> arguments;
  for (const std::string &word : words)
    arguments.push_back(word.c_str());
  return parse_command_line(static_cast<int>(arguments.size()), arguments.data(), {"triaxial", "A test."});
}

} // namespace

TEST_CASE("a command line is read, and its defaults filled in")
{
  TemporaryFolder folder;
  const std::string file = (folder / "sand.prm").string();
  put(file, "");
  const auto plain = parse({file});
  REQUIRE(plain);
  CHECK(plain->parameter_file == file);
  CHECK(plain->output == "results/sand");
  CHECK(plain->plots);
  CHECK_FALSE(plain->threads);

  const auto full = parse({"--set", "Grains/friction=-0.5", file, "--set=Run/title=[a, b]", "--threads", "1",
                           "--output", "out", "--force", "--quiet", "--no-plots"});
  REQUIRE(full);
  CHECK(full->settings == std::vector<std::string>{"Grains/friction=-0.5", "Run/title=[a, b]"});
  CHECK(full->parameter_file == file);
  CHECK(full->threads == 1);
  CHECK(full->output == "out");
  CHECK(full->force);
  CHECK(full->quiet);
  CHECK_FALSE(full->plots);
  CHECK_FALSE(full->restart);

  CHECK(parse({"--print-parameters"})->print_parameters);
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
      {{file, "second.prm"}, "unexpected argument 'second.prm'"},
      {{file, "--threads", "0"}, "--threads 0 is out of range; allowed: 1 to "},
      {{file, "--threads", "-3"}, "--threads -3 is out of range"},
      {{file, "--threads", "100000"}, "--threads 100000 is out of range"},
      {{file, "--threads", "two"}, "--threads"},
      {{file, "--set", "Grains/friction"}, "has no '='"},
      {{file, "--set"}, "--set"},
      {{file, "--force", "--restart"}, "contradict"},
  };
  for (const auto &[words, message] : wrong)
  {
    CHECK_THROWS_WITH(parse(words), Contains(message));
    CHECK_THROWS_AS(parse(words), ConfigError);
  }
}
