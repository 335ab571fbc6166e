#include "dem/core/error.h"
#include "fe_dealii/material/hypoplastic.h"
#include "fe_dealii/material/matsuoka_nakai.h"
#include "tests/unit/fe_sands.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace bergamo;
using namespace bergamo::fe;
using namespace bergamo::fe::sands;

namespace
{

double sine_of(const HypoplasticParameters &p)
{
  return std::sin(p.critical_friction_angle * std::numbers::pi / 180);
}

/// Principal stresses of a mean pressure at an angle in the deviatoric plane, ‖T̂*‖ = size. At angle 0 the first is the
/// most compressive and the others are equal: triaxial compression; at π/3 extension.
Stress principal_stress(const double pressure, const double size, const double angle)
{
  Stress stress{};
  for (int i = 0; i < 3; ++i)
    stress[i] = -3 * pressure * (1. / 3 + std::sqrt(2. / 3) * size * std::cos(angle - 2 * std::numbers::pi / 3 * i));
  return stress;
}

/// The size at which ‖T̂*‖ = F/a, by bisection.
double critical_size(const HypoplasticParameters &p, const double angle)
{
  double low = 0, high = 0.4;
  for (int halving = 0; halving < 80; ++halving)
  {
    const double size = 0.5 * (low + high);
    Stress deviator = principal_stress(1, size, angle);
    for (int i = 0; i < 3; ++i)
      deviator[i] = deviator[i] / -3 - 1. / 3;
    (size * p.strength_factor() < matsuoka_nakai_factor(deviator) ? low : high) = size;
  }
  return 0.5 * (low + high);
}

} // namespace

TEST_CASE("Hypoplastic sand: figures worked out apart from the program", "[fe]")
{
  // By the equation in Python, 3x3 tensors.
  const SandState state{{-80e3, -140e3, -220e3, 12e3, 20e3, -7e3}, 0.72};
  const Strain strain_rate{3e-3, -1e-3, -6e-3, 2e-3, 1e-3, -4e-3};
  struct Figures
  {
    HypoplasticParameters sand;
    double a;
    Stress rate;
    LimitVoidRatios limits; // at 100 kPa
  };
  const Figures all[] = {{hochstetten(),
                          2.760719078093142,
                          {-21545.68842587256, -47649.30444202051, -78248.28007208336, 7744.230638110212,
                           -1813.4089732866034, -22392.312202635356},
                          {0.48217681213056274, 0.8328508573164264, 0.9205193686128925}},
                         {fine_sand(),
                          3.0618621784789726,
                          {-40389.225004932254, -76674.315557673, -120411.30340059623, 10042.897846986814,
                           487.19794908584134, -25591.671877182816},
                          {0.5594789945181815, 0.8988351059472424, 1.0088965474918028}}};
  for (const Figures &figures : all)
  {
    const HypoplasticSand sand(figures.sand);
    CHECK(figures.sand.strength_factor() == Approx(figures.a).epsilon(1e-14));
    const Stress rate = sand.response(state).rate(strain_rate);
    for (int i = 0; i < 6; ++i)
      CHECK(rate[i] == Approx(figures.rate[i]).margin(1e-8)); // thirteen digits of the largest
    const LimitVoidRatios limits = sand.limit_void_ratios(100e3);
    CHECK(limits.densest == Approx(figures.limits.densest).epsilon(1e-14));
    CHECK(limits.critical == Approx(figures.limits.critical).epsilon(1e-14));
    CHECK(limits.loosest == Approx(figures.limits.loosest).epsilon(1e-14));
  }
}

