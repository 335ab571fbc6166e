#include "dem/core/error.h"
#include "fe_dealii/material/mohr_coulomb.h"
#include "fe_dealii/material/principal.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::fe;

namespace
{

using Triple = std::array<double, 3>; // principal values

constexpr double degree = std::numbers::pi / 180;

double norm(const std::array<double, 6> &x)
{
  double sum = 0;
  for (int i = 0; i < 6; ++i)
    sum += (i < 3 ? 1 : 2) * x[i] * x[i];
  return std::sqrt(sum);
}

// Random orthonormal frame: the eigenvectors of a random symmetric matrix.
PrincipalFrame<double> random_frame(std::mt19937_64 &random)
{
  std::normal_distribution<double> normal;
  Stress s;
  for (double &x : s)
    x = normal(random);
  return principal_frame(s);
}

Stress turn(const Triple &value, const PrincipalFrame<double> &frame)
{
  const double v[3] = {value[0], value[1], value[2]};
  return from_principal(v, frame.direction);
}

Strain engineering(Stress tensor)
{
  for (int i = 3; i < 6; ++i)
    tensor[i] *= 2;
  return tensor;
}

MohrCoulombParameters random_parameters(std::mt19937_64 &random)
{
  std::uniform_real_distribution<double> unit(0, 1);
  MohrCoulombParameters p;
  p.young_modulus = std::pow(10., 6 + 3 * unit(random));
  p.poisson_ratio = 0.48 * unit(random);
  p.friction_angle = 1 + 50 * unit(random);
  // Flow without dilation, associative flow, all between, and contraction up to two fifths of the elastic limit.
  const double choice = unit(random), bulk_over_shear = 2 * (1 + p.poisson_ratio) / 3 / (1 - 2 * p.poisson_ratio);
  const double contraction = 0.4 / std::sin(p.friction_angle * degree) / (bulk_over_shear + 1. / 3);
  p.dilation_angle = choice < 0.2   ? 0
                     : choice < 0.4 ? p.friction_angle
                     : choice < 0.8
                         ? p.friction_angle * unit(random)
                         : -unit(random) * std::min(p.friction_angle, std::asin(std::min(1., contraction)) / degree);
  p.cohesion = unit(random) < 0.2 ? 0 : 1000 * unit(random);
  return p;
}

// Reference, written apart from the program: plane k is Φ_k(σ) = n_k·σ − 2 c cos φ with flow m_k. Planes 0 (σ1, σ3),
// 1 (σ1, σ2), 2 (σ2, σ3) matter for sorted stresses.
struct Reference
{
  double f, s, cc, K, G;

  explicit Reference(const MohrCoulombParameters &p)
      : f(std::sin(p.friction_angle * degree)), s(std::sin(p.dilation_angle * degree)),
        cc(2 * p.cohesion * std::cos(p.friction_angle * degree)), K(p.young_modulus / 3 / (1 - 2 * p.poisson_ratio)),
        G(p.young_modulus / 2 / (1 + p.poisson_ratio))
  {
  }

