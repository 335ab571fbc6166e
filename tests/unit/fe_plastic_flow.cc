// The return in packs, by dyads and masks, against the scalar one of fe_mohr_coulomb.cc, by Jacobi's frames.
#include "fe_dealii/element/stress_update.h"
#include "fe_dealii/material/plastic_flow.h"
#include "fe_dealii/material/principal.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace bergamo;
using namespace bergamo::fe;

namespace
{

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double norm(const std::array<double, 6> &x)
{
  return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + 2 * (x[3] * x[3] + x[4] * x[4] + x[5] * x[5]));
}

double distance(const std::array<double, 6> &x, const std::array<double, 6> &y)
{
  std::array<double, 6> gap;
  for (int i = 0; i < 6; ++i)
    gap[i] = x[i] - y[i];
  return norm(gap);
}

class Random
{
public:
  double normal() { return normal_(generator); }
  double unit() { return unit_(generator); }

  Stress symmetric()
  {
    Stress s;
    for (double &x : s)
      x = normal();
    return s;
  }

  /// A stress of these principal values in a random frame.
  Stress turned(const std::array<double, 3> &value)
  {
    const double v[3] = {value[0], value[1], value[2]};
    return from_principal(v, principal_frame(symmetric()).direction);
  }

private:
  std::mt19937_64 generator{7};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> unit_;
};

/// Principal values of all kinds: three apart, two that agree to any number of digits or in all, three alike.
std::array<double, 3> principal_values(Random &random, const int kind)
{
  const double a = random.normal(), b = random.normal();
  switch (kind % 6)
  {
  case 0:
    return {a, a, b};
  case 1:
    return {a, a, a};
  case 2:
    return {a, a * (1 + std::pow(10., -17 * random.unit())), b};
  case 3:
    return {a, 0, 0};
  default:
    return {a, b, random.normal()};
  }
}

template <class Real>
void set_lane(const Stress &stress, const int lane, Real (&packs)[6])
{
  for (int i = 0; i < 6; ++i)
    packs[i][lane] = stress[i];
}
template <class Real>
Stress lane_of(const Real (&packs)[6], const int lane)
{
  return {packs[0][lane], packs[1][lane], packs[2][lane], packs[3][lane], packs[4][lane], packs[5][lane]};
}

struct NamedLaw
{
  std::string name;
  MohrCoulombParameters parameters;
};

std::vector<NamedLaw> laws()
{
  const double young = 60e6, poisson = 0.3;
  return {{"sand", {young, poisson, 30, 8, 500}},
          {"associated", {young, poisson, 35, 35, 500}},
          {"no cohesion", {young, poisson, 30, 8, 0}},
          {"no dilation", {young, poisson, 30, 0, 500}},
          {"neither", {young, poisson, 30, 0, 0}},
          {"Tresca", {young, poisson, 0, 0, 500}},
          {"nearly incompressible", {young, 0.49, 20, 5, 500}}};
}

/// Trial stresses of one to ten times the strength, around a pressure from tension beyond the apex to compression.
Stress trial_stress(Random &random, const int kind)
{
  std::array<double, 3> value = principal_values(random, kind);
  const double mean = 4 * random.unit() - 2.5, size = std::pow(10., 2 + 3 * random.unit());
  for (double &v : value)
    v = size * (v + mean);
  return random.turned(value);
}

} // namespace

TEST_CASE("Principal dyads: the values are Jacobi's, and the tensor is rebuilt, also for values that agree", "[fe]")
{
  Random random;
  double worst_value = 0, worst_tensor = 0, worst_dyad = 0;
  for (int trial = 0; trial < 30000; ++trial)
  {
    Stress tensor = random.turned(principal_values(random, trial));
    const double size = std::pow(10., trial % 25 - 12), shift = trial % 7 == 0 ? 1e6 : 0;
    for (int i = 0; i < 6; ++i)
      tensor[i] = size * (tensor[i] + (i < 3 ? shift : 0));
    const double packed[6] = {tensor[0], tensor[1], tensor[2], tensor[3], tensor[4], tensor[5]};
    const PrincipalFrame<double> frame = principal_frame(tensor);
    const PrincipalDyads<double> dyads = principal_dyads(packed);
    for (int k = 0; k < 3; ++k)
      worst_value = std::max(worst_value, std::abs(dyads.value[k] - frame.value[k]) / norm(tensor));
    double rebuilt[6];
    from_dyads(dyads.value, dyads, rebuilt);
    worst_tensor = std::max(worst_tensor,
                            distance({rebuilt[0], rebuilt[1], rebuilt[2], rebuilt[3], rebuilt[4], rebuilt[5]}, tensor) /
                                norm(tensor));
    // n ⊗ n has the values 1, 0, 0: its trace and its norm are 1, as far as the tensor's rounding lets it be known.
    const Stress dyad{dyads.apart[0], dyads.apart[1], dyads.apart[2], dyads.apart[3], dyads.apart[4], dyads.apart[5]};
    const double known = (dyads.value[0] - dyads.value[2]) / norm(tensor);
    worst_dyad =
        std::max({worst_dyad, known * std::abs(dyad[0] + dyad[1] + dyad[2] - 1), known * std::abs(norm(dyad) - 1)});
    for (int k = 0; k < 2; ++k) // falling, to the rounding of a large mean
      REQUIRE(dyads.value[k] >= dyads.value[k + 1] - 2 * epsilon * std::abs(dyads.value[k]));
  }
  // About thirty operations on the way to each.
  CHECK(worst_value < 30 * epsilon);
  CHECK(worst_tensor < 30 * epsilon);
  CHECK(worst_dyad < 30 * epsilon);
}