TEST_CASE("Hypoplastic sand: the rate is that of the tensor equation, homogeneous, and turns with its state", "[fe]")
{
  Random random;
  double equation = 0, homogeneity = 0, rotation = 0, bound = 0, lipschitz = 0;
  for (const HypoplasticParameters &parameters : {hochstetten(), fine_sand()})
  {
    const HypoplasticSand sand(parameters);
    for (int trial = 0; trial < 20000; ++trial)
    {
      const SandState state = random.state(sand);
      const Tensor d = random.symmetric(), other = random.symmetric();
      const Strain strain_rate = strain_components(d);
      const HypoplasticResponse response = sand.response(state);
      const Stress rate = response.rate(strain_rate);
      const double size = response.greatest_modulus() * strain_norm(strain_rate);
      const Stress expected = components(reference_rate(parameters, tensor(state.stress), state.void_ratio, d));
      equation = std::max(equation, stress_norm(difference(rate, expected)) / size);

      const double factor = std::pow(10., 16 * random.unit() - 8);
      Strain faster;
      Stress faster_rate;
      for (int i = 0; i < 6; ++i)
        faster[i] = factor * strain_rate[i];
      faster_rate = response.rate(faster);
      for (double &component : faster_rate)
        component /= factor;
      homogeneity = std::max(homogeneity, stress_norm(difference(rate, faster_rate)) / size);

      const Tensor axes = random.rotation();
      const SandState turned{components(Random::turned(axes, tensor(state.stress))), state.void_ratio};
      const Stress turned_rate = sand.response(turned).rate(strain_components(Random::turned(axes, d)));
      rotation = std::max(rotation,
                          stress_norm(difference(turned_rate, components(Random::turned(axes, tensor(rate))))) / size);

      bound = std::max(bound, stress_norm(rate) / size);
      Strain between = strain_components(other);
      const Stress other_rate = response.rate(between);
      for (int i = 0; i < 6; ++i)
        between[i] -= strain_rate[i];
      lipschitz = std::max(lipschitz, stress_norm(difference(other_rate, rate)) /
                                          (response.greatest_modulus() * strain_norm(between)));
    }
  }
  // Rounding of some hundred operations, among them a quotient by ‖T̂*‖³ in the reference.
  CHECK(equation < 1e-12);
  CHECK(homogeneity < 10 * epsilon);
  CHECK(rotation < 1e-12);
  CHECK(bound <= 1);
  CHECK(lipschitz <= 1);
  CHECK(bound > 0.7); // and not needlessly large
}

TEST_CASE("Hypoplastic sand: in the critical state stress and volume both stay, on the surface of Matsuoka and Nakai",
          "[fe]")
{
  for (const HypoplasticParameters &parameters : {hochstetten(), fine_sand()})
  {
    const HypoplasticSand sand(parameters);
    const double sine = sine_of(parameters);
    for (int step = 0; step <= 24; ++step)
    {
      const double angle = step * std::numbers::pi / 12, size = critical_size(parameters, angle);
      for (const double pressure : {1e3, 1e5, 1e7})
      {
        const Stress stress = principal_stress(pressure, size, angle);
        const double i1 = -(stress[0] + stress[1] + stress[2]),
                     i2 = stress[0] * stress[1] + stress[1] * stress[2] + stress[2] * stress[0],
                     i3 = -stress[0] * stress[1] * stress[2];
        REQUIRE(i1 * i2 / i3 == Approx((9 - sine * sine) / (1 - sine * sine)).epsilon(1e-12));

        const HypoplasticResponse response = sand.response({stress, sand.limit_void_ratios(pressure).critical});
        Strain flow{}; // along −T̂*, without change of volume
        for (int i = 0; i < 3; ++i)
          flow[i] = (stress[i] + pressure) / (3 * pressure * size);
        REQUIRE(std::abs(flow[0] + flow[1] + flow[2]) < 1e-14);
        REQUIRE(strain_norm(flow) == Approx(1).epsilon(1e-14));
        REQUIRE(stress_norm(response.rate(flow)) < 1e-13 * response.greatest_modulus());
        // Denser sand dilates against the pressure there, looser sand gives way.
        const double e = sand.limit_void_ratios(pressure).critical;
        REQUIRE(mean_stress(sand.response({stress, 0.95 * e}).rate(flow)) < 0);
        REQUIRE(mean_stress(sand.response({stress, 1.05 * e}).rate(flow)) > 0);
      }
    }
    // The ratio of the extreme principal stresses in triaxial compression and extension.
    const double ratio = (1 + sine) / (1 - sine);
    const Stress compression = principal_stress(1, critical_size(parameters, 0), 0);
    CHECK(compression[0] / compression[1] == Approx(ratio).epsilon(1e-13));
    CHECK(compression[1] == Approx(compression[2]).epsilon(1e-13));
    const Stress extension = principal_stress(1, critical_size(parameters, std::numbers::pi / 3), std::numbers::pi / 3);
    CHECK(extension[0] / extension[2] == Approx(ratio).epsilon(1e-13));
    CHECK(extension[0] == Approx(extension[1]).epsilon(1e-13));
  }
}

