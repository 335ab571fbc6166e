// Statistics over samples, choice of the cohesion, what the continuum may have, mean curves.
#include "dem/core/error.h"
#include "drivers/fit_mohr_coulomb/ensemble_fit.h"
#include "drivers/fit_mohr_coulomb/mean_curve.h"
#include "tests/unit/fit_synthetic.h"

#include <catch2/catch.hpp>

using namespace bergamo::driver;
using Catch::Matchers::Contains;

namespace
{

/// Two samples under each of two pressures; friction angles 30 and 32 degrees, moduli 60, 80, 120, 160 MPa.
std::vector<Sample> scattered()
{
  std::vector<Sample> samples;
  int number = 0;
  for (const double pressure : {50e3, 100e3})
    for (const double difference : {-1., 1.})
    {
      auto parameters = synthetic::known();
      parameters.friction_angle = 31 + difference;
      parameters.young_modulus = (70e6 + 10e6 * difference) * pressure / 50e3;
      samples.push_back(synthetic::sample(++number, pressure, synthetic::curve(pressure, parameters)));
    }
  return samples;
}

} // namespace

TEST_CASE("mean and sample standard deviation; none of too few values")
{
  const Statistic statistic = statistic_of({1, 2, 3, 6});
  CHECK(statistic.mean == 3);
  CHECK(statistic.deviation == Approx(std::sqrt(14 / 3.)).epsilon(1e-14));
  CHECK(statistic_of({5}).mean == 5);
  CHECK(std::isnan(statistic_of({5}).deviation));
  CHECK(std::isnan(statistic_of({}).mean));
}

TEST_CASE("an ensemble has the means and deviations of its samples, all together and by pressure")
{
  const EnsembleFit fit = fit_ensemble(scattered(), {});
  CHECK(fit.all.n_samples == 4);
  CHECK(fit.all.friction_angle.mean == Approx(31).epsilon(1e-8));
  CHECK(fit.all.friction_angle.deviation == Approx(std::sqrt(4 / 3.)).epsilon(1e-6));
  CHECK(fit.all.young_modulus.mean == Approx(105e6).epsilon(1e-8));
  CHECK(fit.all.poisson_ratio.mean == Approx(0.21).epsilon(1e-8));
  CHECK(fit.all.dilation_angle.mean == Approx(8.25).epsilon(1e-8));
  REQUIRE(fit.pressures.size() == 2);
  CHECK(fit.pressures[0].confining_pressure == 50e3);
  CHECK(fit.pressures[0].statistics.n_samples == 2);
  CHECK(fit.pressures[0].statistics.young_modulus.mean == Approx(70e6).epsilon(1e-8));
  CHECK(fit.pressures[0].statistics.young_modulus.deviation == Approx(std::sqrt(2.) * 10e6).epsilon(1e-6));
  CHECK(fit.pressures[1].statistics.young_modulus.mean == Approx(140e6).epsilon(1e-8));
  REQUIRE(fit.windows.size() == 3);
  for (const WindowStudy &study : fit.windows) // elastic beyond twice the window
    CHECK(study.young_modulus.mean == Approx(105e6).epsilon(1e-8));
  CHECK(fit.windows[0].axial_strain == 1e-4);
  CHECK(fit.windows[2].axial_strain == 4e-4);

  CHECK(fit.continuum.young_modulus == fit.all.young_modulus.mean);
  CHECK(fit.continuum.friction_angle == fit.all.friction_angle.mean);
  CHECK(fit.continuum.cohesion == 15);
  CHECK(fit.continuum.density == Approx(0.66 * 2650).epsilon(1e-9));
  CHECK_NOTHROW(fit.continuum.validate());
}