  static Triple direction(const int plane, const double sine)
  {
    const double a = 1 + sine, b = -1 + sine;
    return plane == 0 ? Triple{a, 0, b} : plane == 1 ? Triple{a, b, 0} : Triple{0, a, b};
  }
  Triple stiff(const Triple &x) const
  {
    const double mean = (x[0] + x[1] + x[2]) / 3;
    Triple y;
    for (int i = 0; i < 3; ++i)
      y[i] = 2 * G * (x[i] - mean) + 3 * K * mean;
    return y;
  }
  static double dot(const Triple &a, const Triple &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  double yield(const int plane, const Triple &x) const { return dot(direction(plane, f), x) - cc; }

  struct Candidate
  {
    Sector sector;
    Triple stress;
  };

  // All sectors whose multipliers are not negative and whose stress is admissible (all six planes).
  std::vector<Candidate> admissible(const Triple &trial, const double slack) const
  {
    std::vector<Candidate> found;
    const auto inside = [&](Triple x)
    {
      std::sort(x.begin(), x.end(), std::greater<>());
      return yield(0, x) <= slack;
    };
    if (yield(0, trial) <= 0)
      found.push_back({Sector::elastic, trial});
    const auto matrix = [&](const int i, const int j) { return dot(direction(i, f), stiff(direction(j, s))); };
    if (const double m = yield(0, trial) / matrix(0, 0); m >= 0)
    {
      Triple x = trial;
      for (int i = 0; i < 3; ++i)
        x[i] -= m * stiff(direction(0, s))[i];
      if (inside(x))
        found.push_back({Sector::main_plane, x});
    }
    for (const int other : {1, 2})
    {
      const double a = matrix(0, 0), b = matrix(0, other), c = matrix(other, 0), d = matrix(other, other);
      const double p = yield(0, trial), q = yield(other, trial), determinant = a * d - b * c;
      const double m = (d * p - b * q) / determinant, n = (a * q - c * p) / determinant;
      if (m < 0 || n < 0)
        continue;
      Triple x = trial;
      for (int i = 0; i < 3; ++i)
        x[i] -= m * stiff(direction(0, s))[i] + n * stiff(direction(other, s))[i];
      if (inside(x))
        found.push_back({other == 1 ? Sector::right_edge : Sector::left_edge, x});
    }
    // Apex: the plastic strain lies in the cone of the flow directions. By the cone's threefold mirror symmetry, a
    // sorted strain lies inside if it is inside the two facets that meet in the main plane's flow.
    const double apex = cc / 2 / f;
    Triple e;
    const double mean = (trial[0] + trial[1] + trial[2]) / 3;
    for (int i = 0; i < 3; ++i)
      e[i] = (trial[i] - mean) / 2 / G + (mean - apex) / 3 / K;
    const auto inward = [&](const int other)
    {
      const Triple u = direction(0, s), v = direction(other, s);
      Triple n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      if (n[0] + n[1] + n[2] < 0)
        n = {-n[0], -n[1], -n[2]};
      return dot(n, e) >= 0;
    };
    if (s > 0 && inward(1) && inward(2))
      found.push_back({Sector::apex, {apex, apex, apex}});
    return found;
  }

  // Nearest admissible stress in the energy norm by Dykstra's alternating projections onto the six half spaces.
  Triple project(const Triple &trial) const
  {
    const auto compliant_norm = [&](const Triple &n) { return dot(n, stiff(n)); };
    Triple x = trial;
    std::array<Triple, 6> correction{};
    for (int sweep = 0; sweep < 200000; ++sweep)
    {
      double moved = 0;
      for (int k = 0; k < 6; ++k)
      {
        Triple n{};
        const int pairs[6][2] = {{0, 2}, {0, 1}, {1, 2}, {2, 0}, {1, 0}, {2, 1}};
        n[pairs[k][0]] = 1 + f;
        n[pairs[k][1]] = -1 + f;
        Triple y;
        for (int i = 0; i < 3; ++i)
          y[i] = x[i] + correction[k][i];
        const double excess = std::max(0., dot(n, y) - cc) / compliant_norm(n);
        for (int i = 0; i < 3; ++i)
        {
          const double fresh = y[i] - excess * stiff(n)[i];
          correction[k][i] = y[i] - fresh;
          moved = std::max(moved, std::abs(fresh - x[i]));
          x[i] = fresh;
        }
      }
      if (moved < 1e-13 * (std::abs(trial[0]) + std::abs(trial[2]) + cc))
        break;
    }
    return x;
  }
};

} // namespace

TEST_CASE("Principal frame: values, orthonormality and rebuilding, also for nearly equal values", "[fe]")
{
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 3000; ++trial)
  {
    const double gap = std::pow(10., -(trial % 18));
    const double scale = std::pow(10., trial % 13 - 3);
    const Triple value{scale * (1 + gap * normal(random)), scale, scale * (1 + gap * normal(random))};
    const Stress stress = turn(value, random_frame(random));
    const auto frame = principal_frame(stress);
    REQUIRE(frame.value[0] >= frame.value[1]);
    REQUIRE(frame.value[1] >= frame.value[2]);
    Triple sorted = value;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    for (int k = 0; k < 3; ++k)
      REQUIRE(std::abs(frame.value[k] - sorted[k]) < 1e-14 * norm(stress));
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
      {
        double product = 0;
        for (int i = 0; i < 3; ++i)
          product += frame.direction[k][i] * frame.direction[l][i];
        REQUIRE(std::abs(product - (k == l)) < 1e-14);
      }
    Stress rebuilt = from_principal(frame.value, frame.direction);
    for (int i = 0; i < 6; ++i)
      rebuilt[i] -= stress[i];
    REQUIRE(norm(rebuilt) < 3e-15 * norm(stress));
  }
}

