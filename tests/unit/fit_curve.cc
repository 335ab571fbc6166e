// The fit of one curve against the parameters of the material that made it, and against closed forms.
#include "dem/core/error.h"
#include "drivers/fit_mohr_coulomb/fit.h"
#include "tests/unit/fit_synthetic.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace bergamo::driver;
using bergamo::ConfigError;
using Catch::Matchers::Contains;

namespace
{

constexpr double degree = std::numbers::pi / 180;

} // namespace

TEST_CASE(
    "the path of the material: Hooke's line, Mohr-Coulomb's strength, the flow rule's dilation, constant pressure")
{
  const auto p = synthetic::known();
  const double pressure = 50e3;
  const TriaxialCurve curve = synthetic::curve(pressure);
  const double t = std::tan((45 + 0.5 * p.friction_angle) * degree), s = std::sin(p.dilation_angle * degree);
  const double strength = pressure * t * t + 2 * p.cohesion * t;
  const double elastic_end = (strength - pressure) / p.young_modulus; // 0.14 % of compression
  for (std::size_t i = 0; i < curve.size(); ++i)
  {
    const double compression = curve.compression(i);
    const double elastic = std::min(compression, elastic_end);
    const double expected = -pressure - p.young_modulus * elastic;
    const double volume = -(1 - 2 * p.poisson_ratio) * elastic + 2 * s / (1 - s) * (compression - elastic);
    // The pressure is held to 1e-12; thousands of steps add up.
    REQUIRE(curve.lateral_stress[i] == Approx(-pressure).epsilon(1e-11));
    REQUIRE(curve.axial_stress[i] == Approx(expected).epsilon(1e-9));
    REQUIRE(curve.volumetric_strain[i] == Approx(volume).margin(1e-10));
    REQUIRE(curve.solid_fraction[i] == Approx(0.66 / (1 + volume)).epsilon(1e-9));
  }
}

TEST_CASE("a path of a single large step ends where a path of many small ones does")
{
  const bergamo::fe::MohrCoulomb material(synthetic::known());
  const std::vector<double> one{-0.2};
  const TriaxialCurve large = drive_triaxial(material, {1000., 0.66}, one);
  const TriaxialCurve small = synthetic::curve(1000.);
  // Trial stresses of 0.2 E round to about 1e-14 of it, 2e-7 Pa, beside 1000 Pa.
  CHECK(large.axial_stress.back() == Approx(small.axial_stress.back()).epsilon(1e-8));
  CHECK(large.volumetric_strain.back() == Approx(small.volumetric_strain.back()).epsilon(1e-8));
}

TEST_CASE("the parameters of a material come back from its own curves")
{
  const auto p = synthetic::known();
  for (const double pressure : {25e3, 50e3, 100e3, 200e3})
  {
    const SampleFit fit = fit_sample(synthetic::curve(pressure), {});
    // The curve's own errors (1e-12 of the stress) over the window's change of it.
    CHECK(fit.elastic.young_modulus == Approx(p.young_modulus).epsilon(1e-8));
    CHECK(fit.elastic.poisson_ratio == Approx(p.poisson_ratio).epsilon(1e-8));
    CHECK(friction_angle(fit.peak_axial_pressure, fit.peak_lateral_pressure, p.cohesion) ==
          Approx(p.friction_angle).epsilon(1e-8));
    CHECK(fit.dilation_angle == Approx(p.dilation_angle).epsilon(1e-8));
    CHECK(fit.final_stress_ratio == Approx(fit.peak_stress_ratio()).epsilon(1e-8));
    CHECK(fit.initial_solid_fraction == Approx(0.66).epsilon(1e-9));
  }
}

