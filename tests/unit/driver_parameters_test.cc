#include "dem/core/error.h"
#include "drivers/common/clump_parameters.h"
#include "drivers/common/nearest_name.h"
#include "drivers/common/parameter_file.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace bergamo::driver;
using bergamo::ConfigError;
using Catch::Matchers::Contains;
using Catch::Matchers::Message;

namespace
{

enum class Law
{
  hertz,
  linear
};

struct Values
{
  double friction = 0.5;
  double modulus = 7e10;
  int number = 100;
  std::uint64_t seed = 1;
  bool gravity = true;
  std::string title = "Sand";
  std::string solver = "direct";
  Law law = Law::hertz;
  std::array<double, 3> axis = {1, 0, 0};
  std::vector<double> times;

  bool operator==(const Values &) const = default;
};

void declare(ParameterFile &file, Values &values)
{
  file.add("Grains", "friction", values.friction, "Coulomb friction coefficient", Range::non_negative());
  file.add("Grains", "number", values.number, "number of grains", Range::between(1, 1e6));
  file.add("Grains/Material", "modulus", values.modulus, "Young's modulus [Pa]", Range::positive());
  file.add("Grains", "law", values.law, "contact law", {{"hertz", Law::hertz}, {"linear", Law::linear}});
  file.add("Run", "seed", values.seed, "seed of the random numbers");
  file.add("Run", "gravity", values.gravity, "whether there is gravity");
  file.add("Run", "title", values.title, "title of the diagrams");
  file.add("Run", "solver", values.solver, "solver", std::vector<std::string>{"direct", "iterative"});
  file.add("Run", "axis", std::span<double>(values.axis), "axis of the sample");
  file.add("Run", "times", values.times, "times of output [s]", Range::positive());
}

struct Parameters
{
  Values values;
  ParameterFile file{"Test"};
  Parameters() { declare(file, values); }
};

std::string grains(const std::string &lines)
{
  return "subsection Grains\n" + lines + "\nend\n";
}

} // namespace

TEST_CASE("name distance counts insertions, deletions, exchanges and swaps")
{
  CHECK(name_distance("", "abc") == 3);
  CHECK(name_distance("friction", "friction") == 0);
  CHECK(name_distance("frction", "friction") == 1);
  CHECK(name_distance("friciton", "friction") == 1);
  CHECK(name_distance("Fricton", "friction") == 1); // the case does not count
  CHECK(name_distance("kitten", "sitting") == 3);
}

TEST_CASE("name distance is symmetric and obeys its bounds")
{
  const std::vector<std::string> words = {"a", "friction", "fraction", "function", "seed", "Grains/number", "xyz"};
  for (const auto &one : words)
    for (const auto &other : words)
    {
      const int distance = name_distance(one, other);
      CHECK(distance == name_distance(other, one));
      CHECK(distance >= std::abs(static_cast<int>(one.size()) - static_cast<int>(other.size())));
      CHECK(distance <= static_cast<int>(std::max(one.size(), other.size())));
      CHECK((distance == 0) == (one == other));
    }
}

TEST_CASE("nearest name finds a misspelt name and stays silent for a strange one")
{
  const std::vector<std::string> known = {"Grains/friction", "Grains/number", "Run/seed"};
  CHECK(nearest_name("Grains/frction", known) == "Grains/friction");
  CHECK(nearest_name("run/sed", known) == "Run/seed");
  CHECK(nearest_name("Membrane/thickness", known).empty());
  CHECK(did_you_mean("Grains/numbr", known) == "; did you mean 'Grains/number'?");
  CHECK(nearest_name("ab", std::vector<std::string>{"x"}).empty());
}

TEST_CASE("the nearest names come first, three at most")
{
  using Names = std::vector<std::string>;
  const Names known = {"Grains/fraction", "Run/seed", "Grains/frictions", "Grains/friction", "Grains/fiction"};
  CHECK(nearest_names("Grains/friction", known) == Names{"Grains/friction", "Grains/fraction", "Grains/frictions"});
  CHECK(nearest_names("xyz", known).empty());
  CHECK(either_of(Names{"a"}) == "'a'");
  CHECK(either_of(Names{"a", "b", "c"}) == "'a', 'b' or 'c'");
}