TEST_CASE("Principal dyads: zero gives zero, the unit tensor the unit tensor, a NaN shows", "[fe]")
{
  for (const double size : {0., 1e-200, 1., 1e9})
  {
    const double tensor[6] = {-size, -size, -size, 0, 0, 0};
    const PrincipalDyads<double> dyads = principal_dyads(tensor);
    double rebuilt[6];
    from_dyads(dyads.value, dyads, rebuilt);
    for (int k = 0; k < 3; ++k)
      CHECK(std::abs(dyads.value[k] + size) <= 4 * epsilon * size);
    for (int i = 0; i < 6; ++i)
      CHECK(std::abs(rebuilt[i] - tensor[i]) <= 4 * epsilon * size);
  }
  const double bad[6] = {1, 2, 3, 0, NAN, 0};
  for (const double value : principal_dyads(bad).value)
    CHECK(std::isnan(value));
}

TEST_CASE("Plastic flow: a pack returns as single stresses do, in every sector", "[fe]")
{
  Random random;
  for (const auto &[name, parameters] : laws())
  {
    CAPTURE(name);
    const MohrCoulomb law(parameters);
    std::array<int, 5> visits{};
    double worst_stress = 0, worst_strain = 0, worst_dissipation = 0;
    for (int round = 0; round < 3000; ++round)
    {
      const double stiffness = round % 2 ? 1 : 0.1 + random.unit();
      Pack old[6], trial[6];
      for (int lane = 0; lane < pack_width; ++lane)
      {
        set_lane(trial_stress(random, round + lane), lane, trial);
        set_lane(trial_stress(random, round), lane, old); // any: it enters the dissipation alone
      }
      const PlasticFlow<Pack> flow = plastic_flow(law, old, trial, Pack(1 / stiffness));
      for (int lane = 0; lane < pack_width; ++lane)
      {
        const Stress before = lane_of(old, lane), stress = lane_of(trial, lane);
        const StressUpdate update = law.return_to_surface(before, stress, principal_frame(stress), stiffness);
        const double size = norm(stress) + parameters.cohesion;
        const double strain_size = size / (stiffness * law.shear_modulus());
        ++visits[int(update.sector)];
        REQUIRE(Sector(int(flow.sector[lane])) == update.sector);
        REQUIRE(flow.flows[lane] == (update.sector != Sector::elastic));
        worst_stress = std::max(worst_stress, distance(lane_of(flow.stress, lane), update.stress) / size);
        worst_strain = std::max(worst_strain,
                                std::abs(flow.strain[lane] - equivalent_strain(update.plastic_strain)) / strain_size);
        worst_dissipation = std::max(worst_dissipation, std::abs(flow.dissipation[lane] - update.plastic_dissipation) /
                                                            ((norm(before) + size) * strain_size));
      }
    }
    // Some dozens of operations, whose rounding is that of the trial stress.
    CHECK(worst_stress < 60 * epsilon);
    CHECK(worst_strain < 60 * epsilon);
    CHECK(worst_dissipation < 60 * epsilon);
    for (const Sector sector : {Sector::elastic, Sector::main_plane, Sector::right_edge, Sector::left_edge})
      CHECK(visits[int(sector)] > 100);
    CHECK((visits[int(Sector::apex)] > 100) == (parameters.friction_angle > 0));
  }
}

TEST_CASE("Plastic flow: what is returned is admissible and has dissipated", "[fe]")
{
  Random random;
  for (const auto &[name, parameters] : laws())
  {
    CAPTURE(name);
    const MohrCoulomb law(parameters);
    double worst_excess = 0, least_dissipation = 0;
    for (int round = 0; round < 3000; ++round)
    {
      Pack trial[6];
      for (int lane = 0; lane < pack_width; ++lane)
        set_lane(trial_stress(random, round + lane), lane, trial);
      const PlasticFlow<Pack> flow = plastic_flow(law, trial, trial, Pack(1.));
      const PlasticFlow<Pack> from_there = plastic_flow(law, flow.stress, trial, Pack(1.)); // σ_new : Δε_p
      for (int lane = 0; lane < pack_width; ++lane)
      {
        const double size = norm(lane_of(trial, lane)) + parameters.cohesion;
        worst_excess = std::max(worst_excess, law.yield_function(lane_of(flow.stress, lane)) / size);
        least_dissipation =
            std::min(least_dissipation, from_there.dissipation[lane] * law.shear_modulus() / (size * size));
      }
    }
    CHECK(worst_excess < 60 * epsilon);
    CHECK(least_dissipation > -60 * epsilon);
  }
}