TEST_CASE("Matsuoka-Nakai factor: one on the axis and in triaxial compression, 1 - tan(psi)/sqrt 2 in extension",
          "[fe]")
{
  CHECK(matsuoka_nakai_factor({}) == 1);
  for (const double size : {1e-12, 1e-6, 0.1, 0.3, 0.4})
  {
    Stress deviator = principal_stress(1, size, 0);
    for (int i = 0; i < 3; ++i)
      deviator[i] = deviator[i] / -3 - 1. / 3;
    CHECK(matsuoka_nakai_factor(deviator) == Approx(1).epsilon(1e-13));
    for (double &component : deviator)
      component = -component;
    CHECK(matsuoka_nakai_factor(deviator) == Approx(1 - size * std::sqrt(1.5)).epsilon(1e-13));
  }
  CHECK(std::isfinite(matsuoka_nakai_factor({2. / 3, -1. / 3, -1. / 3, 0, 0, 0}))); // the edge of compression
  CHECK(std::isfinite(matsuoka_nakai_factor({20, -10, -10, 3, 0, 0})));
}

TEST_CASE("Hypoplastic sand: the loosest state is compressed by Bauer's law, a denser one is stiffer", "[fe]")
{
  for (const HypoplasticParameters &parameters : {hochstetten(), fine_sand()})
  {
    const HypoplasticSand sand(parameters);
    const double n = parameters.compression_exponent, hardness = parameters.granulate_hardness;
    for (const double pressure : {1e3, 1e4, 1e5, 1e6, 1e7, 1e8})
    {
      const Stress stress{-pressure, -pressure, -pressure, 0, 0, 0};
      const LimitVoidRatios limits = sand.limit_void_ratios(pressure);
      const double e = limits.loosest;
      CHECK(e == Approx(parameters.loosest_void_ratio * std::exp(-std::pow(3 * pressure / hardness, n))));
      const Strain compression{-1, -1, -1, 0, 0, 0};
      const Stress rate = sand.response({stress, e}).rate(compression);
      // ė = (1 + e) tr D = −e n/h_s (3p/h_s)^(n−1) d(3p)/dt
      const double expected = hardness / n * (1 + e) / e * std::pow(3 * pressure / hardness, 1 - n);
      CHECK(-rate[0] == Approx(expected).epsilon(1e-13));
      CHECK(rate[1] == rate[0]);
      CHECK(std::abs(rate[3]) + std::abs(rate[4]) + std::abs(rate[5]) == 0);
      double softer = -rate[0];
      for (const double share : {0.8, 0.5, 0.1})
      {
        const double denser = limits.densest + share * (e - limits.densest);
        const double stiffness = -sand.response({stress, denser}).rate(compression)[0];
        CHECK(stiffness > softer);
        softer = stiffness;
      }
      // Unloading is stiffer than loading.
      CHECK(sand.response({stress, e}).rate({1, 1, 1, 0, 0, 0})[0] > -rate[0]);
    }
  }
}