TEST_CASE("true and yes are one, false and no the other")
{
  Parameters p;
  for (const bool is_true : {false, true})
    for (const std::string word : is_true ? std::array{"true", "yes"} : std::array{"false", "no"})
    {
      p.values.gravity = !is_true;
      p.file.set("Run/gravity=" + word);
      CHECK(p.values.gravity == is_true);
    }
}

TEST_CASE("a parameter file is read into the variables")
{
  Parameters p;
  p.file.read_text("\xEF\xBB\xBF# comment\r\nsubsection Grains\r\n\tset friction =\t0.25 # note\r\n"
                   "  set law = linear\r\n  subsection Material\r\n set modulus = 1e\\\r\n  9\r\n  end\r\nend\r\n"
                   "SUBSECTION Run\nset axis = 0, 0,1\nset times = 0.1,0.2\nset seed = 18446744073709551615\n"
                   "set gravity = no\nset title = a = b\nEND",
                   "file.prm");
  CHECK(p.values.friction == 0.25);
  CHECK(p.values.law == Law::linear);
  CHECK(p.values.modulus == 1e9);
  CHECK(p.values.axis == std::array<double, 3>{0, 0, 1});
  CHECK(p.values.times == std::vector<double>{0.1, 0.2});
  CHECK(p.values.seed == std::numeric_limits<std::uint64_t>::max());
  CHECK_FALSE(p.values.gravity);
  CHECK(p.values.title == "a = b");
  CHECK(p.values.number == 100);
}

TEST_CASE("an unknown parameter is named with its line and the nearest known one")
{
  Parameters p;
  CHECK_THROWS_MATCHES(
      p.file.read_text("# one\n\n" + grains("set frction = 0.3"), "file.prm"), ConfigError,
      Message("unknown parameter 'Grains/frction' in file.prm line 4; did you mean 'Grains/friction'?"));
  CHECK_THROWS_MATCHES(p.file.read_text(grains("set seed = 3"), "file.prm"), ConfigError,
                       Message("unknown parameter 'Grains/seed' in file.prm line 2; did you mean 'Run/seed'?"));
  CHECK_THROWS_WITH(p.file.read_text("set quite different = 3", "file.prm"), Contains("--print-parameters"));
}

TEST_CASE("an unknown section is named with its line and the nearest known one")
{
  Parameters p;
  CHECK_THROWS_MATCHES(p.file.read_text("subsection Grians\nend", "file.prm"), ConfigError,
                       Message("unknown section 'Grians' in file.prm line 1; did you mean 'Grains'?"));
  CHECK_THROWS_WITH(p.file.read_text(grains("subsection Materials\nend"), "file.prm"),
                    Contains("unknown section 'Grains/Materials' in file.prm line 2") && Contains("'Grains/Material'"));
}

