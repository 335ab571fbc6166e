#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "tests/solid_shapes.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

using namespace bergamo::fe;

namespace
{

double largest(const Moduli &moduli)
{
  double result = 0;
  for (const auto &row : moduli)
    for (const double entry : row)
      result = std::max(result, std::abs(entry));
  return result;
}

MohrCoulomb sand(const double reference_pressure = 0, const double dilation_angle = 8)
{
  return MohrCoulomb({.young_modulus = 60e6,
                      .poisson_ratio = 0.2,
                      .friction_angle = 30,
                      .dilation_angle = dilation_angle,
                      .cohesion = 2e3,
                      .reference_pressure = reference_pressure});
}

} // namespace

TEST_CASE("Mohr-Coulomb: the tangent is the derivative of the stress in every sector", "[fe]")
{
  const MohrCoulomb law = sand(GENERATE(0., 5e4), GENERATE(5., -5.));
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::map<Sector, int> n_cases;
  double worst = 0;
  for (int k = 0; k < 4000; ++k)
  {
    Stress old{-2e4, -2e4, -2e4, 0, 0, 0};
    Strain increment;
    const bool axisymmetric = k % 2; // half of them near an edge: it takes a symmetric path to get there
    const double size = std::pow(10., -4 + 2 * (k % 5) / 4.);
    for (double &x : increment)
      x = size * normal(random) * (axisymmetric ? 0.03 : 1);
    if (axisymmetric)
      increment[k % 3] += (k % 4 < 2 ? 1 : -1) * size;
    if (k % 7 == 0)
      for (int i = 0; i < 3; ++i)
        increment[i] += 2 * size; // to the apex
    const StressUpdate update = law.update(old, increment);
    const Moduli moduli = law.tangent(old, increment);
    const double h = 1e-6 * size;
    bool same_sector = true;
    double error = 0;
    for (int j = 0; j < 6; ++j)
    {
      Strain above = increment, below = increment;
      above[j] += h;
      below[j] -= h;
      const StressUpdate up = law.update(old, above), down = law.update(old, below);
      same_sector = same_sector && up.sector == update.sector && down.sector == update.sector;
      for (int i = 0; i < 6; ++i)
        error = std::max(error, std::abs((up.stress[i] - down.stress[i]) / (2 * h) - moduli[i][j]));
    }
    if (!same_sector)
      continue;
    ++n_cases[update.sector];
    // Central differences: h² of the frame's turning, rounding of stresses of 1e5 Pa over h.
    worst = std::max(worst, error / largest(law.tangent(old, {})));
  }
  CHECK(worst < 1e-6);
  for (const Sector sector : {Sector::elastic, Sector::main_plane, Sector::right_edge, Sector::left_edge, Sector::apex})
  {
    CAPTURE(static_cast<int>(sector));
    CHECK(n_cases[sector] > 100);
  }
}

TEST_CASE("Mohr-Coulomb: the tangent is symmetric if the flow is associated", "[fe]")
{
  const MohrCoulomb law({.friction_angle = 30, .dilation_angle = 30, .cohesion = 2e3});
  const Stress old{-2e4, -2e4, -2e4, 0, 0, 0};
  const Moduli moduli = law.tangent(old, {2e-3, -1e-3, 1e-4, 3e-4, 2e-4, -4e-4});
  REQUIRE(law.update(old, {2e-3, -1e-3, 1e-4, 3e-4, 2e-4, -4e-4}).sector != Sector::elastic);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < i; ++j)
      CHECK(moduli[i][j] == Approx(moduli[j][i]).margin(1e-10 * largest(moduli)));
}

TEST_CASE("the tangent of an element is the derivative of its forces", "[fe]")
{
  ExplicitBodyParameters parameters;
  const Shape shape = GENERATE(Shape::plain, Shape::bending, Shape::quadratic);
  set_shape(parameters, shape);
  const int kind = GENERATE(0, 1, 2, 3);
  if (kind == 0)
    parameters.material = LinearElastic({.young_modulus = 60e6, .poisson_ratio = 0.3});
  else if (kind == 1)
    parameters.material = sand();
  else if (kind == 2)
    parameters.material = NeoHooke({.young_modulus = 60e6, .poisson_ratio = 0.3});
  else
    parameters.material = MohrCoulomb({.young_modulus = 60e6,
                                       .poisson_ratio = 0.2,
                                       .friction_angle = 30,
                                       .dilation_angle = 0,
                                       .cohesion = 2e3,
                                       .hardening_strain = 1e-3});
  if (kind == 1)
    parameters.initial_stress = uniform_pressure(2e4);
  if (kind == 3) // some of the friction is mobilised by then
    parameters.initial_stress = [](const std::array<double, 3> &) { return Stress{-1e4, -1e4, -3e4, 0, 0, 0}; };
  CAPTURE(static_cast<int>(shape), kind);
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 1, 1}, {2, 1, 1}}, mesh);
  dealii::GridTools::distort_random(0.1, mesh, false, 5);
  ExplicitBody body(mesh, parameters);
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  std::vector<double> u(3 * body.n_nodes()), before(u.size(), 0.);
  for (double &x : u)
    x = 1e-3 * normal(random);

  ElementGroup &elements = body.elements();
  std::vector<std::vector<double>> start;
  for (const auto &[name, view] : elements.state())
    start.emplace_back(view.begin(), view.end());
  const auto force_at = [&](const std::vector<double> &displacement)
  {
    const auto state = elements.state();
    for (std::size_t k = 0; k < state.size(); ++k)
      std::copy(start[k].begin(), start[k].end(), state[k].second.begin());
    elements.compute_forces(0, 2, displacement.data(), before.data());
    const std::size_t n = elements.dofs_per_element();
    return std::vector<double>(elements.forces().begin() + n, elements.forces().begin() + 2 * n);
  };
  force_at(before);
  const std::size_t n = elements.dofs_per_element();
  const auto state = elements.state();
  for (std::size_t k = 0; k < state.size(); ++k)
    std::copy(start[k].begin(), start[k].end(), state[k].second.begin());
  std::vector<double> matrix(n * n), elastic(n * n);
  elements.tangent(1, u.data(), before.data(), matrix.data());
  elements.stiffness(1, before.data(), elastic.data());
  const double scale = *std::max_element(elastic.begin(), elastic.end());
  double worst = 0, change = 0;
  constexpr double h = 1e-9;
  for (std::size_t column = 0; column < n; ++column)
  {
    const std::size_t dof = 3 * std::size_t(elements.nodes(1)[column / 3]) + column % 3;
    std::vector<double> above = u, below = u;
    above[dof] += h;
    below[dof] -= h;
    const auto up = force_at(above), down = force_at(below);
    for (std::size_t row = 0; row < n; ++row)
    {
      worst = std::max(worst, std::abs((up[row] - down[row]) / (2 * h) - matrix[n * row + column]));
      change = std::max(change, std::abs(elastic[n * row + column] - matrix[n * row + column]));
    }
  }
  CHECK(worst < 2e-5 * scale); // rounding of forces of 1e5 N over h
  if (kind == 1 || kind == 3)
    CHECK(change > 0.1 * scale); // most points flow
}