TEST_CASE("Principal frame: a pack gives what single stresses give", "[fe]")
{
  using Pack = bergamo::Lanes<8>;
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  Pack stress[6];
  for (int i = 0; i < 6; ++i)
    for (int lane = 0; lane < 8; ++lane)
      stress[i][lane] = lane == 3 && i > 2 ? 0 : normal(random);
  const PrincipalFrame<Pack> frames = principal_frame<Pack>(stress);
  for (int lane = 0; lane < 8; ++lane)
  {
    const auto frame = principal_frame(
        Stress{stress[0][lane], stress[1][lane], stress[2][lane], stress[3][lane], stress[4][lane], stress[5][lane]});
    for (int k = 0; k < 3; ++k)
      CHECK(frames.value[k][lane] == Approx(frame.value[k]).epsilon(1e-14).margin(1e-14));
  }
}

TEST_CASE("Mohr-Coulomb: 10 000 random strain steps end on or inside the yield surface and dissipate", "[fe]")
{
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::array<int, 5> visits{};
  double worst = 0;
  for (int path = 0; path < 200; ++path)
  {
    const MohrCoulombParameters p = random_parameters(random);
    const MohrCoulomb material(p);
    const double pressure = std::pow(10., 2 + 4 * std::uniform_real_distribution<double>(0, 1)(random));
    Stress stress{-pressure, -pressure, -pressure, 0, 0, 0};
    for (int step = 0; step < 50; ++step)
    {
      const double size = pressure / p.young_modulus * std::pow(10., step % 7 - 3); // from tiny to a thousandfold
      Strain increment;
      for (double &x : increment)
        x = size * normal(random);
      const StressUpdate update = material.update(stress, increment);
      ++visits[int(update.sector)];

      const double scale = norm(update.stress) + p.cohesion;
      const double excess = material.yield_function(update.stress);
      REQUIRE(excess <= 1e-10 * scale); // without cohesion, the apex has neither
      worst = std::max(worst, scale > 0 ? excess / scale : 0);
      // Elastic and plastic parts add up to the increment.
      const Strain before = material.elastic_strain(stress), after = material.elastic_strain(update.stress);
      for (int i = 0; i < 6; ++i)
        REQUIRE(after[i] - before[i] + update.plastic_strain[i] ==
                Approx(increment[i]).margin(1e-12 * (norm(increment) + norm(before) + norm(after))));
      // The new stress dissipates on the way to it (c >= 0, ψ <= φ), but for a contraction under tension, which only
      // cohesion allows: up to c cot φ sin ψ per unit of flow. Rounding scales with the trial stress.
      Stress trial = material.elastic_stress(increment);
      for (int i = 0; i < 6; ++i)
        trial[i] += stress[i];
      if (p.dilation_angle >= 0 || mean_stress(update.stress) <= 0)
        REQUIRE(energy_density(update.stress, update.plastic_strain) >=
                -1e-13 * norm(trial) * norm(material.elastic_strain(trial)));
      Stress middle;
      for (int i = 0; i < 6; ++i)
        middle[i] = 0.5 * (stress[i] + update.stress[i]);
      REQUIRE(update.plastic_dissipation == Approx(energy_density(middle, update.plastic_strain))
                                                .margin(1e-14 * norm(middle) * norm(update.plastic_strain)));
      stress = update.stress;
    }
  }
  CHECK(worst < 1e-13);
  for (const int n : visits)
    CHECK(n > 100); // every sector was tried
}

