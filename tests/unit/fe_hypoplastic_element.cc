#include "fe_dealii/element/small_strain_hexahedra.h"
#include "tests/unit/fe_sands.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

using namespace bergamo;
using namespace bergamo::fe;
using namespace bergamo::fe::sands;

namespace
{

constexpr double edge = 0.2; // of the cube [m]

using Displacement = std::array<double, hexahedron::n_dofs>;

/// A cube with a corner at the origin; its node k lies at the bits of k, x first.
hexahedron::Geometry cube()
{
  hexahedron::Geometry geometry;
  for (int point = 0; point < hexahedron::n_points; ++point)
    for (int node = 0; node < hexahedron::n_nodes; ++node)
      for (int i = 0; i < 3; ++i)
      {
        double gradient = ((node >> i) & 1 ? 1 : -1) / edge;
        for (int j = 0; j < 3; ++j)
          if (j != i)
          {
            const double far = 0.5 * (1 - 1 / std::sqrt(3.));
            gradient *= ((node >> j) & 1) == ((point >> j) & 1) ? 1 - far : far;
          }
        geometry.gradient[i][node][point] = gradient;
      }
  geometry.volume = Points(edge * edge * edge / hexahedron::n_points);
  geometry.share_volume = geometry.volume;
  geometry.volume_fraction = Points(1. / hexahedron::n_points);
  return geometry;
}

/// One cube of sand, alone.
SmallStrainHexahedra<HypoplasticSand> element_of(const HypoplasticSand &sand, const SandState &start)
{
  SandHistory history{};
  for (int i = 0; i < 6; ++i)
    history.stress[i] = Points(start.stress[i]);
  history.void_ratio = Points(start.void_ratio);
  std::vector<unsigned int> nodes(hexahedron::n_nodes);
  std::iota(nodes.begin(), nodes.end(), 0u);
  return {sand, nodes, {cube()}, {history}};
}

/// The displacements of a strain, from others on.
Displacement strained(const Strain &strain, Displacement u = {})
{
  const Tensor e = strain_tensor(strain);
  for (int node = 0; node < hexahedron::n_nodes; ++node)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        u[3 * node + i] += e[i][j] * edge * ((node >> j) & 1);
  return u;
}

/// Sum of the forces on the face at the far end of an axis, along it [N].
double face_force(const ElementGroup &element, const int axis)
{
  double sum = 0;
  for (int node = 0; node < hexahedron::n_nodes; ++node)
    if ((node >> axis) & 1)
      sum += element.forces()[3 * node + axis];
  return sum;
}

/// Follows a path in an element and at a point; the greatest difference of stresses over the stress, of void ratios and
/// of face forces over stress times area.
struct Difference
{
  double stress = 0, void_ratio = 0, force = 0, work = 0;
};
Difference follow(const HypoplasticSand &sand, SandState state, const std::vector<Strain> &path)
{
  auto element = element_of(sand, state);
  const auto &read = element;
  Displacement before{};
  Difference worst;
  double work = 0;
  for (const Strain &increment : path)
  {
    const Displacement now = strained(increment, before);
    REQUIRE(!element.compute_forces(0, 1, now.data(), before.data()));
    const SandUpdate result = update(sand, state, increment);
    REQUIRE(result.status == SandUpdateStatus::done);
    for (int i = 0; i < 6; ++i)
      work += 0.5 * edge * edge * edge * (state.stress[i] + result.state.stress[i]) * increment[i];
    state = result.state;
    before = now;
    const double size = stress_norm(state.stress);
    for (int point = 0; point < hexahedron::n_points; ++point)
    {
      const SandState there = sand_state(read.point_history(0, 0), point);
      worst.stress = std::max(worst.stress, stress_norm(difference(there.stress, state.stress)) / size);
      worst.void_ratio = std::max(worst.void_ratio, std::abs(there.void_ratio - state.void_ratio));
    }
    for (int axis = 0; axis < 3; ++axis)
      worst.force =
          std::max(worst.force, std::abs(face_force(element, axis) / (edge * edge) - state.stress[axis]) / size);
  }
  worst.work = std::abs(element.dissipated_energy() - work) / std::abs(work);
  CHECK(element.elastic_energy() == 0);
  CHECK(element.stiffness_loss() == 0);
  return worst;
}

SandState isotropic(const double pressure, const double void_ratio)
{
  return {{-pressure, -pressure, -pressure, 0, 0, 0}, void_ratio};
}

} // namespace

