#include "drivers/fit_mohr_coulomb/sand_fit.h"

#include "dem/core/error.h"
#include "drivers/common/number_text.h"
#include "drivers/fit_mohr_coulomb/least_misfit.h"
#include "drivers/fit_mohr_coulomb/void_ratio.h"
#include "fe_dealii/material/hypoplastic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace bergamo::driver
{
namespace
{

using Vector = Eigen::VectorXd;

// What sands have, and more; grains of a simulation may be far stiffer than quartz packings.
constexpr Bounded angle{10, 60};       // φ_c [degrees]
constexpr Bounded hardness{1e6, 1e15}; // h_s [Pa]
constexpr Bounded exponent{0.1, 0.9};  // n
constexpr Bounded critical{0.2, 3};    // e_c0
constexpr Bounded pyknotropy{0.01, 1}; // α
constexpr Bounded stiffness{0.1, 5};   // β
constexpr Bounded densest{0.3, 0.98};  // e_d0 over e_c0

/// The unknowns as numbers without bounds. The last, e_d0 over e_c0, is left out where e_d0 is given.
Vector unknowns_of(const fe::HypoplasticParameters &sand, const SandFitParameters &given)
{
  Vector x(given.densest_void_ratio > 0 ? 6 : 7);
  x.head(6) << angle.number(sand.critical_friction_angle), hardness.number(sand.granulate_hardness),
      exponent.number(sand.compression_exponent), critical.number(sand.critical_void_ratio),
      pyknotropy.number(sand.pyknotropy_exponent), stiffness.number(sand.stiffness_exponent);
  if (x.size() == 7)
    x[6] = densest.number(sand.densest_void_ratio / sand.critical_void_ratio);
  return x;
}

fe::HypoplasticParameters sand_of(const Vector &x, const SandFitParameters &given, const double initial_void_ratio)
{
  fe::HypoplasticParameters sand;
  sand.critical_friction_angle = angle.value(x[0]);
  sand.granulate_hardness = hardness.value(x[1]);
  sand.compression_exponent = exponent.value(x[2]);
  sand.critical_void_ratio = critical.value(x[3]);
  sand.pyknotropy_exponent = pyknotropy.value(x[4]);
  sand.stiffness_exponent = stiffness.value(x[5]);
  sand.densest_void_ratio = x.size() == 7 ? sand.critical_void_ratio * densest.value(x[6]) : given.densest_void_ratio;
  sand.loosest_void_ratio = given.loosest_over_critical * sand.critical_void_ratio;
  sand.initial_void_ratio = initial_void_ratio;
  return sand;
}

/// From the ends of the shears, which all go to the same critical state.
fe::HypoplasticParameters first_guess(const std::vector<SandTest> &tests, const SandFitParameters &given)
{
  fe::HypoplasticParameters sand;
  double sine = 0, at_the_end = 0, least = std::numeric_limits<double>::infinity();
  for (const SandTest &test : tests)
  {
    const double ratio = test.shear.back().stress_ratio.mean;
    sine += (ratio - 1) / (ratio + 1) / static_cast<double>(tests.size());
    at_the_end += void_ratio_of(test.shear.back().solid_fraction.mean) / static_cast<double>(tests.size());
    least = std::min(least, void_ratio_of(test.initial_solid_fraction()));
  }
  sand.critical_friction_angle = std::asin(std::clamp(sine, 0.1, 0.8)) * 180 / std::numbers::pi;
  sand.critical_void_ratio = at_the_end;
  sand.densest_void_ratio =
      given.densest_void_ratio > 0 ? given.densest_void_ratio : std::min(0.9 * least, 0.8 * at_the_end);
  sand.pyknotropy_exponent = 0.15;
  sand.stiffness_exponent = 1.2;
  return sand;
}

void require_variety(const std::vector<SandTest> &tests)
{
  std::set<double> frictions, pressures;
  for (const SandTest &test : tests)
  {
    frictions.insert(test.generation_friction);
    pressures.insert(test.confining_pressure);
  }
  for (const auto &[values, name] : {std::pair(frictions, "generation frictions"), std::pair(pressures, "pressures")})
    if (values.size() < 2)
      throw ConfigError(
          "Sand/fit is true, but the samples have one value of Ensemble/" + std::string(name) + " alone, " +
          short_text(*values.begin()) +
          "; the law of sand is told by several densities and pressures: choose more, or set it to false");
}

} // namespace

SandFit fit_sand(const std::vector<SandTest> &tests, const SandFitParameters &given)
{
  require_variety(tests);
  double initial = 0;
  for (const SandTest &test : tests)
    initial += void_ratio_of(test.initial_solid_fraction()) / static_cast<double>(tests.size());
  const auto curves_at = [&](const Vector &x)
  { return curves_of(fe::HypoplasticSand(sand_of(x, given, initial)), tests); };
  fe::HypoplasticParameters guess = first_guess(tests, given);
  std::vector<std::pair<double, Vector>> starts;
  for (const double h_s : {1e8, 1e9, 1e10, 1e11, 1e12})
    for (const double n : {0.25, 0.4, 0.6})
    {
      guess.granulate_hardness = h_s;
      guess.compression_exponent = n;
      const Vector x = unknowns_of(guess, given);
      starts.emplace_back(misfit_at(tests, curves_at, x), x);
    }
  std::stable_sort(starts.begin(), starts.end(), [](const auto &a, const auto &b) { return a.first < b.first; });

  constexpr int n_tried = 3;
  Vector best = starts.front().second;
  double least = starts.front().first;
  for (int k = 0; k < n_tried; ++k)
  {
    const Vector x = least_misfit(tests, curves_at, starts[k].second);
    if (const double size = misfit_at(tests, curves_at, x); size < least)
    {
      least = size;
      best = x;
    }
  }
  SandFit fit;
  fit.sand = sand_of(best, given, initial);
  fit.curves = curves_at(best);
  fit.misfit = misfit(tests, fit.curves);
  return fit;
}

} // namespace bergamo::driver