TEST_CASE("Mohr-Coulomb: the sector is the only admissible one with positive multipliers", "[fe]")
{
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  std::array<int, 5> visits{};
  int without_any = 0;
  for (int trial_number = 0; trial_number < 20000; ++trial_number)
  {
    const MohrCoulombParameters p = random_parameters(random);
    const MohrCoulomb material(p);
    const Reference reference(p);
    const double size = std::pow(10., 2 + 4 * unit(random)), shift = size * (4 * unit(random) - 2.5);
    Triple trial;
    for (double &x : trial)
      x = size * normal(random) + shift;
    std::sort(trial.begin(), trial.end(), std::greater<>());
    const auto frame = random_frame(random);
    const Stress trial_stress = turn(trial, frame);
    const StressUpdate update = material.return_to_surface({}, trial_stress, principal_frame(trial_stress));
    ++visits[int(update.sector)];

    const double scale = std::abs(trial[0]) + std::abs(trial[2]) + p.cohesion;
    const auto candidates = reference.admissible(trial, 1e-12 * scale);
    if (candidates.empty())
    {
      // Only flow without dilation leaves a gap: beyond the apex no multiplier lowers the mean stress.
      ++without_any;
      REQUIRE(p.dilation_angle <= 0);
      REQUIRE(update.sector == Sector::apex);
      continue;
    }
    const auto same = std::find_if(candidates.begin(), candidates.end(),
                                   [&](const auto &candidate) { return candidate.sector == update.sector; });
    INFO("sector " << int(update.sector) << " of " << candidates.size() << " candidates, first "
                   << int(candidates[0].sector) << ", phi " << p.friction_angle << " psi " << p.dilation_angle);
    REQUIRE(same != candidates.end());
    const Stress expected = turn(same->stress, frame);
    for (int i = 0; i < 6; ++i)
      REQUIRE(update.stress[i] == Approx(expected[i]).margin(1e-11 * scale));
    REQUIRE(candidates.size() == 1);
  }
  CHECK(without_any > 50);
  for (const int n : visits)
    CHECK(n > 500);
}

TEST_CASE("Mohr-Coulomb: associative flow returns to the nearest point in the energy norm", "[fe]")
{
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial_number = 0; trial_number < 300; ++trial_number)
  {
    MohrCoulombParameters p = random_parameters(random);
    p.friction_angle = std::max(p.friction_angle, 10.); // slender cones make alternating projections crawl
    p.dilation_angle = p.friction_angle;
    const MohrCoulomb material(p);
    const Reference reference(p);
    Triple trial;
    const double shift = 4 * unit(random) - 2.5;
    for (double &x : trial)
      x = 1e4 * (normal(random) + shift);
    std::sort(trial.begin(), trial.end(), std::greater<>());
    const Stress trial_stress{trial[0], trial[1], trial[2], 0, 0, 0};
    const StressUpdate update = material.return_to_surface({}, trial_stress, principal_frame(trial_stress));
    const Triple nearest = reference.project(trial);
    for (int i = 0; i < 3; ++i)
      REQUIRE(update.stress[i] ==
              Approx(nearest[i]).margin(1e-7 * (std::abs(trial[0]) + std::abs(trial[2]) + p.cohesion)));
  }
}

TEST_CASE("Mohr-Coulomb: turning the input turns the output", "[fe]")
{
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  for (int trial_number = 0; trial_number < 1000; ++trial_number)
  {
    const MohrCoulomb material(random_parameters(random));
    const auto frame = random_frame(random); // the rotation; rows are the turned axes
    const auto rotate = [&](const std::array<double, 6> &t)
    {
      const double m[3][3] = {{t[0], t[3], t[5]}, {t[3], t[1], t[4]}, {t[5], t[4], t[2]}};
      double r[3][3] = {};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
              r[i][j] += frame.direction[i][k] * m[k][l] * frame.direction[j][l];
      return Stress{r[0][0], r[1][1], r[2][2], r[0][1], r[1][2], r[2][0]};
    };
    Stress strain, seed;
    for (double &x : strain)
      x = 1e-3 * normal(random);
    for (double &x : seed)
      x = 1e-3 * normal(random);
    const Stress stress = material.update({}, engineering(seed)).stress;
    const Stress a = rotate(material.update(stress, engineering(strain)).stress);
    const Stress b = material.update(rotate(stress), engineering(rotate(strain))).stress;
    const double scale = norm(stress) + norm(material.elastic_stress(engineering(strain)));
    for (int i = 0; i < 6; ++i)
      REQUIRE(a[i] == Approx(b[i]).margin(1e-12 * scale));
  }
}