TEST_CASE("Hypoplastic sand: the limits of pressure and void ratio are those stated", "[fe]")
{
  HypoplasticParameters parameters = hochstetten();
  parameters.least_pressure = 500;
  const HypoplasticSand sand(parameters);
  const Strain strain_rate{3e-3, -1e-3, -6e-3, 2e-3, 1e-3, -4e-3};
  const Stress at_least{-550, -500, -450, 20, 10, -30};
  const Stress expected = sand.response({at_least, 0.8}).rate(strain_rate);
  for (const double pressure : {499., 100., 1e-6, 0., -300.})
  {
    Stress stress = at_least;
    for (int i = 0; i < 3; ++i)
      stress[i] += 500 - pressure;
    const Stress rate = sand.response({stress, 0.8}).rate(strain_rate);
    for (int i = 0; i < 6; ++i)
      CHECK(rate[i] == Approx(expected[i]).epsilon(1e-11));
  }
  const Stress stress{-1e5, -2e5, -1.5e5, 1e4, 0, 2e4};
  const LimitVoidRatios limits = sand.limit_void_ratios(1.5e5);
  CHECK(sand.response({stress, 0.5 * limits.densest}).rate(strain_rate) ==
        sand.response({stress, limits.densest}).rate(strain_rate));
  CHECK(stress_norm(sand.response({stress, limits.densest}).flow) <
        0.01 * sand.response({stress, 0.8}).greatest_modulus());
  CHECK(sand.response({stress, 3.}).rate(strain_rate) == sand.response({stress, limits.loosest}).rate(strain_rate));
}

TEST_CASE("Tension is cut off by principal stresses, and compression stays as it is", "[fe]")
{
  Random random;
  for (int trial = 0; trial < 2000; ++trial)
  {
    Tensor value{};
    for (int i = 0; i < 3; ++i)
      value[i][i] = random.normal() - (trial % 3);
    const Tensor axes = random.rotation();
    const Stress before = components(Random::turned(axes, value));
    Stress after = before;
    const bool had_tension = value[0][0] > 0 || value[1][1] > 0 || value[2][2] > 0;
    REQUIRE(cut_tension(after) == had_tension);
    for (int i = 0; i < 3; ++i)
      value[i][i] = std::min(value[i][i], 0.);
    REQUIRE(stress_norm(difference(after, components(Random::turned(axes, value)))) < 1e-14 * stress_norm(before));
    if (!had_tension)
      REQUIRE(after == before);
  }
}

TEST_CASE("Hypoplastic sand: each bad parameter is refused by name", "[fe]")
{
  struct Bad
  {
    double HypoplasticParameters::*member;
    double value;
    const char *name;
  };
  using P = HypoplasticParameters;
  const Bad all[] = {{&P::critical_friction_angle, 0, "critical_friction_angle"},
                     {&P::critical_friction_angle, 90, "critical_friction_angle"},
                     {&P::granulate_hardness, -1, "granulate_hardness"},
                     {&P::compression_exponent, 1, "compression_exponent"},
                     {&P::compression_exponent, 0, "compression_exponent"},
                     {&P::densest_void_ratio, 0, "densest_void_ratio"},
                     {&P::critical_void_ratio, 0.55, "critical_void_ratio"},
                     {&P::loosest_void_ratio, 0.9, "loosest_void_ratio"},
                     {&P::pyknotropy_exponent, -0.1, "pyknotropy_exponent"},
                     {&P::pyknotropy_exponent, 4, "pyknotropy_exponent"}, // the loosest would soften in compression
                     {&P::stiffness_exponent, -1, "stiffness_exponent"},
                     {&P::initial_void_ratio, 0, "initial_void_ratio"},
                     {&P::density, 0, "density"},
                     {&P::least_pressure, 0, "least_pressure"}};
  for (const Bad &bad : all)
    for (const double value : {bad.value, double(NAN)})
    {
      HypoplasticParameters parameters = hochstetten();
      parameters.*bad.member = value;
      CHECK_THROWS_WITH(HypoplasticSand(parameters), Catch::Contains("hypoplastic sand") && Catch::Contains(bad.name));
    }
  CHECK_NOTHROW(HypoplasticSand(hochstetten()));
  CHECK_NOTHROW(HypoplasticSand(fine_sand()));
}
