#include "fe_dealii/element/finite_strain.h"
#include "tests/unit/fe_rubber.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace bergamo::fe;
using finite_strain::Dilatation;

namespace
{

/// Lagrange hexahedron of degree 1 or 2, tensor product nodes and Gauss points, x fastest.
template <int degree>
struct Hexahedron
{
  static constexpr int per_axis = degree + 1, n_nodes = per_axis * per_axis * per_axis, n_packs = packs_of(n_nodes);
  using Geometry = SolidGeometry<n_nodes, n_packs>;
  std::array<std::array<double, 3>, n_nodes> node;

  static double shape(const int k, const double x, const bool slope)
  {
    if constexpr (degree == 1)
      return k == 0 ? (slope ? -1 : 1 - x) : (slope ? 1 : x);
    else
      switch (k)
      {
      case 0:
        return slope ? 4 * x - 3 : (1 - x) * (1 - 2 * x);
      case 1:
        return slope ? 4 - 8 * x : 4 * x * (1 - x);
      default:
        return slope ? 4 * x - 1 : x * (2 * x - 1);
      }
  }

  Geometry geometry() const
  {
    const double inner = std::sqrt(0.6) / 2;
    const std::vector<double> gauss = degree == 1 ? std::vector{0.5 - 0.5 / std::sqrt(3.), 0.5 + 0.5 / std::sqrt(3.)}
                                                  : std::vector{0.5 - inner, 0.5, 0.5 + inner};
    const std::vector<double> weight = degree == 1 ? std::vector{0.5, 0.5} : std::vector{5. / 18, 8. / 18, 5. / 18};
    Geometry result{};
    for (int p = 0; p < n_nodes; ++p)
    {
      const int at[3] = {p % per_axis, p / per_axis % per_axis, p / (per_axis * per_axis)};
      double slope[n_nodes][3];
      Tensor3<double> jacobian{};
      for (int n = 0; n < n_nodes; ++n)
      {
        const int of[3] = {n % per_axis, n / per_axis % per_axis, n / (per_axis * per_axis)};
        for (int j = 0; j < 3; ++j)
        {
          slope[n][j] = 1;
          for (int axis = 0; axis < 3; ++axis)
            slope[n][j] *= shape(of[axis], gauss[at[axis]], axis == j);
          for (int i = 0; i < 3; ++i)
            jacobian[i][j] += node[n][i] * slope[n][j];
        }
      }
      const Tensor3<double> minors = cofactor(jacobian);
      const double det = determinant(jacobian, minors);
      const int pack = p / points_per_pack, lane = p % points_per_pack;
      result.volume[pack][lane] = det * weight[at[0]] * weight[at[1]] * weight[at[2]];
      for (int n = 0; n < n_nodes; ++n)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            result.gradient[pack][i][n][lane] += minors[i][j] / det * slope[n][j];
    }
    return result;
  }
};

template <int degree>
Hexahedron<degree> distorted_cube(std::mt19937_64 &random, const double edge, const double distortion)
{
  using Cube = Hexahedron<degree>;
  std::uniform_real_distribution<double> shift(-distortion * edge, distortion * edge);
  Cube cube;
  for (int n = 0; n < Cube::n_nodes; ++n)
  {
    const int of[3] = {n % Cube::per_axis, n / Cube::per_axis % Cube::per_axis, n / (Cube::per_axis * Cube::per_axis)};
    for (int i = 0; i < 3; ++i)
      cube.node[n][i] = edge * of[i] / degree + shift(random);
  }
  return cube;
}

template <class Law, int degree>
void check_element(const Law &law)
{
  using Cube = Hexahedron<degree>;
  constexpr int n = 3 * Cube::n_nodes;
  const double edge = 0.02, force_scale = law.bulk_modulus() * edge * edge;
  std::mt19937_64 random(degree);
  const auto element = distorted_cube<degree>(random, edge, 0.06);
  const typename Cube::Geometry geometry = element.geometry();
  std::uniform_real_distribution<double> small(-0.05 * edge, 0.05 * edge);
  for (const Dilatation dilatation : {Dilatation::point, Dilatation::mean})
  {
    double u[n], force[n];

    // A uniform deformation gradient: the energy is that of the material, the nodes get the forces of its stress.
    const Tensor3<double> f{{{1.2, 0.1, -0.05}, {0.02, 0.9, 0.15}, {-0.1, 0.03, 1.05}}};
    const Tensor3<double> stress = first_piola(law, f);
    for (int node = 0; node < Cube::n_nodes; ++node)
      for (int i = 0; i < 3; ++i)
      {
        u[3 * node + i] = -element.node[node][i];
        for (int j = 0; j < 3; ++j)
          u[3 * node + i] += f[i][j] * element.node[node][j];
      }
    const double volume = geometry.whole_volume();
    finite_strain::Response response = internal_force(law, geometry, dilatation, u, force);
    CHECK(response.energy == Approx(volume * energy_density(law, f)).epsilon(1e-12));
    for (int node = 0; node < Cube::n_nodes; ++node)
      for (int i = 0; i < 3; ++i)
      {
        double expected = 0;
        for (int j = 0; j < 3; ++j)
          for (int pack = 0; pack < Cube::n_packs; ++pack)
            expected += stress[i][j] * sum(geometry.volume[pack] * geometry.gradient[pack][j][node]);
        CHECK(force[3 * node + i] == Approx(expected).margin(1e-12 * force_scale));
      }

    // Any displacement: the forces are the derivatives of the energy, and neither push nor turn the element.
    for (double &x : u)
      x = small(random);
    response = internal_force(law, geometry, dilatation, u, force);
    CHECK(response.smallest_ratio > 0);
    double scratch[n], sum_of_forces[3] = {}, torque[3] = {};
    for (int dof = 0; dof < n; ++dof)
    {
      const double step = 1e-5 * edge, kept = u[dof];
      u[dof] = kept + step;
      const double more = internal_force(law, geometry, dilatation, u, scratch).energy;
      u[dof] = kept - step;
      const double less = internal_force(law, geometry, dilatation, u, scratch).energy;
      u[dof] = kept;
      CHECK(force[dof] == Approx((more - less) / (2 * step)).margin(1e-7 * force_scale));
      sum_of_forces[dof % 3] += force[dof];
    }
    for (int node = 0; node < Cube::n_nodes; ++node)
      for (int i = 0; i < 3; ++i)
      {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        torque[i] += (element.node[node][a] + u[3 * node + a]) * force[3 * node + b] -
                     (element.node[node][b] + u[3 * node + b]) * force[3 * node + a];
      }
    for (int i = 0; i < 3; ++i)
    {
      CHECK(std::abs(sum_of_forces[i]) < 1e-13 * force_scale);
      CHECK(std::abs(torque[i]) < 1e-12 * force_scale * edge);
    }

    // The tangent carries the forces over a small step, to second order.
    std::vector<double> stiffness(n * n), moved(u, u + n);
    tangent_stiffness(law, geometry, dilatation, u, stiffness.data());
    double after[n], worst = 0;
    for (double &x : moved)
      x += 1e-4 * small(random);
    internal_force(law, geometry, dilatation, moved.data(), after);
    for (int row = 0; row < n; ++row)
    {
      double predicted = force[row];
      for (int column = 0; column < n; ++column)
        predicted += stiffness[n * row + column] * (moved[column] - u[column]);
      worst = std::max(worst, std::abs(predicted - after[row]));
    }
    CHECK(worst < 1e-8 * force_scale);
  }
}

} // namespace

TEST_CASE("elements at large strain: uniform deformation, forces from the energy, balance, tangent", "[fe]")
{
  for_each_law(
      []<class Law>(const Law &law)
      {
        check_element<Law, 1>(law);
        check_element<Law, 2>(law);
      });
}

TEST_CASE("an element that is turned inside out says so", "[fe]")
{
  std::mt19937_64 random(1);
  const auto element = distorted_cube<1>(random, 1, 0);
  const auto geometry = element.geometry();
  double u[24] = {}, force[24];
  u[0] = 1.6; // the corner at the origin is pushed through the element
  u[1] = 1.6;
  u[2] = 1.6;
  CHECK(internal_force(neo_hooke(), geometry, Dilatation::point, u, force).smallest_ratio < 0);
}
