#include "drivers/common/parameter_advice.h"
#include "drivers/common/parameter_file.h"

#include <catch2/catch.hpp>

using namespace bergamo::driver;
using Catch::Matchers::Contains;

namespace
{

struct Parameters
{
  double modulus = 5e10, size = 1e-3, density = 2650, angle = 30, friction = 0.5, damping = 0.3, strain = 0.02,
         pressure = 1e5, free = 1;
  std::vector<double> sizes{1e-3, 2e-3};
  ParameterFile file{"Test"};

  Parameters()
  {
    file.add("Grains", "modulus", modulus, "of the mineral [Pa]", Range::positive().usual(1e9, 1e12));
    file.add("Grains", "size", size, "[m]", Range::positive().usual(1e-6, 0.1));
    file.add("Grains", "sizes", sizes, "[m]", Range::positive().usual(1e-6, 0.1));
    file.add("Grains", "density", density, "[kg/m3]", Range::positive().usual(500, 2e4));
    file.add("Grains", "friction", friction, "of Coulomb", Range::non_negative().usual(0, 2));
    file.add("Grains", "damping", damping, "share of the critical", Range::between(0, 10).usual(0, 1));
    file.add("Ground", "angle", angle, "of friction [degree]", Range::between(0, 90).usual(5, 60));
    file.add("Ground", "strain", strain, "axial", Range::any().usual(-0.5, 0.5));
    file.add("Ground", "pressure", pressure, "[Pa]", Range::positive().usual(1e4, 1e8));
    file.add("Ground", "free", free, "of advice");
  }
  std::vector<std::string> after(const std::string &setting)
  {
    file.set(setting);
    return unusual_values(file.entries());
  }
};

} // namespace

TEST_CASE("usual values get no warning, nor do the limits of what is usual")
{
  for (const std::string setting : {"Grains/modulus=1e9", "Grains/modulus=1e12", "Grains/size=1e-6",
                                    "Grains/sizes=1e-6, 0.1", "Grains/damping=1", "Ground/free=1e300"})
    CHECK(Parameters().after(setting).empty());
}

TEST_CASE("a value in another unit is told with what was meant")
{
  const std::vector<std::pair<std::string, std::string>> slips = {
      {"Grains/modulus=50", "did you mean 5e+10 Pa (50 GPa)?"},
      {"Grains/modulus=70000", "did you mean 7e+10 Pa (70000 MPa)?"},
      {"Grains/size=1", "did you mean 0.001 m (1 mm) or 1e-06 m (1 µm)?"},
      {"Grains/sizes=1e-3, 0.002, 500", "500 m"},
      {"Grains/density=2.65", "did you mean 2650 kg/m3 (2.65 g/cm3)?"},
      {"Grains/density=26.5", "did you mean 2701.33 kg/m3 (26.5 kN/m3)?"},
      {"Grains/friction=30", "did you mean 0.57735 (30 degrees of a friction angle)?"},
      {"Grains/damping=5", "did you mean 0.05 (5 %)?"},
      {"Ground/angle=0.5", "did you mean 28.6479 degree (0.5 radian)?"},
      {"Ground/strain=-2", "did you mean -0.02 (-2 %)?"},
      {"Ground/pressure=100", "did you mean 100000 Pa (100 kPa) or 1e+08 Pa (100 MPa)?"},
  };
  for (const auto &[setting, meant] : slips)
  {
    INFO(setting);
    const std::vector<std::string> warnings = Parameters().after(setting);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Contains(meant) && Contains("is usual"));
  }
}

TEST_CASE("a warning names the parameter, its value, where it was set and what is usual")
{
  Parameters p;
  p.file.read_text("subsection Grains\n  set modulus = 50\nend\n", "sand.prm");
  const std::vector<std::string> warnings = unusual_values(p.file.entries());
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] == "Grains/modulus is 50 Pa (sand.prm line 2), where 1e+09 to 1e+12 Pa is usual; did "
                       "you mean 5e+10 Pa (50 GPa)?");
  CHECK_THAT(p.after("Grains/size=1e7")[1], Contains("check the value and its unit")); // nothing near in any unit
}

TEST_CASE("0 turns off what a parameter is of, and what nobody has set is not looked at")
{
  CHECK(Parameters().after("Ground/angle=0").empty());
  Parameters p;
  p.modulus = 1;
  CHECK(unusual_values(p.file.entries()).empty());
}
