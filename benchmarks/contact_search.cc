// Time of one contact search, by angularity class of the dissertation (Wellmann, fig. 3.11): cold from the centre line,
// and warm from the normal of a configuration nearby. Prints one table; --benchmark_format=json writes JSON.

#include "dem/geometry/common_normal.h"
#include "dem/packing/distribution.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

namespace
{

using namespace bergamo;
using namespace bergamo::dem;

struct TouchingPair
{
  BodyPose body1, body2;
  Vec3 guess; ///< normal some 1e-4 rad away
};

/// Pairs made backwards from a random normal and a small overlap: half-axes in (0.5, 3), exponents within `spread`
/// of 1.
std::vector<TouchingPair> make_pairs(const double spread)
{
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform(0., 1.);
  const auto grain = [&]
  {
    Superquadric s;
    for (double &r : s.half_axes)
      r = 0.5 + 2.5 * uniform(generator);
    s.eps1 = 1. + spread * (2. * uniform(generator) - 1.);
    s.eps2 = 1. + spread * (2. * uniform(generator) - 1.);
    return s;
  };
  std::vector<TouchingPair> pairs;
  for (int i = 0; i < 1000; ++i)
  {
    TouchingPair pair{make_pose(grain(), Vec3::Zero(), Quaternion::Identity()),
                      make_pose(grain(), Vec3::Zero(), draw_orientation(generator)), Vec3::Zero()};
    const double z = 2. * uniform(generator) - 1., angle = 2. * std::numbers::pi * uniform(generator);
    const Vec3 c(std::sqrt(1. - z * z) * std::cos(angle), std::sqrt(1. - z * z) * std::sin(angle), z);
    const double overlap = 1.75e-3 * uniform(generator);
    pair.body2.position = support(pair.body1, c).arm - support(pair.body2, -c).arm - overlap * c;
    pair.guess = (c + 1e-4 * Vec3(uniform(generator), uniform(generator), uniform(generator))).normalized();
    pairs.push_back(pair);
  }
  return pairs;
}

void cold(benchmark::State &state)
{
  const auto pairs = make_pairs(0.1 * state.range(0));
  std::size_t i = 0;
  double evaluations = 0.;
  for (auto _ : state)
  {
    const ContactGeometry g = find_contact(pairs[i % pairs.size()].body1, pairs[i % pairs.size()].body2);
    evaluations += g.n_evaluations;
    ++i;
  }
  state.counters["evaluations"] = evaluations / i;
}

void warm(benchmark::State &state)
{
  const auto pairs = make_pairs(0.1 * state.range(0));
  std::size_t i = 0;
  double evaluations = 0.;
  for (auto _ : state)
  {
    const TouchingPair &pair = pairs[i++ % pairs.size()];
    evaluations += update_contact(pair.body1, pair.body2, pair.guess).n_evaluations;
  }
  state.counters["evaluations"] = evaluations / i;
}

BENCHMARK(cold)->ArgName("spread_tenths")->Arg(0)->Arg(3)->Arg(7);
BENCHMARK(warm)->ArgName("spread_tenths")->Arg(0)->Arg(3)->Arg(7);

} // namespace

BENCHMARK_MAIN();
