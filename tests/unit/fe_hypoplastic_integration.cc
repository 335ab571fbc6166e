#include "fe_dealii/material/hypoplastic_integration.h"
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

SandState isotropic(const double pressure, const double void_ratio)
{
  return {{-pressure, -pressure, -pressure, 0, 0, 0}, void_ratio};
}

Strain scaled(const double factor, Strain strain)
{
  for (double &component : strain)
    component *= factor;
  return strain;
}

/// Pressure of the loosest state of a void ratio, Bauer's law solved for it [Pa].
double bauer_pressure(const HypoplasticParameters &p, const double void_ratio)
{
  return p.granulate_hardness / 3 * std::pow(-std::log(void_ratio / p.loosest_void_ratio), 1 / p.compression_exponent);
}

/// The strain that compresses the loosest state from one pressure to another, the same in all directions.
Strain bauer_compression(const HypoplasticSand &sand, const double from, const double to)
{
  const double volume = std::log((1 + sand.limit_void_ratios(to).loosest) / (1 + sand.limit_void_ratios(from).loosest));
  return {volume / 3, volume / 3, volume / 3, 0, 0, 0};
}

/// An increment by the classical method of order 4 on the equation as written apart from the program, the void ratio
/// integrated with it.
SandState reference_update(const HypoplasticParameters &p, const SandState &start, const Strain &increment,
                           const int n_steps)
{
  const Tensor d = strain_tensor(scaled(1. / n_steps, increment));
  Stress stress = start.stress;
  double e = start.void_ratio;
  for (int step = 0; step < n_steps; ++step)
  {
    Stress sum{}, slope{};
    double e_sum = 0, e_slope = 0;
    constexpr double from[] = {0, 0.5, 0.5, 1}, weight[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
    for (int stage = 0; stage < 4; ++stage)
    {
      Stress at = stress;
      for (int i = 0; i < 6; ++i)
        at[i] += from[stage] * slope[i];
      const double e_at = e + from[stage] * e_slope;
      slope = components(reference_rate(p, tensor(at), e_at, d));
      e_slope = (1 + e_at) * trace(d);
      for (int i = 0; i < 6; ++i)
        sum[i] += weight[stage] * slope[i];
      e_sum += weight[stage] * e_slope;
    }
    for (int i = 0; i < 6; ++i)
      stress[i] += sum[i];
    e += e_sum;
  }
  return {stress, e};
}

} // namespace

TEST_CASE("Sand update: the loosest state follows Bauer's law", "[fe]")
{
  // Errors contract on the way, for compression stiffens, and the more on the denser side of e_i.
  for (const HypoplasticParameters &parameters : {hochstetten(), fine_sand()})
  {
    const HypoplasticSand sand(parameters);
    for (const double to : {10e3, 1e6, 100e6})
    {
      const double from = 1e3;
      const Strain whole = bauer_compression(sand, from, to);
      const SandUpdate result = update(sand, isotropic(from, sand.limit_void_ratios(from).loosest), whole);
      REQUIRE(result.status == SandUpdateStatus::done);
      CHECK(-result.state.stress[0] == Approx(to).epsilon(1e-6 * result.n_substeps));
      CHECK(-result.state.stress[0] ==
            Approx(bauer_pressure(parameters, result.state.void_ratio)).epsilon(1e-6 * result.n_substeps));
      CHECK(result.state.void_ratio == Approx(sand.limit_void_ratios(to).loosest).epsilon(1e-12));
      for (int i = 1; i < 6; ++i)
        CHECK(result.state.stress[i] == (i < 3 ? result.state.stress[0] : 0));
    }
  }
}

TEST_CASE("Sand update: order three inside the limits", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  const SandState start{{-100e3, -150e3, -120e3, 10e3, -20e3, 5e3}, 0.75};
  const Strain whole{2e-3, 1e-3, -8e-3, 4e-3, 3e-3, -2e-3};
  const Stress expected = reference_update(hochstetten(), start, whole, 4000).stress;
  double last = 0;
  for (const int n : {8, 16, 32, 64})
  {
    SandState state = start;
    for (int k = 0; k < n; ++k)
    {
      const SandUpdate next = update(sand, state, scaled(1. / n, whole), {.tolerance = 1e9});
      REQUIRE(next.n_substeps == 1);
      state = next.state;
    }
    const double error = stress_norm(difference(state.stress, expected)) / stress_norm(expected);
    CAPTURE(n, error);
    if (last > 0)
    {
      CHECK(last / error > 7);
      CHECK(last / error < 9);
    }
    last = error;
  }
}