TEST_CASE("Element of sand: oedometer and triaxial paths are those of the point", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  std::vector<Strain> oedometer(200, Strain{0, 0, -1e-4, 0, 0, 0});
  for (int k = 0; k < 20; ++k)
    oedometer.push_back({0, 0, 1e-4, 0, 0, 0});
  for (int k = 0; k < 100; ++k)
    oedometer.push_back({0, 0, -1e-4, 0, 0, 0});

  // Drained triaxial: the lateral strain that holds the point's lateral stress, by the rate of each state and then
  // Newton's steps.
  std::vector<Strain> triaxial;
  SandState state = isotropic(100e3, 0.65);
  for (int step = 0; step < 400; ++step)
  {
    Strain increment{0, 0, -1e-4, 0, 0, 0};
    for (int search = 0; search < 20; ++search)
    {
      const Moduli tangent = sand.response(state).tangent(increment);
      const double miss = update(sand, state, increment).state.stress[0] + 100e3;
      const double correction = miss / (tangent[0][0] + tangent[0][1]);
      increment[0] = increment[1] = increment[0] - correction;
    }
    state = update(sand, state, increment).state;
    REQUIRE(std::abs(state.stress[0] + 100e3) < 1e-6 * 100e3);
    triaxial.push_back(increment);
  }
  CHECK(state.stress[2] / state.stress[0] > 3.4); // beyond the critical ratio

  // A displacement is known to a rounding of its size, an increment of 1e-4 of it to some 1e-13: with a stiffness of a
  // thousand times the stress, every step leaves 1e-14 of the stress, and the void ratio 1e-16.
  for (const Difference &worst :
       {follow(sand, isotropic(50e3, 0.7), oedometer), follow(sand, isotropic(100e3, 0.65), triaxial)})
  {
    CHECK(worst.stress < 1e-11);
    CHECK(worst.void_ratio < 1e-13);
    CHECK(worst.force < 1e-11);
    CHECK(worst.work < 1e-11);
  }
}

TEST_CASE("Element of sand: its stiffness is nowhere softer than the law, and follows pressure and density", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  Random random;
  for (int trial = 0; trial < 100; ++trial)
  {
    const SandState state = random.state(sand);
    const auto element = element_of(sand, state);
    const double factor = element.stiffness_factor(0);
    CHECK(factor * 2 * sand.shear_modulus() == Approx(sand.response(state).greatest_modulus()).epsilon(1e-12));
    std::vector<double> stiffness(hexahedron::n_dofs * hexahedron::n_dofs);
    element.stiffness(0, nullptr, stiffness.data());
    // u·K u of a homogeneous strain is V 2G ‖ε‖², that of the law at most as much.
    const Strain strain = strain_components(random.symmetric());
    const Displacement u = strained(strain);
    double energy = 0;
    for (int i = 0; i < hexahedron::n_dofs; ++i)
      for (int j = 0; j < hexahedron::n_dofs; ++j)
        energy += u[i] * stiffness[hexahedron::n_dofs * i + j] * u[j];
    const double expected =
        edge * edge * edge * sand.response(state).greatest_modulus() * std::pow(strain_norm(strain), 2);
    CHECK(energy == Approx(expected).epsilon(1e-11));
    CHECK(std::abs(energy_density(sand.response(state).rate(strain), strain)) * edge * edge * edge <= energy);
  }
  const double loose = element_of(sand, isotropic(1e5, 0.85)).stiffness_factor(0);
  CHECK(element_of(sand, isotropic(1e5, 0.55)).stiffness_factor(0) > loose);
  CHECK(element_of(sand, isotropic(4e5, 0.80)).stiffness_factor(0) > 2 * loose); // 4^(3/4) and some density
}

