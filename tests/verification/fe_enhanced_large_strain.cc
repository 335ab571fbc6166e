// Hexahedra of 8 nodes at large strain whose hourglass modes have the stiffness of enhanced strains.

#include "fe_dealii/explicit_body.h"
#include "fe_dealii/material/hyperelastic.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"
#include "tests/verification/fe_static.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace bergamo::fe;

namespace
{

constexpr ElasticParameters rubber{.young_modulus = 1.5e6, .poisson_ratio = 0.45, .density = 1100};

std::vector<Material> materials()
{
  return {NeoHooke(rubber), MooneyRivlin({.elastic = rubber}), Ogden(OgdenParameters())};
}

ExplicitBody box(const Material &material, const BoxMeshParameters &shape, const double distortion,
                 const Strains strains = Strains::enhanced)
{
  dealii::Triangulation<3> mesh;
  make_box(shape, mesh);
  if (distortion > 0)
    dealii::GridTools::distort_random(distortion, mesh, /*keep_boundary=*/false, /*seed=*/7);
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.strains = strains;
  return ExplicitBody(mesh, parameters);
}

void deform(ExplicitBody &body, const Tensor3<double> &f)
{
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    for (int i = 0; i < 3; ++i)
    {
      double &u = body.displacement()[3 * node + i];
      u = -body.node_position()[node][i];
      for (int j = 0; j < 3; ++j)
        u += f[i][j] * body.node_position()[node][j];
    }
}

constexpr BoxMeshParameters block{{0, 0, 0}, {0.1, 0.13, 0.08}, {3, 3, 3}};

} // namespace

TEST_CASE("enhanced at large strain, patch test: a uniform deformation strains uniformly on a distorted mesh", "[fe]")
{
  const Tensor3<double> f{{{1.3, 0.2, -0.1}, {-0.15, 0.85, 0.25}, {0.1, -0.05, 1.1}}};
  for (const Material &material : materials())
  {
    CAPTURE(material.index());
    ExplicitBody body = box(material, block, 0.2);
    deform(body, f);
    body.compute_internal_force();
    const double modulus = std::visit([](const auto &law) { return law.bulk_modulus(); }, material);
    double density = 0;
    std::visit(
        [&](const auto &law)
        {
          if constexpr (requires { law.volumetric(); })
            density = energy_density(law, f);
        },
        material);
    double volume = 0;
    for (std::size_t e = 0; e < body.n_elements(); ++e)
      volume += body.elements().volume(e);
    CHECK(body.elements().elastic_energy() == Approx(density * volume).epsilon(1e-12));
    std::vector<bool> surface(body.n_nodes(), false);
    for (unsigned int id = 0; id < 6; ++id)
      for (const unsigned int node : body.boundary_nodes(id))
        surface[node] = true;
    for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
      if (!surface[dof / 3])
        REQUIRE(std::abs(body.internal_force()[dof]) < 1e-12 * modulus * 0.1 * 0.1);
  }
}

TEST_CASE("enhanced at large strain: a body turned by any angle has no stress", "[fe]")
{
  const double angle = 2.1, c = std::cos(angle), s = std::sin(angle);
  for (const Material &material : materials())
  {
    ExplicitBody body = box(material, block, 0.2);
    deform(body, {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}});
    body.compute_internal_force();
    for (const double force : body.internal_force())
      REQUIRE(std::abs(force) < 1e-12 * 5e6 * 0.1 * 0.1);
  }
}

TEST_CASE("enhanced at large strain: at rest the stiffness is that of small strain, and six modes have none", "[fe]")
{
  for (const double poisson_ratio : {0.3, 0.499})
  {
    const ElasticParameters elastic{.young_modulus = 1.5e6, .poisson_ratio = poisson_ratio, .density = 1100};
    const BoxMeshParameters one{{0, 0, 0}, {0.3, 0.13, 0.08}, {1, 1, 1}};
    const ExplicitBody large = box(NeoHooke(elastic), one, 0.2), small = box(LinearElastic(elastic), one, 0.2);
    std::vector<double> a(24 * 24), b(24 * 24);
    large.elements().stiffness(0, large.displacement().data(), a.data());
    small.elements().stiffness(0, small.displacement().data(), b.data());
    const double largest = *std::max_element(b.begin(), b.end());
    for (int k = 0; k < 24 * 24; ++k)
      REQUIRE(a[k] == Approx(b[k]).margin(1e-7 * largest)); // of differences
  }
}