TEST_CASE("Plastic flow: what a lane gets does not depend on its neighbours", "[fe]")
{
  Random random;
  const MohrCoulomb law({});
  for (int round = 0; round < 1000; ++round)
  {
    Points volume(1e-3), strain[6], turned_strain[6];
    PointHistory history{}, turned{};
    for (int point = 0; point < points_per_pack; ++point)
    {
      const double size = 1e-4 * std::pow(10., -3 * random.unit());
      for (int i = 0; i < 6; ++i)
      {
        history.stress[i][point] = i < 3 ? -1e3 : 0;
        strain[i][point] = size * random.normal();
      }
    }
    for (int i = 0; i < 6; ++i)
      for (int point = 0; point < points_per_pack; ++point)
      {
        turned.stress[i][point] = history.stress[i][(point + 3) % points_per_pack];
        turned_strain[i][point] = strain[i][(point + 3) % points_per_pack];
      }
    Sector sector[points_per_pack], turned_sector[points_per_pack];
    update_stress(law, volume, strain, history, sector);
    update_stress(law, volume, turned_strain, turned, turned_sector);
    for (int point = 0; point < points_per_pack; ++point)
    {
      const int there = (point + 3) % points_per_pack;
      for (int i = 0; i < 6; ++i)
        REQUIRE(turned.stress[i][point] == history.stress[i][there]);
      REQUIRE(turned.plastic_strain[point] == history.plastic_strain[there]);
      REQUIRE(turned.dissipated_energy[point] == history.dissipated_energy[there]);
      REQUIRE(turned_sector[point] == sector[there]);
    }
  }
}

TEST_CASE("Stress update: eight points go the way that each goes alone, and book it", "[fe]")
{
  const bool varies = GENERATE(false, true);
  const MohrCoulomb law(
      {.friction_angle = 30, .dilation_angle = 8, .cohesion = 100, .reference_pressure = varies ? 1e5 : 0});
  Random random;
  std::array<int, 5> visits{};
  for (int path = 0; path < 50; ++path)
  {
    PointHistory history{};
    Points volume;
    std::array<Stress, points_per_pack> stress;
    std::array<double, points_per_pack> plastic{}, dissipated{}, work{};
    for (int point = 0; point < points_per_pack; ++point)
    {
      volume[point] = 1e-6 * (1 + point);
      stress[point] = {-5e3, -5e3, -5e3, 0, 0, 0};
      set_lane(stress[point], point, history.stress);
    }
    for (int step = 0; step < 30; ++step)
    {
      Points increment[6];
      for (int point = 0; point < points_per_pack; ++point)
        set_lane(random.symmetric(), point, increment);
      for (Points &component : increment)
        component *= 1e-4;
      Sector sector[points_per_pack];
      update_stress(law, volume, increment, history, sector);
      for (int point = 0; point < points_per_pack; ++point)
      {
        const Strain strain = lane_of(increment, point);
        const StressUpdate update = law.update(stress[point], strain);
        const double size = 1e4 + norm(update.stress), book = volume[point] * size * 1e-3;
        ++visits[int(update.sector)];
        plastic[point] += equivalent_strain(update.plastic_strain);
        dissipated[point] += volume[point] * update.plastic_dissipation;
        for (int i = 0; i < 6; ++i)
          work[point] += volume[point] * 0.5 * (stress[point][i] + update.stress[i]) * strain[i];
        work[point] -= volume[point] * update.plastic_dissipation;
        REQUIRE(sector[point] == update.sector);
        REQUIRE(distance(lane_of(history.stress, point), update.stress) < 1e-13 * size);
        REQUIRE(history.plastic_strain[point] == Approx(plastic[point]).margin(1e-15));
        REQUIRE(history.dissipated_energy[point] == Approx(dissipated[point]).margin(1e-12 * book));
        // What the stresses do on the elastic strains, beyond what they store.
        const auto stored = [&](const Stress &s)
        { return law.elastic_energy_density(mean_stress(s), second_invariant(s)); };
        const double loss = work[point] - volume[point] * (stored(update.stress) - stored({-5e3, -5e3, -5e3, 0, 0, 0}));
        REQUIRE(history.stiffness_loss[point] == Approx(varies ? loss : 0).margin(1e-12 * book));
        stress[point] = lane_of(history.stress, point);
      }
    }
  }
  for (const int n : visits)
    CHECK(n > 50);
}

TEST_CASE("Plastic flow: a NaN stays in its lane", "[fe]")
{
  const MohrCoulomb law({});
  Points volume(1.), strain[6];
  PointHistory history{};
  for (int i = 0; i < 6; ++i)
    strain[i] = Points(i == 2 ? -1e-3 : i == 0 ? 5e-4 : 0.);
  strain[4][2] = NAN;
  Sector sector[points_per_pack];
  update_stress(law, volume, strain, history, sector);
  for (int point = 0; point < points_per_pack; ++point)
    CHECK(std::isnan(history.stress[4][point]) == (point == 2));
  CHECK(sector[1] != Sector::elastic);
}