TEST_CASE("values that do not parse or are out of range are refused with what is allowed")
{
  Parameters p;
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"Grains/friction=-1e-300", "'-1e-300' is out of range; allowed: a number >= 0"},
      {"Grains/friction=inf", "'inf' is not a finite number"},
      {"Grains/friction=nan", "'nan' is not a finite number"},
      {"Grains/friction=1e999", "'1e999' is not a finite number"},
      {"Grains/friction=0.5x", "'0.5x' is not a finite number"},
      {"Grains/friction=0,5", "'0,5' is not a finite number"},
      {"Grains/friction=", "'' is not a finite number"},
      {"Grains/friction=+-1", "'+-1' is not a finite number"},
      {"Grains/Material/modulus=0", "'0' is out of range; allowed: a number > 0"},
      {"Grains/number=0", "'0' is out of range; allowed: a whole number >= 1 and <= 1000000"},
      {"Grains/number=1000001", "is out of range"},
      {"Grains/number=3.5", "'3.5' is not a whole number"},
      {"Grains/number=99999999999999999999999", "is not a whole number"},
      {"Run/seed=-1", "'-1' is out of range; allowed: a whole number >= 0"},
      {"Run/gravity=maybe", "'maybe' is neither true nor false"},
      {"Run/axis=1,2", "'1,2' has 2 numbers, not 3"},
      {"Run/axis=1,2,", "'' is not a finite number"},
      {"Run/times=0.1,0", "'0' is out of range"},
      {"Run/solver=direkt", "'direkt' is unknown; did you mean 'direct'? Allowed: one of direct, iterative"},
      {"Run/title=a # b", "holds '#'"},
  };
  for (const auto &[setting, message] : wrong)
  {
    INFO(setting);
    CHECK_THROWS_WITH(p.file.set(setting), Contains(message) && Contains("parameter '") && Contains("--set"));
    CHECK_THROWS_AS(p.file.set(setting), ConfigError);
  }
  CHECK(p.values == Values{});
}

TEST_CASE("every limit of a range is on the right side")
{
  CHECK(Range::between(0, 1).contains(0));
  CHECK(Range::between(0, 1).contains(1));
  CHECK_FALSE(Range::strictly_between(0, 1).contains(0));
  CHECK_FALSE(Range::strictly_between(0, 1).contains(1));
  CHECK(Range::at_most(2).contains(2));
  CHECK_FALSE(Range::below(2).contains(2));
  CHECK_FALSE(Range::any().contains(std::numeric_limits<double>::infinity()));
  CHECK_FALSE(Range::any().contains(std::numeric_limits<double>::quiet_NaN()));
  CHECK(Range::strictly_between(0, 0.5).text() == " > 0 and < 0.5");
}

TEST_CASE("a setting takes a path and everything behind the first equal sign")
{
  Parameters p;
  p.file.set("Grains/friction=0.75");
  p.file.set(" Grains / Material / modulus = +2e9 ");
  p.file.set("Run/title=a = b/c");
  p.file.set("Grains/friction=0.125"); // the last one wins
  CHECK(p.values.friction == 0.125);
  CHECK(p.values.modulus == 2e9);
  CHECK(p.values.title == "a = b/c");
  CHECK_THROWS_WITH(p.file.set("Grains/friction"), Contains("has no '='"));
  CHECK_THROWS_WITH(p.file.set("friction=1"), Contains("did you mean 'Grains/friction'?"));
  CHECK_THROWS_WITH(p.file.set("=1"), Contains("unknown parameter ''"));
}

TEST_CASE("mistakes in the structure of a file are explained")
{
  Parameters p;
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"subsection Grains\n", "line 1: subsection 'Grains' has no 'end'"},
      {"end", "line 1: 'end' without a 'subsection'"},
      {grains("friction = 0.3"), "line 2: 'friction = 0.3' is no statement"},
      {grains("sett friction = 0.3"), "did you mean 'set'?"},
      {grains("set friction 0.3"), "line 2: 'set friction 0.3' has no '='"},
      {grains("set friction = 0.3\nset friction = 0.4"), "is set twice in file.prm, in line 2 and in line 3"},
      {"include other.prm", "'include' is not supported"},
      {"\x7f"
       "ELF\x01",
       "is no statement"},
  };
  for (const auto &[text, message] : wrong)
  {
    INFO(text);
    CHECK_THROWS_WITH(p.file.read_text(text, "file.prm"), Contains(message) && !Contains("Exc"));
    CHECK_THROWS_AS(p.file.read_text(text, "file.prm"), ConfigError);
  }
}

TEST_CASE("the resolved file of what nothing was given reads back as the defaults")
{
  Parameters p, q;
  q.values = {.friction = 1, .number = 7, .title = "x", .times = {4}};
  q.file.read_text(p.file.resolved_text(), "defaults");
  CHECK(q.values == Values{});
}

