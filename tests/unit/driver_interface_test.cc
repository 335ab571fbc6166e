#include "dem/core/error.h"
#include "drivers/two_scale_triaxial/interface.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace bergamo;
using namespace bergamo::driver;

namespace
{

constexpr ElementLayers layers{10, 6, 2};
const dem::Box cube{Vec3::Constant(1.), Vec3::Constant(2.)};
const auto all_shapes = {InterfaceShape::flat, InterfaceShape::inclined, InterfaceShape::stepped,
                         InterfaceShape::curved};

double weight(const Interface &interface, const double x, const double z)
{
  return interface.weight_at({x, 1.5, z}, coupling::WeightShape::linear);
}

} // namespace

TEST_CASE("an interface lies where its shape says")
{
  const auto heights = [](const InterfaceShape shape, const double share)
  {
    const Interface interface(shape, layers, cube);
    return std::pair(interface.bottom(1. + share) - 1., interface.top(1. + share) - 1.);
  };
  for (const double share : {0., 0.3, 1.})
  {
    CHECK(heights(InterfaceShape::flat, share).first == Approx(0.4));
    CHECK(heights(InterfaceShape::flat, share).second == Approx(0.6));
    CHECK(heights(InterfaceShape::inclined, share).second == Approx(0.6 * (0.8 + 0.4 * share)));
  }
  CHECK(heights(InterfaceShape::curved, 0.).first == Approx(0.8 * 0.4));
  CHECK(heights(InterfaceShape::curved, 0.5).second == Approx(1.2 * 0.6));
  // straight from column to column
  const double beside_crest = 1. - 0.2 * std::cos(0.8 * 3.14159265358979);
  CHECK(heights(InterfaceShape::curved, 0.45).second == Approx(0.5 * (1.2 + beside_crest) * 0.6));
  CHECK(heights(InterfaceShape::stepped, 0.49).second == Approx(0.6));
  CHECK(heights(InterfaceShape::stepped, 0.51).second == Approx(0.5));
  CHECK(heights(InterfaceShape::stepped, 0.51).first == Approx(0.3));
}

TEST_CASE("grains weigh nothing below an overlap, wholly above it, and in between without a jump")
{
  for (const InterfaceShape shape : all_shapes)
  {
    CAPTURE(static_cast<int>(shape));
    const Interface interface(shape, layers, cube);
    // at a step the thickness is that of the layer left, elsewhere 0.8 of the flat one at least
    const double step = 1e-3, least_thickness = shape == InterfaceShape::stepped ? 0.1 : 0.8 * 0.2;
    for (double x = 1.; x < 2.; x += step)
    {
      REQUIRE(weight(interface, x, interface.bottom(x)) == Approx(0.).margin(1e-12));
      REQUIRE(weight(interface, x, interface.bottom(x) - 0.05) == 0.);
      REQUIRE(weight(interface, x, interface.top(x)) == Approx(1.));
      REQUIRE(weight(interface, x, interface.top(x) + 0.05) == 1.);
      for (double z = 1.; z < 2.; z += 0.03)
        // faces rise by 0.2 2 pi 0.6 at most, distances grow by the way
        REQUIRE(std::abs(weight(interface, x + step, z) - weight(interface, x, z)) <= 1.3 * step / least_thickness);
    }
  }
  const Interface flat(InterfaceShape::flat, layers, cube);
  CHECK(weight(flat, 1.2, 1.45) == Approx(0.25));
  // Beside the step, at 1.5, grains alone are nearest at its foot and the continuum alone below.
  const Interface stepped(InterfaceShape::stepped, layers, cube);
  CHECK(weight(stepped, 1.5, 1.5) == 1.);
  CHECK(weight(stepped, 1.42, 1.46) == Approx(0.06 / (0.06 + std::hypot(0.08, 0.04))));
}

TEST_CASE("an interface leaves both models a layer to themselves")
{
  using Catch::Matchers::Contains;
  CHECK_NOTHROW(layers.validate(InterfaceShape::stepped));
  CHECK_THROWS_WITH((ElementLayers{5, 5, 1}.validate(InterfaceShape::flat)), Contains("continuum layers"));
  CHECK_THROWS_WITH((ElementLayers{5, 3, 3}.validate(InterfaceShape::flat)), Contains("overlap layers"));
  CHECK_NOTHROW((ElementLayers{5, 3, 2}.validate(InterfaceShape::flat)));
  CHECK_THROWS_WITH((ElementLayers{5, 3, 2}.validate(InterfaceShape::stepped)), Contains("behind the step"));
  CHECK_THROWS_WITH((ElementLayers{5, 3, 1}.validate(InterfaceShape::stepped)), Contains("at least 2"));
  CHECK_THROWS_WITH((ElementLayers{7, 6, 2}.validate(InterfaceShape::curved)), Contains("highest"));
}