TEST_CASE("Mohr-Coulomb: the return is continuous across the limits of the sectors", "[fe]")
{
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  int crossings = 0;
  for (int trial_number = 0; trial_number < 500; ++trial_number)
  {
    MohrCoulombParameters p = random_parameters(random);
    p.dilation_angle = std::max(p.dilation_angle, 0.2 * p.friction_angle); // without dilation the apex is a jump
    const MohrCoulomb material(p);
    const auto returned = [&](const Triple &x)
    {
      const Stress s{x[0], x[1], x[2], 0, 0, 0};
      return material.return_to_surface({}, s, principal_frame(s));
    };
    Triple from, to;
    const double shift = 4 * unit(random) - 2.5;
    for (int i = 0; i < 3; ++i)
    {
      from[i] = 1e4 * (normal(random) + shift);
      to[i] = 1e4 * (normal(random) + shift);
    }
    const auto at = [&](const double t) {
      return Triple{from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]), from[2] + t * (to[2] - from[2])};
    };
    for (int piece = 0; piece < 20; ++piece)
    {
      double a = piece / 20., b = (piece + 1) / 20.;
      const Sector sector = returned(at(a)).sector;
      if (returned(at(b)).sector == sector)
        continue;
      while (b - a > 1e-13) // the first limit of the piece, closed in on from both sides
      {
        const double middle = 0.5 * (a + b);
        (returned(at(middle)).sector == sector ? a : b) = middle;
      }
      ++crossings;
      const Stress x = returned(at(a)).stress, y = returned(at(b)).stress;
      for (int i = 0; i < 3; ++i)
        REQUIRE(x[i] == Approx(y[i]).margin(1e-5)); // of 1e4 Pa; the trial stresses lie 1e-9 Pa apart
    }
  }
  CHECK(crossings > 500);
}

TEST_CASE("Mohr-Coulomb: the cheap elastic test never calls a yielding stress elastic and spares most of the others",
          "[fe]")
{
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  const MohrCoulomb material{MohrCoulombParameters{}};
  int elastic = 0, spared = 0;
  for (int trial_number = 0; trial_number < 20000; ++trial_number)
  {
    Stress stress;
    for (int i = 0; i < 6; ++i)
      stress[i] = 1e4 * (0.3 * normal(random) - (i < 3));
    const bool surely = material.is_surely_elastic(mean_stress(stress), second_invariant(stress));
    const bool inside = material.yield_function(stress) <= 0;
    if (surely)
      REQUIRE(inside);
    elastic += inside;
    spared += surely;
  }
  CHECK(spared > 0.6 * elastic);
}

TEST_CASE("Mohr-Coulomb: a NaN stays visible", "[fe]")
{
  const MohrCoulomb material{MohrCoulombParameters{}};
  const StressUpdate update = material.update({-1e3, -1e3, -1e3, 0, 0, 0}, {NAN, 0, 0, 0, 0, 0});
  CHECK(std::isnan(update.stress[0]));
}

