#include "dem/core/error.h"
#include "drivers/two_scale_triaxial/layout.h"

#include <catch2/catch.hpp>

using namespace bergamo;
using namespace bergamo::driver;
using Catch::Matchers::Contains;

namespace
{

ElementLayers layers_of(const unsigned int continuum, const unsigned int overlap, const unsigned int high)
{
  return {.per_edge = 5, .continuum = continuum, .overlap = overlap, .per_height = high};
}

} // namespace

TEST_CASE("a layer of continuum between grains has an overlap at either face")
{
  const dem::Box cell{Vec3(0., 0., 1.), Vec3(1., 1., 3.)};
  const Layout layout = Interlayer(layers_of(6, 2, 10), cell); // layers of 0.2, continuum from 1.4 to 2.6
  for (const double up : {-1., 1.})
  {
    const auto at = [&](const double from_middle) { return Vec3(0.3, 0.7, 2. + up * from_middle); };
    const auto weight = [&](const double from_middle)
    { return weight_at(layout, at(from_middle), coupling::WeightShape::linear); };
    CHECK(weight(0.) == 0.);
    CHECK(weight(0.2) == 0.);
    CHECK(weight(0.3) == Approx(0.25));
    CHECK(weight(0.5) == Approx(0.75));
    CHECK(weight(0.6) == 1.);
    CHECK(weight(0.9) == 1.);
    CHECK_FALSE(has_grain(layout, at(0.19)));
    CHECK(has_grain(layout, at(0.21)));
    CHECK_FALSE(is_of_grains_alone(layout, at(0.59)));
    CHECK(is_of_grains_alone(layout, at(0.61)));
  }
}

TEST_CASE("a layer of continuum that leaves no room, or lies across layers, is refused")
{
  CHECK_NOTHROW(require_interlayer(layers_of(6, 2, 10)));
  CHECK_NOTHROW(require_interlayer(layers_of(3, 1, 0)));
  CHECK_THROWS_WITH(require_interlayer(layers_of(10, 2, 10)), Contains("continuum layers"));
  CHECK_THROWS_WITH(require_interlayer(layers_of(6, 3, 10)), Contains("overlap layers"));
  CHECK_THROWS_WITH(require_interlayer(layers_of(5, 2, 10)), Contains("both even or both odd"));
}