TEST_CASE("the resolved file reads back as the very same values")
{
  const double third = 1.0 / 3.0;
  const std::vector<double> numbers = {third,
                                       std::nextafter(1.0, 2.0),
                                       5e-324,
                                       std::numeric_limits<double>::max(),
                                       0.1 + 0.2,
                                       123456789.123456789,
                                       2.2250738585072011e-308};
  for (const double number : numbers)
  {
    Parameters p, q;
    p.values = {number, number, 7, 1ull << 63, false, "two  words", "iterative", Law::linear, {-number, 0, third}, {}};
    p.values.times = {number, third};
    TemporaryFolder folder;
    p.file.write_resolved(folder / "parameters.prm");
    q.file.read(folder / "parameters.prm");
    CHECK(q.values == p.values);
    CHECK(q.file.resolved_text() == p.file.resolved_text());
  }
}

TEST_CASE("the parts of a clump are read, written back and refused by what is wrong with them")
{
  using bergamo::dem::ClumpShape;
  ClumpShape clump;
  clump.parts.push_back({{bergamo::Vec3::Ones(), 1., 1.}}); // a default has to be allowed
  ParameterFile file("Test");
  file.add_bound("Grains", "parts", "of a clump", bind_clump(clump));
  file.set("Grains/parts=0 0 0  1 0.8 0.1  0.7 1.2 ;1e-3 -2 3  0.5 0.5 0.5  1 1  0.5 0.5 -0.5 0.5");
  REQUIRE(clump.parts.size() == 2);
  CHECK(clump.parts[0].shape.half_axes == bergamo::Vec3(1, 0.8, 0.1));
  CHECK(clump.parts[0].shape.eps1 == 0.7);
  CHECK(clump.parts[0].shape.eps2 == 1.2);
  CHECK(clump.parts[0].orientation.coeffs() == bergamo::Quaternion::Identity().coeffs());
  CHECK(clump.parts[1].position == bergamo::Vec3(1e-3, -2, 3));
  CHECK(clump.parts[1].orientation.coeffs() == bergamo::Quaternion(0.5, 0.5, -0.5, 0.5).coeffs());

  const std::string text = file.resolved_text();
  clump.parts.clear();
  file.read_text(text, "resolved");
  REQUIRE(clump.parts.size() == 2);
  CHECK(file.resolved_text() == text);

  const auto refused = [&](const std::string &parts, const std::string &why)
  {
    CAPTURE(parts);
    CHECK_THROWS_WITH(file.set("Grains/parts=" + parts), Contains("Grains/parts") && Contains(why));
  };
  refused("0 0 0 1 1 1 1", "7 numbers");
  refused("", "0 numbers");
  refused("0 0 0 1 1 1 1 1 ;", "0 numbers");
  refused("0 0 0 1 1 one 1 1", "'one'");
  refused("0 0 0 1 1 -1 1 1", "half-axis");
  refused("0 0 0 1 1 1 2.5 1", "exponent");
  refused("0 0 0 1 1 1 1 1 0 0 0 0", "quaternion");
  CHECK(clump.parts.size() == 2);
}

TEST_CASE("a parameter file that is not there is named")
{
  Parameters p;
  CHECK_THROWS_WITH(p.file.read("/nowhere/file.prm"), Contains("'/nowhere/file.prm' cannot be read"));
  CHECK_THROWS_AS(p.file.read("/tmp"), ConfigError);
}

TEST_CASE("mistakes of the programmer are found when a parameter is added")
{
  Parameters p;
  double value = -1;
  CHECK_THROWS_AS(p.file.add("Grains", "friction", value, "again"), std::logic_error);
  CHECK_THROWS_AS(p.file.add("Grains", "size", value, "default not allowed", Range::positive()), std::logic_error);
  CHECK_THROWS_AS(p.file.add("", "size", value, "no section"), std::logic_error);
  CHECK_THROWS_AS(p.file.add("Grains", "a/b", value, "a slash"), std::logic_error);
}