TEST_CASE("a curve that bends shows in the moduli of half and twice the window")
{
  std::vector<Sample> samples{synthetic::sample(1, 100e3, synthetic::curve(100e3))};
  TriaxialCurve &curve = samples[0].curve;
  for (std::size_t i = 0; i < 42; ++i) // to 0.03 %, a parabola whose slope is 80 MPa (1 − 1000 ε)
    curve.axial_stress[i] = -100e3 - 80e6 * curve.compression(i) * (1 - 500 * curve.compression(i));
  FitParameters parameters;
  parameters.windows.elastic_strain = 1e-4;
  const EnsembleFit fit = fit_ensemble(samples, parameters);
  REQUIRE(fit.windows.size() == 3);
  CHECK(fit.windows[0].young_modulus.mean == Approx(80e6 * 0.975).epsilon(1e-9)); // the slope in the window's middle
  CHECK(fit.windows[1].young_modulus.mean == Approx(80e6 * 0.95).epsilon(1e-9));
  CHECK(fit.windows[2].young_modulus.mean == Approx(80e6 * 0.90).epsilon(1e-9));
  CHECK(fit.all.young_modulus.mean == fit.windows[1].young_modulus.mean);
}

TEST_CASE("chosen pressures alone give Young's modulus")
{
  FitParameters parameters;
  parameters.young_pressures = {100e3};
  const EnsembleFit fit = fit_ensemble(scattered(), parameters);
  CHECK(fit.all.young_modulus.mean == Approx(140e6).epsilon(1e-8));
  CHECK(fit.windows[1].young_modulus.mean == Approx(140e6).epsilon(1e-8));
  CHECK(fit.all.friction_angle.mean == Approx(31).epsilon(1e-8));
  parameters.young_pressures = {75e3};
  CHECK_THROWS_WITH(fit_ensemble(scattered(), parameters), Contains("Elasticity/pressures"));
}

TEST_CASE("a modulus that grows with the pressure gives a power law, and the continuum that stiffness")
{
  // Geometric means sqrt(60 80) MPa at 50 kPa and twice that at 100 kPa: an exponent of 1.
  FitParameters parameters;
  parameters.reference_pressure = 200e3;
  EnsembleFit fit = fit_ensemble(scattered(), parameters);
  REQUIRE(fit.stiffness);
  CHECK(fit.stiffness->exponent == Approx(1).epsilon(1e-8));
  CHECK(fit.stiffness->modulus == Approx(4 * std::sqrt(60e6 * 80e6)).epsilon(1e-8));
  CHECK(fit.continuum.reference_pressure == 0);
  CHECK(fit.continuum.young_modulus == Approx(105e6).epsilon(1e-8));

  // Tests made by such a material give it back: its modulus is that of the pressure at the start of each small step.
  auto known = synthetic::known();
  known.reference_pressure = 100e3;
  known.stiffness_exponent = 0.4;
  std::vector<Sample> samples;
  for (const double pressure : {25e3, 50e3, 100e3, 200e3})
    samples.push_back(synthetic::sample(samples.size() + 1, pressure, synthetic::curve(pressure, known)));
  parameters.stiffness_law = StiffnessLaw::power;
  parameters.reference_pressure = 100e3;
  parameters.windows.elastic_strain = 2.5e-5; // the pressure hardly rises
  fit = fit_ensemble(samples, parameters);
  CHECK(fit.continuum.reference_pressure == 100e3);
  CHECK(fit.continuum.stiffness_exponent == Approx(0.4).margin(0.01));
  CHECK(fit.continuum.young_modulus == Approx(80e6).epsilon(0.01));

  samples.resize(1);
  CHECK_THROWS_WITH(fit_ensemble(samples, parameters), Contains("Elasticity/stiffness") && Contains("single"));
}

TEST_CASE("the cohesion is given or the common tangent's")
{
  auto cohesive = synthetic::known();
  cohesive.cohesion = 2000;
  std::vector<Sample> samples;
  for (const double pressure : {50e3, 100e3})
    samples.push_back(synthetic::sample(static_cast<int>(pressure), pressure, synthetic::curve(pressure, cohesive)));
  FitParameters parameters;
  const EnsembleFit given = fit_ensemble(samples, parameters);
  CHECK(given.cohesion == 15);
  CHECK(given.all.friction_angle.mean > 32); // the cohesion not granted is taken for friction
  parameters.cohesion_source = CohesionSource::common_tangent;
  const EnsembleFit common = fit_ensemble(samples, parameters);
  CHECK(common.cohesion == Approx(2000).epsilon(1e-6));
  CHECK(common.all.friction_angle.mean == Approx(31.5).epsilon(1e-7));

  CHECK_THROWS_WITH(fit_ensemble({samples[0]}, parameters), Contains("two different confining pressures"));
  parameters.cohesion_source = CohesionSource::given;
  parameters.cohesion = 1e6;
  CHECK_THROWS_WITH(fit_ensemble(samples, parameters), Contains("Strength/cohesion") && Contains("1e+06"));
}

