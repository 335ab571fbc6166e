#include "dem/core/error.h"
#include "dem/measure/beverloo.h"
#include "dem/measure/mass_flow.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace bergamo;
using namespace bergamo::dem;
using Catch::Matchers::Contains;

TEST_CASE("a steady flow is the slope of its mass, without a deviation")
{
  std::vector<double> times, masses;
  for (int k = 0; k <= 20; ++k)
  {
    times.push_back(0.1 * k);
    masses.push_back(k < 3 ? 0. : 5. * (0.1 * k - 0.3)); // begins late
  }
  const MassFlow flow = mass_flow(times, masses, {1., 6.}, 4);
  CHECK(flow.begin == Approx(0.5).epsilon(1e-13));
  CHECK(flow.end == Approx(1.5).epsilon(1e-13));
  CHECK(flow.mean == Approx(5.).epsilon(1e-13));
  CHECK(flow.deviation < 1e-12);
  CHECK(flow.windows.size() == 4);
}

TEST_CASE("windows deviate from the mean as their flows do")
{
  const std::vector<double> times{0., 1., 2., 3., 4.}, masses{0., 1., 4., 5., 8.};
  const MassFlow flow = mass_flow(times, masses, {0., 8.}, 4);
  CHECK(flow.mean == Approx(2.));
  REQUIRE(flow.windows.size() == 4);
  CHECK(flow.windows[0] == Approx(1.));
  CHECK(flow.windows[3] == Approx(3.));
  CHECK(flow.deviation == Approx(std::sqrt(4. / 3.)));
}

TEST_CASE("a flow that does not come so far ends with its last sample")
{
  const std::vector<double> times{0., 1., 2.}, masses{0., 2., 3.};
  const MassFlow flow = mass_flow(times, masses, {1., 100.}, 2);
  CHECK(flow.begin == Approx(0.5));
  CHECK(flow.end == 2.);
  CHECK(flow.mean == Approx(2. / 1.5));
  CHECK(mass_flow(times, masses, {50., 100.}, 2).mean == 0.);
  CHECK(mass_flow({}, {}, {0., 1.}, 2).windows.empty());
}

TEST_CASE("samples that are no flow are refused")
{
  const std::vector<double> times{0., 1.}, masses{0., 1.}, one{0.}, equal{0., 0.}, falling{1., 0.};
  CHECK_THROWS_WITH(mass_flow(times, one, {0., 1.}, 2), Contains("number of masses"));
  CHECK_THROWS_WITH(mass_flow(equal, masses, {0., 1.}, 2), Contains("later than"));
  CHECK_THROWS_WITH(mass_flow(times, falling, {0., 1.}, 2), Contains("no less than"));
  CHECK_THROWS_WITH(mass_flow(times, masses, {0., 1.}, 0), Contains("number of windows"));
}

TEST_CASE("Beverloo's law has its powers and scales")
{
  // C rho sqrt(g) (D - k d)^(5/2) and C rho sqrt(g) L (W - k d)^(3/2), computed by hand.
  const BeverlooScale circle{1500., 9., 2e-3, 0.}, slot{1500., 9., 2e-3, 0.03};
  const BeverlooLaw law{0.6, 1.5};
  CHECK(law.flow(0.012, circle) == Approx(0.6 * 1500. * 3. * std::pow(0.009, 2.5)).epsilon(1e-14));
  CHECK(law.flow(0.012, slot) == Approx(0.6 * 1500. * 3. * 0.03 * std::pow(0.009, 1.5)).epsilon(1e-14));
  CHECK(law.flow(0.003, slot) == 0.);
  CHECK(law.flow(0.001, circle) == 0.);
}

TEST_CASE("flows of Beverloo's law give its constants back")
{
  const std::vector<double> widths{0.012, 0.016, 0.02, 0.03};
  for (const BeverlooScale &scale : {BeverlooScale{1500., 9.81, 3e-3, 0.025}, BeverlooScale{1500., 9.81, 3e-3, 0.}})
  {
    const BeverlooLaw law{0.9, 1.3};
    std::vector<double> flows;
    for (const double width : widths)
      flows.push_back(law.flow(width, scale));
    const BeverlooLaw fitted = fit_beverloo(widths, flows, scale);
    CHECK(fitted.c == Approx(0.9).epsilon(1e-11));
    CHECK(fitted.k == Approx(1.3).epsilon(1e-11));
  }
}

TEST_CASE("flows that are none of Beverloo's are refused")
{
  const BeverlooScale scale{1500., 9.81, 3e-3, 0.025};
  const auto fit = [&](const std::vector<double> &widths, const std::vector<double> &flows)
  { return fit_beverloo(widths, flows, scale); };
  CHECK_THROWS_WITH(fit({0.01, 0.02}, {1.}), Contains("number of flows"));
  CHECK_THROWS_WITH(fit({0.01, 0.02}, {1., 0.}), Contains("positive [kg/s]"));
  CHECK_THROWS_WITH(fit({0.01, 0.01}, {1., 1.}), Contains("two widths"));
  CHECK_THROWS_WITH(fit({0.01, 0.02}, {2., 1.}), Contains("growth of the flow"));
}
