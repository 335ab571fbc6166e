#include "fe_dealii/material/hypoplastic_integration.h"
#include "tests/unit/fe_sands.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace bergamo;
using namespace bergamo::fe;
using namespace bergamo::fe::sands;

namespace
{

struct TriaxialPoint
{
  SandState state;
  double axial;  // rate of strain of the last increment, scaled to |axial| = 1
  double volume; // likewise
  double ratio() const { return state.stress[2] / state.stress[0]; }
};

SandState carried(const HypoplasticSand &sand, const SandState &start, const Strain &increment)
{
  const SandUpdate result = update(sand, start, increment, {.tolerance = 1e-9});
  REQUIRE(result.status == SandUpdateStatus::done);
  return result.state;
}

/// Drained triaxial test from an isotropic state: axial strain along z, compressive below zero, lateral stress held by
/// a secant search.
/// @param strain logarithmic, of the whole path
std::vector<TriaxialPoint> drained_triaxial(const HypoplasticSand &sand, const double pressure, const double void_ratio,
                                            const double strain, const int n_steps)
{
  std::vector<TriaxialPoint> path;
  SandState state{{-pressure, -pressure, -pressure, 0, 0, 0}, void_ratio};
  const double axial = strain / n_steps;
  double share = -0.3; // of the axial strain in the lateral
  for (int step = 0; step < n_steps; ++step)
  {
    SandState next;
    const auto miss = [&](const double trial)
    {
      next = carried(sand, state, {trial * axial, trial * axial, axial, 0, 0, 0});
      return next.stress[0] + pressure;
    };
    double before = share, miss_before = miss(before), now = share + 1e-4, miss_now = miss(now);
    for (int search = 0; search < 30 && std::abs(miss_now) > 1e-9 * pressure; ++search)
    {
      const double better = now - miss_now * (now - before) / (miss_now - miss_before);
      before = now;
      miss_before = miss_now;
      now = better;
      miss_now = miss(now);
    }
    REQUIRE(std::abs(miss_now) <= 1e-9 * pressure);
    share = now;
    state = next;
    path.push_back({state, axial / std::abs(axial), (1 + 2 * share) * axial / std::abs(axial)});
  }
  return path;
}

double friction_ratio(const HypoplasticParameters &p)
{
  const double sine = std::sin(p.critical_friction_angle * std::numbers::pi / 180);
  return (1 + sine) / (1 - sine);
}

const TriaxialPoint &peak_of(const std::vector<TriaxialPoint> &path)
{
  return *std::max_element(path.begin(), path.end(),
                           [](const auto &a, const auto &b) { return a.ratio() < b.ratio(); });
}

/// −f_d L⁻¹N, the strain rate at which a stress stays, by Sherman and Morrison: ‖·‖ = 1 where there is one.
Tensor staying_flow(const HypoplasticParameters &p, const SandState &state, const LimitVoidRatios &limits)
{
  const Directions at = directions(p, tensor(state.stress));
  const double f_d =
      std::pow((state.void_ratio - limits.densest) / (limits.critical - limits.densest), p.pyknotropy_exponent);
  const double f_square = at.f * at.f, a_square = at.a * at.a;
  Tensor flow;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      flow[i][j] = f_d * at.a * at.f * (at.ratio[i][j] + at.deviator[i][j]);
  const double along = a_square * product(at.ratio, flow) / (f_square + a_square * product(at.ratio, at.ratio));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      flow[i][j] = -(flow[i][j] - along * at.ratio[i][j]) / f_square;
  return flow;
}

} // namespace

TEST_CASE("Triaxial sand: dense and loose come to the same critical state, in compression and extension", "[fe]")
{
  const double pressure = 100e3;
  for (const HypoplasticParameters &parameters : {hochstetten(), fine_sand()})
  {
    const HypoplasticSand sand(parameters);
    const LimitVoidRatios limits = sand.limit_void_ratios(pressure);
    const double critical_ratio = friction_ratio(parameters);
    // What is left of a difference in density falls about as exp(−2 |ε|): a strain of 5 leaves less than a thousandth.
    for (const double strain : {-5., 5.})
    {
      CAPTURE(parameters.critical_friction_angle, strain);
      for (const double share : {0.25, 0.95})
      {
        const double start = limits.densest + share * (limits.loosest - limits.densest);
        const auto path = drained_triaxial(sand, pressure, start, strain, 5000);
        const TriaxialPoint &end = path.back();
        const double ratio = strain < 0 ? end.ratio() : 1 / end.ratio();
        CHECK(ratio == Approx(critical_ratio).epsilon(1e-3));
        const double critical = sand.limit_void_ratios(-mean_stress(end.state.stress)).critical;
        CHECK(end.state.void_ratio == Approx(critical).epsilon(1e-3));
        CHECK(std::abs(end.volume) < 1e-3);
      }
    }
  }
}