TEST_CASE("values that no continuum may have are moved into its range with a word")
{
  std::vector<Sample> samples{synthetic::sample(1, 50e3, synthetic::curve(50e3))};
  for (std::size_t i = 0; i < samples[0].curve.size(); ++i) // shrinks by half of the compression: D = −0.5, ν = 0.25
    samples[0].curve.volumetric_strain[i] = 0.5 * samples[0].curve.axial_strain[i];
  const EnsembleFit shrinking = fit_ensemble(samples, {});
  CHECK(shrinking.all.dilation_angle.mean == Approx(std::asin(-1 / 3.) * 180 / 3.141592653589793).epsilon(1e-9));
  CHECK(shrinking.continuum.dilation_angle == shrinking.all.dilation_angle.mean); // loose sand contracts
  CHECK(shrinking.warnings.empty());
  CHECK_NOTHROW(shrinking.continuum.validate());

  for (std::size_t i = 0; i < samples[0].curve.size(); ++i) // grows as it shortens: ν = 0.75, D = 0.5
    samples[0].curve.volumetric_strain[i] = -0.5 * samples[0].curve.axial_strain[i];
  const EnsembleFit growing = fit_ensemble(samples, {});
  CHECK(growing.all.poisson_ratio.mean == Approx(0.75).epsilon(1e-9));
  CHECK(growing.continuum.poisson_ratio == 0.49);
  CHECK_NOTHROW(growing.continuum.validate());
  REQUIRE(growing.warnings.size() == 1);
  CHECK_THAT(growing.warnings[0], Contains("Poisson's ratio") && Contains("0.75"));
}

TEST_CASE("a sample that cannot be fitted is named")
{
  std::vector<Sample> samples = scattered();
  samples[2].curve.axial_stress.assign(samples[2].curve.size(), -1e3);
  CHECK_THROWS_WITH(fit_ensemble(samples, {}), Contains("sample 3:"));
}

TEST_CASE("mean curves are exact between rows of straight curves, and end with the shortest")
{
  const auto line = [](const double end, const int n, const double slope)
  {
    TriaxialCurve curve;
    for (int i = 0; i <= n; ++i)
    {
      const double e = end * i / n;
      curve.axial_strain.push_back(-e);
      curve.volumetric_strain.push_back(slope * e);
      curve.axial_stress.push_back(-1e5 * (1 + slope * e));
      curve.lateral_stress.push_back(-1e5);
      curve.solid_fraction.push_back(0.6);
    }
    return curve;
  };
  TriaxialCurve first = line(0.2, 7, 1), second = line(0.1, 11, 3);
  second.axial_strain.insert(second.axial_strain.begin() + 7, -0.02); // a step back, which is left out
  for (auto *column : {&second.volumetric_strain, &second.axial_stress, &second.lateral_stress, &second.solid_fraction})
    column->insert(column->begin() + 7, 1e9);
  using Curves = std::vector<const TriaxialCurve *>;
  for (const Curves &curves : {Curves{&first, &second}, Curves{&second, &first}})
  {
    const auto points = mean_curve(curves, 5);
    REQUIRE(points.size() == 5);
    for (int i = 0; i < 5; ++i)
    {
      const double e = 0.1 * i * i / 16.;
      CHECK(points[i].axial_strain == Approx(-e));
      CHECK(points[i].volumetric_strain.mean == Approx(2 * e).margin(1e-15));
      CHECK(points[i].volumetric_strain.deviation == Approx(std::sqrt(2.) * e).margin(1e-15));
      CHECK(points[i].stress_ratio.mean == Approx(1 + 2 * e));
      CHECK(points[i].axial_stress.mean == Approx(-1e5 * (1 + 2 * e)));
      CHECK(points[i].solid_fraction.mean == Approx(0.6));
    }
  }
}