TEST_CASE("noise moves the fitted parameters by no more than its share in each window")
{
  const auto p = synthetic::known();
  const double pressure = 100e3, stress_noise = 200., volume_noise = 1e-6; // deviations in every row
  const FitWindows windows;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5})
  {
    TriaxialCurve curve = synthetic::curve(pressure);
    synthetic::add_noise(curve.axial_stress, stress_noise, 3 * seed);
    synthetic::add_noise(curve.lateral_stress, stress_noise, 3 * seed + 1);
    synthetic::add_noise(curve.volumetric_strain, volume_noise, 3 * seed + 2);
    const SampleFit fit = fit_sample(curve, windows);

    // The slope of n evenly spread points with deviation d over a window w has the deviation d sqrt(12/n)/w: bounds are
    // four of these.
    const double young_deviation = stress_noise * std::sqrt(12 / 41.) / windows.elastic_strain;
    CHECK(std::abs(fit.elastic.young_modulus - p.young_modulus) < 4 * young_deviation); // 2.7 % of E
    CHECK(fit.elastic.young_modulus != Approx(p.young_modulus).epsilon(1e-6));
    const double poisson_deviation = 0.5 * volume_noise * std::sqrt(12 / 41.) / windows.elastic_strain;
    CHECK(std::abs(fit.elastic.poisson_ratio - p.poisson_ratio) < 4 * poisson_deviation); // 0.0054

    // A mean over 21 rows has the deviation d/sqrt(21); the largest of some 100 independent ones lies 2.5 ± 0.4 of
    // these above, and certainly above the true strength. The lateral mean there is at most four away.
    const double mean_deviation = stress_noise / std::sqrt(21.);
    const double t = std::tan((45 + 0.5 * p.friction_angle) * degree);
    const double excess = fit.peak_axial_pressure - pressure * t * t - 2 * p.cohesion * t;
    CHECK(excess > 1 * mean_deviation);
    CHECK(excess < 5 * mean_deviation);
    CHECK(std::abs(fit.peak_lateral_pressure - pressure) < 4 * mean_deviation);
    // dφ = dR cos φ/(1 − sin φ)... as a whole below 0.1° for such noise of 0.2 %.
    CHECK(friction_angle(fit.peak_axial_pressure, fit.peak_lateral_pressure, p.cohesion) ==
          Approx(p.friction_angle).margin(0.1));

    const double rate_deviation = volume_noise * std::sqrt(12 / 501.) / 0.05;
    const double s = std::sin(p.dilation_angle * degree);
    CHECK(std::abs(fit.dilation_rate - 2 * s / (1 - s)) < 4 * rate_deviation);
    CHECK(fit.dilation_angle == Approx(p.dilation_angle).margin(0.01));
  }
}

TEST_CASE("the elastic slopes do not mind a jump at the start, and see what bends")
{
  TriaxialCurve curve = synthetic::curve(100e3);
  for (double &stress : curve.axial_stress)
    stress -= 500.;
  CHECK(elastic_fit(curve, 2e-4)->young_modulus == Approx(80e6).epsilon(1e-8));

  // σ = −p − E0 ε (1 − ε/(2 b)): a parabola's line of least squares over [0, w] has the slope in its middle, w/2.
  const double bend = 1e-3;
  for (std::size_t i = 0; i < curve.size(); ++i)
  {
    const double e = curve.compression(i);
    curve.axial_stress[i] = -100e3 - 80e6 * e * (1 - 0.5 * e / bend);
  }
  CHECK(elastic_fit(curve, 2e-4)->young_modulus == Approx(80e6 * 0.9).epsilon(1e-9));
  CHECK(elastic_fit(curve, 1e-4)->young_modulus == Approx(80e6 * 0.95).epsilon(1e-9));
}

TEST_CASE("the friction angle touches the circle")
{
  for (const double phi : {1., 23.15, 50.})
    for (const double cohesion : {0., 15., 5000.})
    {
      const double pressure = 25e3, sine = std::sin(phi * degree), cosine = std::cos(phi * degree);
      // Distance of the centre C from the line equals the radius R: R = C sin φ + c cos φ with C = p + R.
      const double radius = (pressure * sine + cohesion * cosine) / (1 - sine);
      CHECK(friction_angle(pressure + 2 * radius, pressure, cohesion) == Approx(phi).epsilon(1e-10));
    }
  // The dissertation's peak: φ = 23.15° is a ratio of stresses of 2.296, about its 2.3 for cells of 30 mm.
  CHECK(friction_angle(2.296 * 25e3, 25e3, 0) == Approx(23.15).margin(0.01));
}

TEST_CASE("the common tangent of circles made from a line is that line; one circle has none")
{
  std::vector<MohrCircle> circles;
  const double sine = std::sin(28 * degree), cosine = std::cos(28 * degree);
  for (const double pressure : {25e3, 50e3, 100e3, 200e3})
  {
    const double radius = (pressure * sine + 700. * cosine) / (1 - sine);
    circles.push_back({pressure + radius, radius});
  }
  const auto tangent = common_tangent(circles);
  REQUIRE(tangent);
  CHECK(tangent->friction_angle == Approx(28).epsilon(1e-10));
  CHECK(tangent->cohesion == Approx(700).epsilon(1e-8));

  // Least squares: R = (C, 2C + d, ...) moves by the normal equations; here the slope of (1,1), (2,1), (3,2) is 1/2 and
  // the intercept 1/3.
  const auto scattered = common_tangent(std::vector<MohrCircle>{{1, 1}, {2, 1}, {3, 2}});
  REQUIRE(scattered);
  CHECK(scattered->friction_angle == Approx(30).epsilon(1e-12));
  CHECK(scattered->cohesion == Approx(1 / 3. / std::cos(30 * degree)).epsilon(1e-12));

  CHECK_FALSE(common_tangent(std::vector<MohrCircle>{circles[0]}));
  CHECK_FALSE(common_tangent(std::vector<MohrCircle>{circles[0], circles[0]}));
  CHECK_FALSE(common_tangent(std::vector<MohrCircle>{}));
  CHECK_FALSE(common_tangent(std::vector<MohrCircle>{{1, 1}, {2, 0.5}})); // strength falls with the pressure
}