TEST_CASE("Element of sand: the tangent is the derivative of the rate, and that of the forces for a small step", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  Random random;
  double worst = 0, worst_force = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    const SandState state = random.state(sand);
    const Strain d = strain_components(random.symmetric());
    const HypoplasticResponse response = sand.response(state);
    const Moduli moduli = response.tangent(d);
    const double h = 1e-5;
    for (int j = 0; j < 6; ++j)
    {
      Strain above = d, below = d;
      above[j] += h;
      below[j] -= h;
      const Stress up = response.rate(above), down = response.rate(below);
      for (int i = 0; i < 6; ++i)
        worst = std::max(worst, std::abs((up[i] - down[i]) / (2 * h) - moduli[i][j]) / response.greatest_modulus());
    }
    // ‖D‖ is homogeneous: the tangent along D gives the rate.
    Stress along{};
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        along[i] += moduli[i][j] * d[j];
    worst_force = std::max(worst_force, stress_norm(difference(along, response.rate(d))) /
                                            (response.greatest_modulus() * strain_norm(d)));
  }
  CHECK(worst < 1e-9); // h² of the change of direction, rounding over h
  CHECK(worst_force < 1e-14);

  // In the element: the derivative of the forces by the displacement, as far as a step of 1e-7 changes the stiffness.
  const SandState state{{-1e5, -2e5, -1.5e5, 1e4, 0, 2e4}, 0.7};
  const auto element = element_of(sand, state);
  const Displacement zero{}, u = strained({1e-8, 2e-8, -8e-8, 3e-8, 0, -2e-8});
  std::vector<double> tangent(hexahedron::n_dofs * hexahedron::n_dofs);
  element.tangent(0, u.data(), zero.data(), tangent.data());
  double largest = 0, error = 0;
  for (int column = 0; column < hexahedron::n_dofs; ++column)
  {
    const double h = 1e-11;
    Displacement above = u, below = u;
    above[column] += h;
    below[column] -= h;
    auto up = element, down = element;
    REQUIRE(!up.compute_forces(0, 1, above.data(), zero.data()));
    REQUIRE(!down.compute_forces(0, 1, below.data(), zero.data()));
    for (int row = 0; row < hexahedron::n_dofs; ++row)
    {
      const double entry = tangent[hexahedron::n_dofs * row + column];
      largest = std::max(largest, std::abs(entry));
      error = std::max(error, std::abs((up.forces()[row] - down.forces()[row]) / (2 * h) - entry));
    }
  }
  CHECK(error < 1e-3 * largest);
}

TEST_CASE("Element of sand: a point that cannot follow names itself, the others go on", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  auto element = element_of(sand, isotropic(1e5, 0.7));
  const Displacement zero{}, crushed = strained({-0.2, -0.2, -0.2, 0, 0, 0});
  const auto failed = element.compute_forces(0, 1, crushed.data(), zero.data());
  REQUIRE(failed == std::size_t(0));
  CHECK_THAT(element.failure(0), Catch::Contains("sand with a stress of xx -100000") && Catch::Contains("0.7") &&
                                     Catch::Contains("no voids"));
  Displacement bad{};
  bad[4] = NAN;
  auto other = element_of(sand, isotropic(1e5, 0.7));
  REQUIRE(other.compute_forces(0, 1, bad.data(), zero.data()) == std::size_t(0));
  CHECK_THAT(other.failure(0), Catch::Contains("tolerance"));
}

TEST_CASE("Element of sand: what a snapshot holds goes on with the same bits", "[fe]")
{
  const HypoplasticSand sand(hochstetten());
  auto element = element_of(sand, isotropic(1e5, 0.7));
  Displacement before{};
  const auto advance = [](auto &of, Displacement &from)
  {
    const Displacement now = strained({1e-4, 2e-4, -5e-4, 1e-4, 0, -3e-4}, from);
    REQUIRE(!of.compute_forces(0, 1, now.data(), from.data()));
    from = now;
  };
  advance(element, before);
  auto restored = element_of(sand, isotropic(1, 0.8));
  const auto saved = element.state();
  const auto into = restored.state();
  REQUIRE(saved.size() == into.size());
  for (std::size_t k = 0; k < saved.size(); ++k)
    std::copy(saved[k].second.begin(), saved[k].second.end(), into[k].second.begin());
  Displacement again = before;
  advance(element, before);
  advance(restored, again);
  CHECK(std::equal(element.forces().begin(), element.forces().end(), restored.forces().begin()));
  CHECK(sand_state(std::as_const(element).point_history(0, 0), 3).void_ratio ==
        sand_state(std::as_const(restored).point_history(0, 0), 3).void_ratio);
  CHECK(element.dissipated_energy() == restored.dissipated_energy());
}
