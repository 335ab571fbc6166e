#include "fe_dealii/element/membrane.h"
#include "tests/unit/fe_rubber.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>

using namespace bergamo::fe;

namespace
{

using Vector = std::array<double, 3>;
using Nodes = std::array<Vector, 4>;

constexpr double thickness = 0.3e-3;

Nodes warped_square(std::mt19937_64 &random, const double distortion)
{
  std::uniform_real_distribution<double> shift(-distortion, distortion);
  Nodes nodes;
  for (int k = 0; k < 4; ++k)
    nodes[k] = {0.01 * (k % 2 + shift(random)), 0.01 * (k / 2 + shift(random)), 0.01 * shift(random)};
  return nodes;
}

/// Energy of a sphere, made of 6 n² elements, blown up evenly [J]. @param stretch radius over the reference radius
template <class Law>
double energy_of_sphere(const Law &law, const int n, const double radius, const double stretch)
{
  double energy = 0;
  const auto node = [&](const int side, const int i, const int j)
  {
    // Equal angles on the faces of a cube.
    const double a = std::tan((2. * i / n - 1) * std::atan(1.)), b = std::tan((2. * j / n - 1) * std::atan(1.));
    const double sign = side % 2 == 0 ? 1 : -1, scale = radius / std::sqrt(1 + a * a + b * b);
    Vector x;
    x[side / 2] = sign * scale;
    x[(side / 2 + 1) % 3] = a * scale;
    x[(side / 2 + 2) % 3] = b * scale;
    return x;
  };
  for (int side = 0; side < 6; ++side)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
      {
        const Nodes nodes{node(side, i, j), node(side, i + 1, j), node(side, i, j + 1), node(side, i + 1, j + 1)};
        double u[12], force[12];
        for (int k = 0; k < 4; ++k)
          for (int c = 0; c < 3; ++c)
            u[3 * k + c] = (stretch - 1) * nodes[k][c];
        energy += membrane::internal_force(law, membrane::reference_geometry(nodes, thickness), u, force).energy;
      }
  return energy;
}

template <class Law>
void check_sphere(const Law &law)
{
  // Pressure over the radius: p = dE/dV, and in closed form 2 h0/(R λ³) (slope(λ²) − slope(λ⁻⁴)) (Ogden 1984, 5.3).
  const double radius = 0.05;
  for (const double s : {1.05, 1.5, 3.})
  {
    double error[2];
    for (int k = 0; k < 2; ++k)
    {
      const double step = 1e-5 * s;
      const double energy_slope =
          (energy_of_sphere(law, 8 << k, radius, s + step) - energy_of_sphere(law, 8 << k, radius, s - step)) /
          (2 * step);
      const double pressure = energy_slope / (4 * M_PI * std::pow(radius, 3) * s * s);
      const double exact = 2 * thickness / (radius * s * s * s) *
                           (law.principal_slope(s * s) - law.principal_slope(1 / (s * s * s * s)));
      error[k] = std::abs(pressure / exact - 1);
    }
    CAPTURE(s, error[0], error[1]);
    CHECK(error[1] < 0.01);
    CHECK(std::log2(error[0] / error[1]) > 1.9); // of second order: flat elements lack surface
  }
}

template <class Law>
void check_element(const Law &law)
{
  const double scale = law.shear_modulus() * thickness * 0.01;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> change(-0.003, 0.003);
  for (int trial = 0; trial < 20; ++trial)
  {
    const Nodes nodes = warped_square(random, 0.15);
    const membrane::Geometry geometry = membrane::reference_geometry(nodes, thickness);
    double u[12] = {}, force[12], scratch[12];
    CHECK(std::abs(membrane::internal_force(law, geometry, u, force).energy) < 1e-15 * scale);
    for (const double f : force)
      CHECK(std::abs(f) < 1e-12 * scale);

    for (double &x : u)
      x = change(random);
    membrane::internal_force(law, geometry, u, force);
    Vector resultant{}, torque{};
    for (int dof = 0; dof < 12; ++dof)
    {
      const double step = 1e-7, kept = u[dof];
      u[dof] = kept + step;
      const double more = membrane::internal_force(law, geometry, u, scratch).energy;
      u[dof] = kept - step;
      const double less = membrane::internal_force(law, geometry, u, scratch).energy;
      u[dof] = kept;
      CHECK(force[dof] == Approx((more - less) / (2 * step)).margin(1e-7 * scale));
      resultant[dof % 3] += force[dof];
    }
    for (int node = 0; node < 4; ++node)
      for (int i = 0; i < 3; ++i)
      {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        torque[i] += (nodes[node][a] + u[3 * node + a]) * force[3 * node + b] -
                     (nodes[node][b] + u[3 * node + b]) * force[3 * node + a];
      }
    for (int i = 0; i < 3; ++i)
    {
      CHECK(std::abs(resultant[i]) < 1e-13 * scale);
      CHECK(std::abs(torque[i]) < 1e-13 * scale * 0.01);
    }
  }
}

template <class Law>
void check_sheet(const Law &law)
{
  // A flat square, stretched: the force on an edge over its reference section is the nominal stress τ/λ, with
  // τ = slope(λ²) − slope(λ3²) (Ogden 1984, section 5.1).
  const double edge = 0.01;
  Nodes square;
  for (int k = 0; k < 4; ++k)
    square[k] = {edge * (k % 2), edge * (k / 2), 0};
  const membrane::Geometry geometry = membrane::reference_geometry(square, thickness);
  for (const double s : {0.5, 1.2, 2., 5.})
    for (const double across : {s, 1., 1 / std::sqrt(s)})
    {
      double u[12], force[12];
      for (int k = 0; k < 4; ++k)
      {
        u[3 * k] = (s - 1) * square[k][0];
        u[3 * k + 1] = (across - 1) * square[k][1];
        u[3 * k + 2] = 0;
      }
      membrane::internal_force(law, geometry, u, force);
      const double third = 1 / (s * across * s * across);
      const double x = (law.principal_slope(s * s) - law.principal_slope(third)) / s;
      const double y = (law.principal_slope(across * across) - law.principal_slope(third)) / across;
      const double section = edge * thickness, rounding = 1e-12 * law.shear_modulus() * section;
      CHECK(force[3] + force[9] == Approx(x * section).epsilon(1e-12).margin(rounding));
      CHECK(force[7] + force[10] == Approx(y * section).epsilon(1e-12).margin(rounding));
      CHECK(std::abs(force[2]) < rounding);
    }
}

} // namespace

