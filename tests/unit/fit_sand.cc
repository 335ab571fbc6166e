#include "dem/core/error.h"
#include "drivers/fit_mohr_coulomb/hardening_fit.h"
#include "drivers/fit_mohr_coulomb/sand_fit.h"
#include "drivers/fit_mohr_coulomb/sand_path.h"
#include "fe_dealii/material/hypoplastic.h"
#include "tests/unit/fit_synthetic.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <utility>
#include <vector>

using namespace bergamo;
using namespace bergamo::driver;
using Catch::Matchers::Contains;

namespace
{

fe::HypoplasticParameters known_sand()
{
  return {.critical_friction_angle = 31.2,
          .granulate_hardness = 2.2e9,
          .compression_exponent = 0.31,
          .densest_void_ratio = 0.52,
          .critical_void_ratio = 0.88,
          .loosest_void_ratio = 1.15 * 0.88,
          .pyknotropy_exponent = 0.17,
          .stiffness_exponent = 1.35};
}

/// Tests that the law itself makes: three densities, three pressures, compressed from a twentieth.
std::vector<Sample> ensemble_of(const fe::HypoplasticSand &sand, const std::vector<double> &pressures = {5e4, 2e5, 8e5})
{
  std::vector<double> strains;
  for (int i = 0; i <= 100; ++i)
    strains.push_back(-0.2 * i * i / 1e4);
  std::vector<Sample> samples;
  for (const auto &[friction, solid_fraction] : {std::pair(0.01, 0.63), std::pair(0.1, 0.58), std::pair(1., 0.55)})
    for (const double pressure : pressures)
    {
      Sample sample{static_cast<int>(samples.size()) + 1, 0.01, friction, pressure, 1000, {}, {}};
      for (int i = 0; i <= 40; ++i)
        sample.compression.pressure.push_back(pressure * std::pow(20., i / 40. - 1));
      sample.compression.solid_fraction = compress(sand, sample.compression.pressure, solid_fraction);
      sample.curve = drive_triaxial(sand, {pressure, sample.compression.solid_fraction.back()}, strains);
      samples.push_back(std::move(sample));
    }
  return samples;
}

double share_off(const double found, const double expected)
{
  return std::abs(found / expected - 1);
}

} // namespace

TEST_CASE("path of sand: pressure is held, void ratio and volume go together, dense dilates and loose contracts",
          "[fit]")
{
  const fe::HypoplasticSand sand(known_sand());
  const std::vector<double> strains{0, -0.001, -0.01, -0.05, -0.25};
  for (const double solid_fraction : {0.63, 0.55})
  {
    const TriaxialCurve curve = drive_triaxial(sand, {1e5, solid_fraction}, strains);
    REQUIRE(curve.size() == strains.size());
    for (std::size_t i = 0; i < curve.size(); ++i)
    {
      CHECK(curve.axial_strain[i] == strains[i]);
      CHECK(curve.lateral_stress[i] == Approx(-1e5).epsilon(1e-8));
      CHECK(curve.solid_fraction[i] * (1 + curve.volumetric_strain[i]) == Approx(solid_fraction).epsilon(1e-12));
    }
    CHECK((curve.volumetric_strain.back() > 0) == (solid_fraction > 0.6));
    CHECK(curve.stress_ratio(4) > 2.9);
  }
}

TEST_CASE("path of sand: isotropic compression of the loosest state is Bauer's law", "[fit]")
{
  // e/e_i0 = exp(−(3p/h_s)^n) is what the equation is made for: the stiffness of e = e_i.
  const fe::HypoplasticParameters p = known_sand();
  const fe::HypoplasticSand sand(p);
  std::vector<double> pressures;
  for (int i = 0; i <= 100; ++i)
    pressures.push_back(1e4 * std::pow(100., i / 100.));
  const double start = sand.limit_void_ratios(pressures.front()).loosest;
  const std::vector<double> path = compress(sand, pressures, 1 / (1 + start));
  for (std::size_t i = 0; i < path.size(); ++i)
    CHECK(1 / path[i] - 1 == Approx(sand.limit_void_ratios(pressures[i]).loosest).epsilon(1e-6));
}

TEST_CASE("path of Mohr and Coulomb: isotropic compression takes p/K", "[fit]")
{
  const fe::MohrCoulomb material(synthetic::known());
  const std::vector<double> path = compress(material, std::vector<double>{1e4, 3e4, 9e4}, 0.6);
  CHECK(0.6 / path.back() == Approx(1 - 8e4 / material.bulk_modulus()).epsilon(1e-6));
}

TEST_CASE("fit of sand: the parameters that made the tests come back", "[fit]")
{
  const fe::HypoplasticParameters p = known_sand();
  const std::vector<SandTest> tests = sand_tests(ensemble_of(fe::HypoplasticSand(p)), 41, 0.1);
  REQUIRE(tests.size() == 9);
  const SandFit fit = fit_sand(tests, {.is_wanted = true});
  // Between rows the tests are interpolated: 100 rows of a bent curve leave some 1e-4 of it.
  CHECK(fit.misfit.all < 1e-3);
  CHECK(share_off(fit.sand.critical_friction_angle, p.critical_friction_angle) < 5e-3);
  CHECK(share_off(std::log(fit.sand.granulate_hardness), std::log(p.granulate_hardness)) < 1e-2);
  CHECK(share_off(fit.sand.compression_exponent, p.compression_exponent) < 2e-2);
  CHECK(share_off(fit.sand.critical_void_ratio, p.critical_void_ratio) < 5e-3);
  CHECK(share_off(fit.sand.densest_void_ratio, p.densest_void_ratio) < 2e-2);
  CHECK(share_off(fit.sand.pyknotropy_exponent, p.pyknotropy_exponent) < 5e-2);
  CHECK(share_off(fit.sand.stiffness_exponent, p.stiffness_exponent) < 3e-2);
  CHECK(fit.sand.loosest_void_ratio == Approx(1.15 * fit.sand.critical_void_ratio));
}