TEST_CASE("enhanced at large strain: compression to a third leaves every hourglass stiff", "[fe]")
{
  for (const Material &material : materials())
  {
    ExplicitBody body = box(material, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, 0);
    const Tensor3<double> f{{{0.33, 0, 0}, {0, 1.6, 0}, {0, 0, 1.6}}};
    deform(body, f);
    std::vector<double> k(24 * 24);
    body.elements().stiffness(0, body.displacement().data(), k.data());
    // Of a cube the four products of coordinates at its corners are the modes.
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 200; ++trial)
    {
      double amplitude[4][3], x[24] = {}, work = 0, square = 0;
      for (auto &mode : amplitude)
        for (double &a : mode)
          a = normal(random);
      for (int node = 0; node < 8; ++node)
      {
        const int xi = node & 1 ? 1 : -1, eta = node & 2 ? 1 : -1, zeta = node & 4 ? 1 : -1;
        const int mode[4] = {eta * zeta, zeta * xi, xi * eta, xi * eta * zeta};
        for (int m = 0; m < 4; ++m)
          for (int i = 0; i < 3; ++i)
            x[3 * node + i] += mode[m] * amplitude[m][i];
      }
      for (int r = 0; r < 24; ++r)
      {
        square += x[r] * x[r];
        for (int c = 0; c < 24; ++c)
          work += x[r] * k[24 * r + c] * x[c];
      }
      REQUIRE(work > 1e-3 * 1e5 * square);
    }
  }
}

TEST_CASE("enhanced at large strain: a cantilever bends to the elastica, one element over the thickness", "[fe]")
{
  // Mattiasson, Int. J. Numer. Meth. Eng. 17 (1981) 145-153: deflection and shortening over L at P L²/EI = 1, 2, 5.
  constexpr double length = 40, young = 1e7, inertia = 1. / 12;
  for (const double poisson_ratio : {0.3, 0.499})
    for (const double ratio : {5., 2.5, 1.})
    {
      CAPTURE(poisson_ratio, ratio);
      const NeoHooke law({.young_modulus = young, .poisson_ratio = poisson_ratio, .density = 1000});
      const unsigned int n = std::lround(length / ratio);
      ExplicitBody body = box(law, {{0, -0.5, -0.5}, {length, 0.5, 0.5}, {n, 1, 1}}, 0);
      for (const unsigned int node : body.boundary_nodes(0))
        for (int i = 0; i < 3; ++i)
        {
          const unsigned int one[] = {node};
          const auto &[x, y, z] = body.node_position()[node];
          if (i == 0 || (i == 1 && y < 0) || (i == 2 && z < 0))
            body.prescribe_velocity(one, i);
        }
      const std::array<std::array<double, 3>, 3> exact{
          {{1, 0.30172, 0.05643}, {2, 0.49346, 0.16064}, {5, 0.71379, 0.38763}}};
      for (const auto &[load, deflection, shortening] : exact)
      {
        body.clear_external_force();
        for (const unsigned int node : body.boundary_nodes(1))
          body.external_force()[3 * node + 2] = load * young * inertia / (length * length) / 4;
        find_equilibrium(body, {.tolerance = 1e-8});
        double w = 0, u = 0;
        for (const unsigned int node : body.boundary_nodes(1))
        {
          w += body.displacement()[3 * node + 2] / 4 / length;
          u -= body.displacement()[3 * node] / 4 / length;
        }
        CAPTURE(load, w, u);
        CHECK(w == Approx(deflection).epsilon(0.02));
        CHECK(u == Approx(shortening).epsilon(0.04));
      }
    }
}