TEST_CASE("a membrane's forces follow from its energy, neither push nor turn it, and vanish at rest", "[fe]")
{
  SECTION("Neo-Hooke")
  {
    check_element(neo_hooke());
  }
  SECTION("Mooney-Rivlin")
  {
    check_element(mooney_rivlin());
  }
  SECTION("Ogden")
  {
    check_element(ogden());
  }
}

TEST_CASE("a rubber sheet stretched along one and two directions", "[fe]")
{
  SECTION("Neo-Hooke")
  {
    check_sheet(neo_hooke());
  }
  SECTION("Mooney-Rivlin")
  {
    check_sheet(mooney_rivlin());
  }
  SECTION("Ogden")
  {
    check_sheet(ogden());
  }
}

TEST_CASE("a balloon's pressure over its radius", "[fe]")
{
  SECTION("Neo-Hooke")
  {
    check_sphere(neo_hooke());
  }
  SECTION("Mooney-Rivlin")
  {
    check_sphere(mooney_rivlin());
  }
  SECTION("Ogden")
  {
    check_sphere(ogden());
  }
}

TEST_CASE("a membrane that is folded over has a point without positive volume", "[fe]")
{
  const Nodes crossed{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}; // around, not line by line
  const membrane::Geometry geometry = membrane::reference_geometry(crossed, thickness);
  double least = geometry.volume[0];
  for (int point = 1; point < 4; ++point)
    least = std::min(least, geometry.volume[point]);
  CHECK_FALSE(least > 0);
}