TEST_CASE("Mohr-Coulomb: bad parameters are named", "[fe]")
{
  using Catch::Matchers::Contains;
  const auto rejected = [](auto change, const char *name)
  {
    MohrCoulombParameters p;
    change(p);
    CHECK_THROWS_AS(p.validate(), ConfigError);
    CHECK_THROWS_WITH(MohrCoulomb(p), Contains(name));
  };
  CHECK_NOTHROW(MohrCoulombParameters{}.validate());
  rejected([](auto &p) { p.young_modulus = 0; }, "young_modulus");
  rejected([](auto &p) { p.young_modulus = NAN; }, "young_modulus");
  rejected([](auto &p) { p.poisson_ratio = 0.5; }, "poisson_ratio");
  rejected([](auto &p) { p.poisson_ratio = -0.1; }, "poisson_ratio");
  rejected([](auto &p) { p.friction_angle = 90; }, "friction_angle");
  rejected([](auto &p) { p.dilation_angle = 30; }, "dilation_angle");
  rejected([](auto &p) { p.dilation_angle = -90; }, "dilation_angle");
  rejected([](auto &p) { p.poisson_ratio = 0.49, p.dilation_angle = -10; }, "less contraction");
  CHECK(MohrCoulombParameters{}.least_dilation_angle() < -60); // K over G is 1.08
  rejected([](auto &p) { p.cohesion = -1; }, "cohesion");
  rejected([](auto &p) { p.cohesion = p.friction_angle = p.dilation_angle = 0; }, "cohesion");
  rejected([](auto &p) { p.density = 0; }, "density");
}

TEST_CASE("Mohr-Coulomb: a stiffness that grows with the pressure", "[fe]")
{
  MohrCoulombParameters p;
  p.cohesion = 1e9; // elastic
  p.reference_pressure = 1e5;
  for (const double exponent : {0., 1. / 3, 0.5, 1.})
  {
    p.stiffness_exponent = exponent;
    const MohrCoulomb sand(p);
    CHECK(sand.stiffness_factor(-1e5) == Approx(1));
    CHECK(sand.stiffness_factor(-4e5) == Approx(std::pow(4, exponent)));
    CHECK(sand.stiffness_factor(50.) == Approx(std::pow(0.01, exponent))); // no softer than at a hundredth
    // Isotropic compression from 50 to 200 kPa: dp = K (p/p_r)^m de, so e = p_r/K [x^(1-m)/(1-m)] over x = p/p_r. Steps
    // with the stiffness of their start are of first order.
    const double exact =
        exponent == 1 ? std::log(4.) : (std::pow(2, 1 - exponent) - std::pow(0.5, 1 - exponent)) / (1 - exponent);
    double error[2];
    for (int k = 0; k < 2; ++k)
    {
      const int n = 1000 << k;
      const double de = 1e5 / sand.bulk_modulus() * exact / n;
      Stress stress{-5e4, -5e4, -5e4, 0, 0, 0};
      for (int i = 0; i < n; ++i)
        stress = sand.update(stress, {-de / 3, -de / 3, -de / 3, 0, 0, 0}).stress;
      error[k] = std::abs(stress[0] / -2e5 - 1);
    }
    CHECK(error[1] < 1e-3);
    if (exponent > 0)
      CHECK(error[0] / error[1] == Approx(2).epsilon(0.02));
  }

  // On the yield surface the stress does not depend on the stiffness, the plastic strain inversely so.
  p.cohesion = 15;
  p.stiffness_exponent = 0.5;
  const MohrCoulomb varies(p);
  p.reference_pressure = 0;
  const MohrCoulomb constant(p);
  const Stress old{-2e5, -2e5, -2e5, 0, 0, 0};
  const double factor = varies.stiffness_factor(-2e5);
  const Strain strain{1e-3, 8e-4, -6e-3, 4e-4, 0, -3e-4};
  Strain stronger;
  for (int i = 0; i < 6; ++i)
    stronger[i] = factor * strain[i];
  const StressUpdate a = varies.update(old, strain), b = constant.update(old, stronger);
  REQUIRE(a.sector != Sector::elastic);
  for (int i = 0; i < 6; ++i)
  {
    CHECK(a.stress[i] == Approx(b.stress[i]));
    CHECK(factor * a.plastic_strain[i] == Approx(b.plastic_strain[i]));
  }
  CHECK(factor * a.plastic_dissipation == Approx(b.plastic_dissipation));

  using Catch::Matchers::Contains;
  p.reference_pressure = -1;
  CHECK_THROWS_WITH(MohrCoulomb(p), Contains("reference_pressure [Pa] = -1"));
  p.reference_pressure = 1;
  p.stiffness_exponent = 2;
  CHECK_THROWS_WITH(MohrCoulomb(p), Contains("stiffness_exponent = 2"));
}