TEST_CASE("Sand update: the error keeps to its tolerance in one increment, at a price of its third root", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  const double from = 1e3, to = 10e6;
  const Strain whole = bauer_compression(sand, from, to);
  int last = 0;
  for (const double tolerance : {1e-4, 1e-7, 1e-10})
  {
    const SandUpdate result =
        update(sand, isotropic(from, sand.limit_void_ratios(from).loosest), whole, {.tolerance = tolerance});
    REQUIRE(result.status == SandUpdateStatus::done);
    const double error = std::abs(-result.state.stress[0] / to - 1);
    CAPTURE(tolerance, error, result.n_substeps, result.n_rejected);
    // What a substep leaves shrinks on the way, since compression contracts relative errors. Rounding at the least one.
    CHECK(error < result.n_substeps * tolerance + 1e-13 * result.n_substeps);
    CHECK(result.n_rejected < 0.1 * result.n_substeps + 10);
    if (last > 0)
    {
      CHECK(result.n_substeps > 8 * last);
      CHECK(result.n_substeps < 12 * last);
    }
    last = result.n_substeps;
  }
}

TEST_CASE("Sand update: increments in all directions come to what the equation's own integration comes to", "[fe]")
{
  Random random;
  double worst = 0, worst_parted = 0;
  for (const HypoplasticParameters &parameters : {hochstetten(), fine_sand()})
  {
    const HypoplasticSand sand(parameters);
    for (int trial = 0; trial < 200; ++trial)
    {
      SandState start = random.state(sand);
      // Inside all limits along the way: not near the ends of the void ratio, no unloading to nothing.
      const LimitVoidRatios limits = sand.limit_void_ratios(-mean_stress(start.stress));
      start.void_ratio = limits.densest + (limits.loosest - limits.densest) * (0.2 + 0.5 * random.unit());
      const double stiffness = sand.response(start).greatest_modulus();
      Strain increment = strain_components(random.symmetric());
      increment = scaled(0.2 * stress_norm(start.stress) / stiffness / strain_norm(increment), increment);
      const SandUpdate result = update(sand, start, increment, {.tolerance = 1e-7});
      REQUIRE(result.status == SandUpdateStatus::done);
      const SandState expected = reference_update(parameters, start, increment, 400);
      const double size = stress_norm(expected.stress);
      worst = std::max(worst, stress_norm(difference(result.state.stress, expected.stress)) / size /
                                  (result.n_substeps * 1e-7));
      REQUIRE(result.state.void_ratio == Approx(expected.void_ratio).epsilon(1e-12));

      // Half and half come to the whole.
      const SandUpdate half = update(sand, start, scaled(0.5, increment), {.tolerance = 1e-7});
      const SandUpdate other = update(sand, half.state, scaled(0.5, increment), {.tolerance = 1e-7});
      worst_parted = std::max(worst_parted, stress_norm(difference(other.state.stress, result.state.stress)) / size /
                                                ((result.n_substeps + half.n_substeps + other.n_substeps) * 1e-7));
    }
  }
  CHECK(worst < 1);
  CHECK(worst_parted < 1);
}

TEST_CASE("Sand update: a rotated problem has the rotated solution", "[fe]")
{
  Random random;
  const HypoplasticSand sand(hochstetten());
  for (int trial = 0; trial < 200; ++trial)
  {
    const SandState start = random.state(sand);
    const Tensor axes = random.rotation(), d = random.symmetric();
    const Strain increment = scaled(1e-3, strain_components(d));
    const SandState turned{components(Random::turned(axes, tensor(start.stress))), start.void_ratio};
    const SandUpdate plain = update(sand, start, increment);
    const SandUpdate other = update(sand, turned, scaled(1e-3, strain_components(Random::turned(axes, d))));
    REQUIRE(plain.status == SandUpdateStatus::done);
    REQUIRE(other.status == SandUpdateStatus::done);
    // Rounding moves the substeps a little, so they agree to the tolerance.
    const double size = std::max(stress_norm(plain.state.stress), std::numbers::sqrt3 * 100);
    REQUIRE(stress_norm(difference(other.state.stress, components(Random::turned(axes, tensor(plain.state.stress))))) <
            1e-6 * size * (plain.n_substeps + other.n_substeps));
  }
}

TEST_CASE("Sand update: extension takes the stress to nothing, and compression brings it back from there", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  SandUpdate result = update(sand, isotropic(10e3, 0.7), {1e-2, 1e-2, 1e-2, 0, 0, 0});
  REQUIRE(result.status == SandUpdateStatus::done);
  CHECK(stress_norm(result.state.stress) == 0);
  CHECK(result.state.void_ratio == Approx(1.7 * std::exp(0.03) - 1).epsilon(1e-14));

  // Up to the least pressure of 100 Pa the stiffness is constant but for what the void ratio changes. The strain is
  // some 1e-5 here, and the stiffness grows by less than ten times that.
  const double stiffness = -sand.response(result.state).rate({-1, -1, -1, 0, 0, 0})[0];
  const double increment = 0.5 / stiffness;
  result = update(sand, result.state, {-increment, -increment, -increment, 0, 0, 0});
  CHECK(result.state.stress[0] == Approx(-0.5).epsilon(2e-4));

  Random random;
  int n_cut = 0;
  for (int path = 0; path < 100; ++path)
  {
    SandState state = random.state(sand);
    for (int step = 0; step < 20; ++step)
    {
      Strain strain = strain_components(random.symmetric());
      for (int i = 0; i < 3; ++i)
        strain[i] += 0.3; // on the whole it opens
      result = update(sand, state, scaled(std::pow(10., -2 - 3 * random.unit()), strain));
      REQUIRE(result.status == SandUpdateStatus::done);
      state = result.state;
      Stress cut = state.stress;
      n_cut += stress_norm(state.stress) < 1;
      cut_tension(cut);
      REQUIRE(stress_norm(difference(cut, state.stress)) <= 1e-14 * stress_norm(state.stress));
    }
  }
  CHECK(n_cut > 100);
}

