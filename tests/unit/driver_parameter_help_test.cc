#include "dem/core/error.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/parameter_help.h"

#include <catch2/catch.hpp>

#include <sstream>

using namespace bergamo::driver;
using bergamo::ConfigError;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace
{

struct Parameters
{
  double friction = 0.5, modulus = 7e10, growth = 1.1;
  std::string title, law = "hertz";
  ParameterFile file{"Test"};

  Parameters()
  {
    file.add("Grains", "friction", friction, "Coulomb's coefficient between grains", Range::non_negative());
    file.add("Grains/Material", "modulus", modulus, "Young's modulus of the mineral [Pa]",
             Range::positive().usual(1e9, 1e12));
    file.add("Walls", "friction", friction, "of grains and walls");
    file.add("Walls", "law", law, "of the contacts", std::vector<std::string>{"hertz", "linear"});
    file.add("Run", "title", title, "of the diagrams; indexed by [n]: brackets within are no unit");
    file.add("Run", "growth", growth,
             "of the time between two pictures, from one to the next, over the whole of a run that may be long and "
             "needs more than a line to be told");
  }
  std::string explain(const std::string &topic) const { return explained(file.entries(), topic); }
};

} // namespace

TEST_CASE("a parameter is explained by its meaning, unit, range and default")
{
  Parameters p;
  CHECK(p.explain("Grains/Material/modulus") == "Grains/Material/modulus\n"
                                                "  Young's modulus of the mineral\n"
                                                "  unit       Pa\n"
                                                "  allowed    a number > 0\n"
                                                "  usual      1e+09 to 1e+12 Pa\n"
                                                "  default    7e+10 Pa\n");
  CHECK_THAT(p.explain(" Walls / law "), Contains("one of hertz, linear") && !Contains("unit") && !Contains("usual"));
  CHECK_THAT(p.explain("Run/title"), Contains("brackets within are no unit") && Contains("default    (empty)"));
}

TEST_CASE("the value in force comes with the place where it was set, the last one that counts")
{
  Parameters p;
  CHECK_THAT(p.explain("Grains/friction"), !Contains("in force"));
  p.file.read_text("subsection Grains\n\n  set friction = 0.25\nend\n", "sand.prm");
  CHECK_THAT(p.explain("Grains/friction"),
             Contains("default    0.5\n") && Contains("in force   0.25, set by sand.prm line 3\n"));
  p.file.read_text("subsection Grains\n  set friction = 0.3\nend\n", "loose.prm");
  CHECK_THAT(p.explain("Grains/friction"), Contains("0.3, set by loose.prm line 2"));
  p.file.set("Grains/friction=0.5"); // the default, but on purpose
  CHECK_THAT(p.explain("Grains/friction"), Contains("in force   0.5, set by --set \"Grains/friction=0.5\""));
}

TEST_CASE("a section is explained with all in it, a name alone wherever it stands")
{
  Parameters p;
  const std::string section = p.explain("Grains");
  CHECK_THAT(section,
             StartsWith("Grains/friction\n") && Contains("\n\nGrains/Material/modulus\n") && !Contains("Walls"));
  CHECK_THAT(p.explain("Grains/Material"), StartsWith("Grains/Material/modulus") && !Contains("friction"));
  CHECK_THAT(p.explain("friction"), StartsWith("Grains/friction\n") && Contains("\n\nWalls/friction\n"));
}

TEST_CASE("no line of an explanation is longer than a terminal")
{
  Parameters p;
  std::istringstream stream(p.explain("Run/growth"));
  int n_lines = 0;
  for (std::string line; std::getline(stream, line); ++n_lines)
    CHECK(line.size() <= 80);
  CHECK(n_lines == 5);
}

TEST_CASE("a misspelt name is refused with the nearest ones")
{
  Parameters p;
  CHECK_THROWS_AS(p.explain("Grains/frction"), ConfigError);
  CHECK_THROWS_WITH(p.explain("Grains/frction"),
                    Contains("--help Grains/frction") && Contains("did you mean 'Grains/friction'"));
  CHECK_THROWS_WITH(p.explain("Grians"), Contains("did you mean 'Grains'?"));
  CHECK_THROWS_WITH(p.explain("Run/friction"), Contains("'Grains/friction' or 'Walls/friction'")); // wrong section
  CHECK_THROWS_WITH(p.explain("frction"), Contains("'Grains/friction'") && Contains("'Walls/friction'"));
  CHECK_THROWS_WITH(p.explain("quite different"), Contains("--print-parameters"));
  CHECK_THROWS_WITH(p.explain("/"), Contains("--print-parameters"));
}