TEST_CASE("fit of sand: noise of a hundredth moves the parameters by little, and is the misfit", "[fit]")
{
  const fe::HypoplasticParameters p = known_sand();
  std::vector<Sample> samples = ensemble_of(fe::HypoplasticSand(p));
  for (Sample &sample : samples)
    synthetic::add_noise(sample.curve.axial_stress, 0.01 * sample.confining_pressure, 100 + sample.number);
  const SandFit fit =
      fit_sand(sand_tests(samples, 41, 0.1), {.is_wanted = true, .densest_void_ratio = p.densest_void_ratio});
  CHECK(fit.sand.densest_void_ratio == p.densest_void_ratio);
  CHECK(share_off(fit.sand.critical_friction_angle, p.critical_friction_angle) < 1e-2);
  CHECK(share_off(fit.sand.critical_void_ratio, p.critical_void_ratio) < 1e-2);
  CHECK(share_off(fit.sand.pyknotropy_exponent, p.pyknotropy_exponent) < 0.1);
  // A hundredth of the pressure on ratios that are about two beyond one, over the root of three kinds of values.
  CHECK(fit.misfit.all < 0.01 / 2 * 1.5);
  CHECK(fit.misfit.all > 0.001);
}

TEST_CASE("misfit: none of the grains' own curves, one of a body in which nothing changes", "[fit]")
{
  const std::vector<SandTest> tests = sand_tests(ensemble_of(fe::HypoplasticSand(known_sand())), 21, 0.1);
  std::vector<LawCurves> same, rigid;
  for (const SandTest &test : tests)
  {
    LawCurves curves, still;
    for (const MeanPoint &point : test.shear)
    {
      curves.shear.axial_stress.push_back(point.stress_ratio.mean);
      curves.shear.lateral_stress.push_back(1);
      curves.shear.volumetric_strain.push_back(point.volumetric_strain.mean);
      still.shear.axial_stress.push_back(1);
      still.shear.lateral_stress.push_back(1);
      still.shear.volumetric_strain.push_back(0);
    }
    curves.compressed_solid_fraction = test.compression.solid_fraction;
    still.compressed_solid_fraction.assign(test.compression.size(), 0.6);
    same.push_back(curves);
    rigid.push_back(still);
  }
  CHECK(misfit(tests, same).all == Approx(0).margin(1e-12));
  const Misfit none = misfit(tests, rigid);
  for (const double off : {none.all, none.stress_ratio, none.volumetric_strain, none.compression})
    CHECK(off == Approx(1).epsilon(1e-12));
}

TEST_CASE("fit of sand: tests of one density or one pressure are refused", "[fit]")
{
  const fe::HypoplasticSand sand(known_sand());
  CHECK_THROWS_WITH(fit_sand(sand_tests(ensemble_of(sand, {1e5}), 11, 0.1), {.is_wanted = true}),
                    Contains("Ensemble/pressures") && Contains("Sand/fit"));
  std::vector<Sample> samples = ensemble_of(sand);
  samples.resize(3);
  CHECK_THROWS_WITH(fit_sand(sand_tests(samples, 11, 0.1), {.is_wanted = true}),
                    Contains("Ensemble/generation frictions"));
}

TEST_CASE("fit of a friction that hardens: the parameters that made the tests come back", "[fit]")
{
  const fe::MohrCoulombParameters p{.young_modulus = 3e8,
                                    .poisson_ratio = 0.12,
                                    .friction_angle = 33,
                                    .dilation_angle = 4,
                                    .cohesion = 15,
                                    .density = 1700,
                                    .reference_pressure = 1e5,
                                    .stiffness_exponent = 0.35,
                                    .hardening_strain = 1.5e-3};
  const fe::MohrCoulomb law(p);
  std::vector<double> strains;
  for (int i = 0; i <= 100; ++i)
    strains.push_back(-0.1 * i * i / 1e4);
  std::vector<Sample> samples;
  for (const double pressure : {5e4, 2e5})
    samples.push_back({static_cast<int>(samples.size()) + 1,
                       0.01,
                       0.1,
                       pressure,
                       1700,
                       drive_triaxial(law, {pressure, 0.62}, strains),
                       {}});
  fe::MohrCoulombParameters start = p; // what secants and ends of such curves would tell
  start.young_modulus = 1e8;
  start.poisson_ratio = 0.3;
  start.friction_angle = 31;
  start.dilation_angle = 0;
  start.stiffness_exponent = 0.5;
  start.hardening_strain = 0;
  const HardeningFit fit = fit_hardening(sand_tests(samples, 41, 0.1), start);
  CHECK(fit.misfit.all < 3e-3); // rows of the tests are interpolated
  CHECK(share_off(fit.continuum.young_modulus, p.young_modulus) < 0.03);
  CHECK(share_off(fit.continuum.stiffness_exponent, p.stiffness_exponent) < 0.05);
  CHECK(std::abs(fit.continuum.poisson_ratio - p.poisson_ratio) < 0.02);
  CHECK(share_off(fit.continuum.friction_angle, p.friction_angle) < 5e-3);
  CHECK(std::abs(fit.continuum.dilation_angle - p.dilation_angle) < 0.1);
  CHECK(share_off(fit.continuum.hardening_strain, p.hardening_strain) < 0.03);
}