TEST_CASE("the dilation angle follows from the rate by sin psi = D/(2 + D)")
{
  for (const double psi : {-10., 0., 5.17, 23.15})
  {
    const double s = std::sin(psi * degree);
    CHECK(dilation_angle(2 * s / (1 - s)) == Approx(psi).margin(1e-12));
  }
  // The dissertation's rates, 0.175 (cells of 10 mm) and 0.205 (30 mm), lie about its angle of 5.17°.
  CHECK(dilation_angle(0.175) == Approx(4.61).margin(0.01));
  CHECK(dilation_angle(0.205) == Approx(5.33).margin(0.01));
}

TEST_CASE("the peak is the largest averaged stress, the final state the mean of the end")
{
  TriaxialCurve curve;
  for (int i = 0; i <= 200; ++i) // a hill of height 1 at 10 % upon 2, a spike of 5 in one row at 15 %
  {
    const double e = 1e-3 * i;
    curve.axial_strain.push_back(-e);
    curve.volumetric_strain.push_back(0.1 * e);
    curve.axial_stress.push_back(-1e5 * (2 + std::max(0., 1 - 400 * (e - 0.1) * (e - 0.1)) + (i == 150 ? 5 : 0)));
    curve.lateral_stress.push_back(-1e5);
    curve.solid_fraction.push_back(0.6 + 0.1 * e);
  }
  FitWindows windows{.elastic_strain = 0.01, .peak_average = 0, .final_average = 0.02};
  CHECK(fit_sample(curve, windows).peak_compression == Approx(0.15));
  windows.peak_average = 0.02; // the spike's share is 5/21 = 0.24, upon 2 and no hill left (1 − 400·0.05² = 0)
  const SampleFit fit = fit_sample(curve, windows);
  CHECK(fit.peak_compression == Approx(0.1));
  CHECK(fit.peak_stress_ratio() == Approx(2 + 1 - 400 * (1e-6 * 770 / 21)).epsilon(1e-9)); // 2 (1² + ... + 10²) = 770
  CHECK(fit.final_stress_ratio == Approx(2));
  CHECK(fit.critical_solid_fraction == Approx(0.6 + 0.1 * 0.19));
  CHECK_FALSE(fit.hardens_to_the_end);
  for (std::size_t i = 0; i < curve.size(); ++i)
    curve.axial_stress[i] = -1e5 * (1 + curve.compression(i));
  CHECK(fit_sample(curve, windows).hardens_to_the_end);
}

TEST_CASE("curves that cannot be fitted are refused with the remedy")
{
  const TriaxialCurve good = synthetic::curve(100e3);
  CHECK_NOTHROW(fit_sample(good, {}));

  TriaxialCurve short_one = good;
  for (auto *column : {&short_one.axial_strain, &short_one.volumetric_strain, &short_one.axial_stress,
                       &short_one.lateral_stress, &short_one.solid_fraction})
    column->resize(1200); // to 11.6 %
  CHECK_THROWS_WITH(fit_sample(short_one, {}), Contains("Dilation/to") && Contains("ends at 0.116"));

  FitWindows narrow;
  narrow.elastic_strain = 4e-6;
  CHECK_THROWS_WITH(fit_sample(good, narrow), Contains("Elasticity/axial strain") && Contains("4e-06"));
  narrow.elastic_strain = 1e-5; // three rows: at 0, in the middle, on the rim
  CHECK_NOTHROW(fit_sample(good, narrow));

  TriaxialCurve turned = good; // compression positive
  for (double &stress : turned.axial_stress)
    stress = -stress;
  for (double &stress : turned.lateral_stress)
    stress = -stress;
  CHECK_THROWS_WITH(fit_sample(turned, {}), Contains("compressive"));

  TriaxialCurve extension = good;
  for (double &stress : extension.axial_stress)
    stress = -5e4;
  CHECK_THROWS_WITH(fit_sample(extension, {}), Contains("must exceed the lateral"));

  CHECK_THROWS_AS(fit_sample({}, {}), ConfigError);
  FitWindows wrong;
  wrong.dilation_to = wrong.dilation_from;
  CHECK_THROWS_WITH(wrong.validate(), Contains("Dilation/to"));
}