TEST_CASE("Triaxial sand: dense sand has a peak and dilates there as the equation's limit says, loose sand has none",
          "[fe]")
{
  const double pressure = 100e3;
  for (const HypoplasticParameters &parameters : {hochstetten(), fine_sand()})
  {
    const HypoplasticSand sand(parameters);
    const LimitVoidRatios limits = sand.limit_void_ratios(pressure);
    const double critical_ratio = friction_ratio(parameters);
    double last_peak = 1e9;
    for (const double share : {0.1, 0.3, 0.5})
    {
      const double start = limits.densest + share * (limits.critical - limits.densest);
      const auto path = drained_triaxial(sand, pressure, start, -0.3, 3000);
      const TriaxialPoint &peak = peak_of(path);
      CAPTURE(share, peak.ratio());
      CHECK(peak.ratio() > 1.05 * critical_ratio);
      CHECK(peak.ratio() < last_peak); // pyknotropy
      last_peak = peak.ratio();
      CHECK(path.front().volume < 0);
      CHECK(peak.volume > 0.1);
      CHECK(peak.ratio() > path.back().ratio());

      // At the peak the stress stays for a moment. The path's greatest point lies within a step of it, where the ratio
      // is flat: what differs is of the order of the step, 1e-4, times the rate of the void ratio over that of f_d.
      const LimitVoidRatios there = sand.limit_void_ratios(-mean_stress(peak.state.stress));
      const Tensor flow = staying_flow(parameters, peak.state, there);
      CHECK(std::sqrt(product(flow, flow)) == Approx(1).margin(2e-3));
      CHECK(trace(flow) / -flow[2][2] == Approx(peak.volume).margin(5e-3));
    }
    const auto loose = drained_triaxial(sand, pressure, 0.98 * limits.loosest, -0.3, 3000);
    CHECK(peak_of(loose).ratio() < critical_ratio);
    CHECK(peak_of(loose).ratio() > 0.9 * critical_ratio);
    double last_ratio = 1;
    for (const TriaxialPoint &point : loose)
    {
      REQUIRE(point.ratio() > last_ratio);
      REQUIRE(point.volume < 0);
      last_ratio = point.ratio();
    }
  }
}

TEST_CASE("Triaxial sand: pressure takes off peak and dilation at the same void ratio", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  double last_peak = 1e9, last_dilation = 1e9;
  for (const double pressure : {50e3, 200e3, 1e6, 5e6})
  {
    const auto path = drained_triaxial(sand, pressure, 0.6, -0.3, 3000);
    const TriaxialPoint &peak = peak_of(path);
    CHECK(peak.ratio() < last_peak);
    CHECK(peak.volume < last_dilation);
    last_peak = peak.ratio();
    last_dilation = peak.volume;
  }
  CHECK(last_peak > friction_ratio(hochstetten())); // e_c at the last is 0.63
}

TEST_CASE("Oedometric sand: the stress forgets its start and rises in proportion", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  SandState even{{-20e3, -20e3, -20e3, 0, 0, 0}, 0.75}, uneven{{-40e3, -15e3, -12e3, 5e3, 0, 0}, 0.75};
  const auto apart = [&]
  {
    Stress difference;
    for (int i = 0; i < 6; ++i)
      difference[i] = even.stress[i] / mean_stress(even.stress) - uneven.stress[i] / mean_stress(uneven.stress);
    return stress_norm(difference);
  };
  const double first = apart();
  for (int step = 0; step < 100; ++step)
  {
    even = carried(sand, even, {0, 0, -1e-3, 0, 0, 0});
    uneven = carried(sand, uneven, {0, 0, -1e-3, 0, 0, 0});
    REQUIRE(even.stress[0] == Approx(even.stress[1]).epsilon(1e-12));
  }
  CHECK(apart() < 0.01 * first);
  const double at_rest = even.stress[0] / even.stress[2];
  even = carried(sand, even, {0, 0, -1e-2, 0, 0, 0});
  CHECK(even.stress[0] / even.stress[2] == Approx(at_rest).epsilon(0.02));
}