TEST_CASE("Sand update: what cannot be followed is said, and leaves the state as it was", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  const SandState start = isotropic(10e3, 0.7);
  const Strain small{1e-3, -2e-3, -1e-3, 0, 0, 0};
  const auto is_unchanged = [&](const SandUpdate &result)
  { return result.state.stress == start.stress && result.state.void_ratio == start.void_ratio; };

  for (const double bad : {double(NAN), double(HUGE_VAL)})
  {
    const Strain strain{1e-3, bad, 0, 0, 0, 0};
    const SandUpdate result = update(sand, start, strain);
    CHECK(result.status == SandUpdateStatus::substep_too_small);
    CHECK(is_unchanged(result));
  }
  const SandUpdate impossible = update(sand, start, small, {.tolerance = 1e-30});
  CHECK(impossible.status == SandUpdateStatus::substep_too_small);
  CHECK(is_unchanged(impossible));
  CHECK_THAT(explain(impossible.status, impossible.state),
             Catch::Contains("tolerance") && Catch::Contains("0.7") && Catch::Contains("-10000"));

  const Strain crush{-0.2, -0.2, -0.2, 0, 0, 0}; // 1.7 exp(-0.6) < 1
  const SandUpdate crushed = update(sand, start, crush);
  CHECK(crushed.status == SandUpdateStatus::no_voids);
  CHECK(is_unchanged(crushed));
  CHECK_THAT(explain(crushed.status, crushed.state), Catch::Contains("no voids"));

  const SandUpdate still = update(sand, start, {});
  CHECK(still.status == SandUpdateStatus::done);
  CHECK(is_unchanged(still));
}

TEST_CASE("Consistent tangent of sand: the derivative of the stress after an increment of any size", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  Random random;
  const auto stress_after = [&](const SandState &state, Strain increment, const Strain &direction, const double h)
  {
    for (int i = 0; i < 6; ++i)
      increment[i] += h * direction[i];
    const SandUpdate result = update(sand, state, increment, {.tolerance = 1e-11});
    REQUIRE(result.status == SandUpdateStatus::done);
    return result.state.stress;
  };
  for (const double size : {1e-5, 1e-4, 1e-3, 1e-2})
  {
    CAPTURE(size);
    double worst = 0, of_the_start = 0;
    for (int trial = 0; trial < 20; ++trial)
    {
      const SandState state = random.state(sand);
      Strain increment = strain_components(random.symmetric()), direction = strain_components(random.symmetric());
      const double length = strain_norm(increment), unit = strain_norm(direction);
      for (int i = 0; i < 6; ++i)
      {
        increment[i] *= size / length;
        direction[i] /= unit;
      }
      const Moduli moduli = consistent_tangent(sand, state, increment);
      const Moduli at_start = sand.response(state).tangent(increment);
      const double h = 1e-3 * size, modulus = sand.response(state).greatest_modulus();
      const Stress above = stress_after(state, increment, direction, h);
      const Stress below = stress_after(state, increment, direction, -h);
      Stress error, error_at_start;
      for (int i = 0; i < 6; ++i)
      {
        const double derivative = (above[i] - below[i]) / (2 * h);
        error[i] = error_at_start[i] = -derivative;
        for (int j = 0; j < 6; ++j)
        {
          error[i] += moduli[i][j] * direction[j];
          error_at_start[i] += at_start[i][j] * direction[j];
        }
      }
      worst = std::max(worst, stress_norm(error) / modulus);
      of_the_start = std::max(of_the_start, stress_norm(error_at_start) / modulus);
    }
    // Substeps whose stresses are true to 1e-6 leave some of that times the stress over the increment, which is a
    // hundredth of the modulus: 1e-3 at the least increment, and nothing of a larger one.
    CHECK(worst < 2e-4);
    if (size > 5e-4) // where the tangent at the start is no more of use
      CHECK(of_the_start > 100 * worst);
  }
  const SandState state{{-1e5, -2e5, -1.5e5, 1e4, 0, 2e4}, 0.7};
  CHECK(consistent_tangent(sand, state, Strain{}) == sand.response(state).tangent(Strain{}));
}
