#include "dem/core/error.h"
#include "drivers/common/continuum_parameters.h"

#include <catch2/catch.hpp>

#include <string>
#include <variant>

using namespace bergamo::driver;
using bergamo::ConfigError;
using Catch::Matchers::Contains;

namespace
{

ContinuumParameters read(const std::string &text)
{
  ContinuumParameters continuum;
  ParameterFile file("continuum");
  continuum.declare(file);
  file.read_text(text, "text");
  return continuum;
}

} // namespace

TEST_CASE("a continuum is Mohr and Coulomb's unless the file names sand", "[driver]")
{
  const ContinuumParameters soil = read("subsection Continuum\n set friction angle = 31\n set density = 1700\nend\n");
  CHECK_FALSE(soil.is_sand());
  const auto material = soil.material();
  REQUIRE(std::holds_alternative<bergamo::fe::MohrCoulomb>(material));
  CHECK(std::get<bergamo::fe::MohrCoulomb>(material).parameters().friction_angle == 31);
  CHECK(bergamo::fe::density(material) == 1700);
}

TEST_CASE("a continuum of sand has the parameters of its section and the density of the bulk", "[driver]")
{
  const ContinuumParameters soil = read("subsection Continuum\n"
                                        "  set law = hypoplastic sand\n"
                                        "  set density = 1555\n"
                                        "  subsection Sand\n"
                                        "    set critical friction angle = 30\n"
                                        "    set granulate hardness = 2.6e9\n"
                                        "    set compression exponent = 0.27\n"
                                        "    set densest void ratio = 0.61\n"
                                        "    set critical void ratio = 0.98\n"
                                        "    set loosest void ratio = 1.10\n"
                                        "    set pyknotropy exponent = 0.18\n"
                                        "    set stiffness exponent = 1.1\n"
                                        "    set void ratio = 0.72\n"
                                        "    set least pressure = 250\n"
                                        "  end\n"
                                        "end\n");
  soil.validate();
  const auto material = soil.material();
  REQUIRE(std::holds_alternative<bergamo::fe::HypoplasticSand>(material));
  const bergamo::fe::HypoplasticParameters &sand = std::get<bergamo::fe::HypoplasticSand>(material).parameters();
  CHECK(bergamo::fe::density(material) == 1555);
  CHECK(sand.critical_friction_angle == 30);
  CHECK(sand.granulate_hardness == 2.6e9);
  CHECK(sand.compression_exponent == 0.27);
  CHECK(sand.densest_void_ratio == 0.61);
  CHECK(sand.critical_void_ratio == 0.98);
  CHECK(sand.loosest_void_ratio == 1.10);
  CHECK(sand.pyknotropy_exponent == 0.18);
  CHECK(sand.stiffness_exponent == 1.1);
  CHECK(sand.initial_void_ratio == 0.72);
  CHECK(sand.least_pressure == 250);

  CHECK_NOTHROW(soil.require_pressure(250, "the ground has", "raise it"));
  CHECK_THROWS_WITH(soil.require_pressure(249, "the ground has", "raise Ground/surcharge"),
                    Contains("Continuum/Sand/least pressure is 250") && Contains("the ground has") && Contains("249") &&
                        Contains("raise Ground/surcharge"));
}

TEST_CASE("a continuum refuses what its own law does not allow, and no more", "[driver]")
{
  const std::string mistakes = "  set friction angle = 20\n  set dilation angle = 30\n"
                               "  subsection Sand\n    set critical void ratio = 0.4\n  end\nend\n";
  CHECK_THROWS_WITH(read("subsection Continuum\n" + mistakes).validate(), Contains("dilation"));
  CHECK_THROWS_WITH(read("subsection Continuum\n  set law = hypoplastic sand\n" + mistakes).validate(),
                    Contains("critical_void_ratio"));
  CHECK_NOTHROW(read("").require_pressure(0, "the ground has", "raise it"));
  CHECK_THROWS_AS(read("subsection Continuum\n  set law = sand\nend\n"), ConfigError);
}
