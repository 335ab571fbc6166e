// Bending of a nearly incompressible plate strip against the exact plane-strain solution, mean dilatation against full
// integration. Timoshenko & Goodier, Theory of Elasticity, sec. 2.21 (pure bending), plane-strain moduli.
#include "fe_dealii/boundary/surface.h"
#include "fe_dealii/element/small_strain_hexahedra.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <deal.II/grid/tria.h>
#include <deal.II/lac/full_matrix.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace bergamo::fe;

namespace
{

constexpr double length = 4, depth = 1, curvature = 1e-4;

// Stiffness of the same element with the dilatation taken point by point: full integration.
void full_stiffness(const MohrCoulomb &material, const hexahedron::Geometry &geometry, double (&k)[24][24])
{
  const double lame = material.lame_modulus(), shear = material.shear_modulus();
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < 8; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
        {
          double sum = 0;
          for (int q = 0; q < 8; ++q)
          {
            double contraction = 0;
            for (int l = 0; l < 3; ++l)
              contraction += geometry.gradient[l][a][q] * geometry.gradient[l][b][q];
            sum += geometry.volume[q] * (lame * geometry.gradient[i][a][q] * geometry.gradient[j][b][q] +
                                         shear * geometry.gradient[j][a][q] * geometry.gradient[i][b][q] +
                                         (i == j ? shear * contraction : 0));
          }
          k[3 * a + i][3 * b + j] = sum;
        }
}

// Tip deflection over the exact one, κ L²/2.
double bending_ratio(const double poisson_ratio, const unsigned int n_depth, const bool mean_dilatation)
{
  ExplicitBodyParameters parameters;
  const MohrCoulombParameters plate{.poisson_ratio = poisson_ratio, .cohesion = 1e12};
  parameters.material = MohrCoulomb(plate);
  dealii::Triangulation<3> mesh;
  make_box({{0, -depth / 2, 0}, {length, depth / 2, 0.25}, {4 * n_depth, n_depth, 1}}, mesh);
  const ExplicitBody body(mesh, parameters);
  const auto &elements = dynamic_cast<const SmallStrainHexahedra<MohrCoulomb> &>(body.elements());

  // Free dofs: plane strain (u_z = 0), u_x = 0 at x = 0, u_y = 0 on its middle line.
  std::vector<int> number(3 * body.n_nodes(), -1);
  int n_free = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const auto &x = body.node_position()[node];
    if (x[0] > 1e-9)
      number[3 * node] = n_free++;
    if (x[0] > 1e-9 || std::abs(x[1]) > 1e-9)
      number[3 * node + 1] = n_free++;
  }
  dealii::FullMatrix<double> matrix(n_free, n_free);
  dealii::Vector<double> force(n_free), u(n_free);
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    double k[24][24];
    if (mean_dilatation)
      body.elements().stiffness(e, body.displacement().data(), &k[0][0]);
    else
      full_stiffness(elements.law(), elements.geometry(e), k);
    const auto nodes = body.element_nodes(e);
    for (int i = 0; i < 24; ++i)
      for (int j = 0; j < 24; ++j)
        if (const int r = number[3 * nodes[i / 3] + i % 3], c = number[3 * nodes[j / 3] + j % 3]; r >= 0 && c >= 0)
          matrix(r, c) += k[i][j];
  }
  // σ_xx = −κ E/(1 − ν²) y on the end face, consistent nodal forces: ∫ N σ over the depth, h/6 (2 σ_a + σ_b).
  const double modulus = plate.young_modulus / (1 - poisson_ratio * poisson_ratio);
  const Surface end = boundary_surface(body.dof_handler(), 1);
  for (std::size_t k = 0; k < end.size(); ++k)
    for (const unsigned int node : end.face(k))
    {
      const double y = body.node_position()[node][1];
      double other = y;
      for (const unsigned int neighbour : end.face(k))
        if (std::abs(body.node_position()[neighbour][1] - y) > 1e-9)
          other = body.node_position()[neighbour][1];
      force(number[3 * node]) -= curvature * modulus * (depth / n_depth) / 6 * (2 * y + other) * 0.25 / 2;
    }
  matrix.gauss_jordan();
  matrix.vmult(u, force);
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    if (const auto &x = body.node_position()[node]; x[0] > length - 1e-9 && std::abs(x[1]) < 1e-9)
      return u(number[3 * node + 1]) / (0.5 * curvature * length * length);
  return 0;
}

} // namespace

TEST_CASE("B-bar bends a nearly incompressible strip, full integration locks", "[fe]")
{
  const double bbar_4 = bending_ratio(0.499, 4, true), bbar_8 = bending_ratio(0.499, 8, true);
  const double full_4 = bending_ratio(0.499, 4, false), full_8 = bending_ratio(0.499, 8, false);
  const double soft_8 = bending_ratio(0.145, 8, false);
  INFO("tip deflection over exact at nu = 0.499: B-bar " << bbar_4 << " (4 elements over the depth), " << bbar_8
                                                         << " (8); full integration " << full_4 << ", " << full_8
                                                         << "; full at nu = 0.145 " << soft_8);
  CHECK(bbar_4 == Approx(1).margin(0.06));
  CHECK(bbar_8 == Approx(1).margin(0.015));
  CHECK(std::abs(bbar_8 - 1) < 0.35 * std::abs(bbar_4 - 1)); // second order
  CHECK(full_4 < 0.5);
  CHECK(full_8 < 0.8);
}
