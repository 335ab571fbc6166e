// Bodies of rubber-like materials at large strain and rotation, elements of 8 and of 27 nodes.

#include "dem/core/error.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include "tests/deform.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

using namespace bergamo::fe;

namespace
{

constexpr ElasticParameters rubber{.young_modulus = 1.5e6, .poisson_ratio = 0.45, .density = 1100};

std::vector<Material> materials()
{
  return {NeoHooke(rubber), MooneyRivlin({.elastic = rubber}), Ogden(OgdenParameters())};
}

ExplicitBody box(const Material &material, const unsigned int degree, const std::array<unsigned int, 3> &subdivisions,
                 const double distortion)
{
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {0.1, 0.13, 0.08}, subdivisions}, mesh);
  if (distortion > 0)
    dealii::GridTools::distort_random(distortion, mesh, /*keep_boundary=*/false, /*seed=*/7);
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.degree = degree;
  return ExplicitBody(mesh, parameters);
}

void step(ExplicitBody &body, const double dt)
{
  body.compute_internal_force();
  body.kick(dt);
  body.drift(dt);
}

/// Which nodes lie on the surface.
std::vector<bool> on_surface(const ExplicitBody &body)
{
  std::vector<bool> result(body.n_nodes(), false);
  for (unsigned int id = 0; id < 6; ++id)
    for (const unsigned int node : body.boundary_nodes(id))
      result[node] = true;
  return result;
}

} // namespace

TEST_CASE("large strain, patch test: a uniform deformation strains uniformly and leaves inner nodes in balance", "[fe]")
{
  const Tensor3<double> f{{{1.3, 0.2, -0.1}, {-0.15, 0.85, 0.25}, {0.1, -0.05, 1.1}}};
  for (const Material &material : materials())
    for (const unsigned int degree : {1u, 2u})
    {
      CAPTURE(material.index(), degree);
      ExplicitBody body = box(material, degree, {3, 3, 3}, 0.2);
      deform(body, f);
      body.compute_internal_force();
      const Tensor3<double> minors = cofactor(f);
      const double ratio = determinant(f, minors);
      Tensor3<double> piola{};
      std::visit(
          [&](const auto &law)
          {
            if constexpr (requires { law.volumetric(); })
              piola = first_piola(law, f);
          },
          material);
      const double modulus = std::visit([](const auto &law) { return law.bulk_modulus(); }, material);
      constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
      const Stress stress = body.average_stress();
      for (int c = 0; c < 6; ++c)
      {
        double expected = 0;
        for (int k = 0; k < 3; ++k)
          expected += piola[row[c]][k] * f[column[c]][k] / ratio;
        CHECK(stress[c] == Approx(expected).margin(1e-11 * modulus));
      }
      const std::vector<bool> surface = on_surface(body);
      REQUIRE(std::count(surface.begin(), surface.end(), false) > 0);
      for (std::size_t node = 0; node < body.n_nodes(); ++node)
        for (int i = 0; i < 3; ++i)
          if (!surface[node])
            REQUIRE(std::abs(body.internal_force()[3 * node + i]) < 1e-12 * modulus * 0.1 * 0.1);
    }
}

TEST_CASE("large strain: a body turned by any angle has no stress", "[fe]")
{
  const double angle = 2.1, c = std::cos(angle), s = std::sin(angle);
  const Tensor3<double> rotation{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
  for (const Material &material : materials())
    for (const unsigned int degree : {1u, 2u})
    {
      ExplicitBody body = box(material, degree, {2, 2, 2}, 0.2);
      deform(body, rotation);
      body.compute_internal_force();
      for (const double force : body.internal_force())
        REQUIRE(std::abs(force) < 1e-12 * 5e6 * 0.1 * 0.1);
      CHECK(std::abs(body.elements().elastic_energy()) < 1e-12 * 5e6 * 1e-3);
    }
}

TEST_CASE("lumped masses are positive and make up the body's mass, whatever the mesh", "[fe]")
{
  for (const unsigned int degree : {1u, 2u})
  {
    const ExplicitBody body = box(NeoHooke(rubber), degree, {3, 2, 4}, 0.3);
    double volume = 0;
    for (std::size_t e = 0; e < body.n_elements(); ++e)
      volume += body.elements().volume(e);
    CHECK(*std::min_element(body.mass().begin(), body.mass().end()) > 0);
    CHECK(std::accumulate(body.mass().begin(), body.mass().end(), 0.) / 3 == Approx(rubber.density * volume));
  }
  // On a brick the 27 nodes have Simpson's weights: corners 1/216, the middle 64/216.
  const ExplicitBody brick = box(NeoHooke(rubber), 2, {1, 1, 1}, 0);
  const double whole = rubber.density * 0.1 * 0.13 * 0.08;
  CHECK(*std::min_element(brick.mass().begin(), brick.mass().end()) == Approx(whole / 216));
  CHECK(*std::max_element(brick.mass().begin(), brick.mass().end()) == Approx(64 * whole / 216));
}

TEST_CASE("large strain: the bound of the stable step against the true one, at rest and stretched", "[fe]")
{
  for (const Material &material : materials())
    for (const unsigned int degree : {1u, 2u})
      for (const double stretch : {1., 1.8})
      {
        CAPTURE(material.index(), degree, stretch);
        ExplicitBody body = box(material, degree, {2, 2, degree == 1 ? 2u : 1u}, 0.15);
        deform(body, {{{stretch, 0, 0}, {0, 1 / std::sqrt(stretch), 0}, {0, 0, 1 / std::sqrt(stretch)}}});
        const unsigned int n = 3 * body.n_nodes();
        dealii::LAPACKFullMatrix<double> matrix(n);
        const std::size_t n_element = body.elements().dofs_per_element();
        std::vector<double> k(n_element * n_element);
        for (std::size_t e = 0; e < body.n_elements(); ++e)
        {
          body.elements().stiffness(e, body.displacement().data(), k.data());
          const auto nodes = body.element_nodes(e);
          for (std::size_t i = 0; i < n_element; ++i)
            for (std::size_t j = 0; j < n_element; ++j)
            {
              const unsigned int r = 3 * nodes[i / 3] + i % 3, c = 3 * nodes[j / 3] + j % 3;
              matrix(r, c) += k[n_element * i + j] / std::sqrt(body.mass()[r] * body.mass()[c]);
            }
        }
        matrix.compute_eigenvalues();
        double largest = 0;
        for (unsigned int i = 0; i < n; ++i)
          largest = std::max(largest, matrix.eigenvalue(i).real());
        const double bound = stable_step(body).time_step * std::sqrt(largest) / 2;
        CHECK(bound <= 1 + 1e-6);
        CHECK(bound > 0.6);
      }
}

TEST_CASE("large strain: the energy of a swinging body closes at second order in the time step", "[fe]")
{
  for (const Material &material : materials())
    for (const unsigned int degree : {1u, 2u})
    {
      CAPTURE(material.index(), degree);
      std::vector<double> worst;
      for (const int refined : {1, 2, 4})
      {
        ExplicitBody body = box(material, degree, {2, 2, 2}, 0.1);
        deform(body, {{{1.3, 0.1, 0}, {0, 0.9, 0}, {0, 0, 0.9}}});
        const double dt = 0.4 * stable_step(body).time_step / refined;
        double error = 0, scale = 0;
        for (int k = 0; k < 200 * refined; ++k)
        {
          body.compute_internal_force();
          body.kick(dt);
          if (k > 0)
          {
            error = std::max(error, std::abs(body.energy().residual()));
            scale = std::max(scale, body.energy().elastic);
          }
          body.drift(dt);
        }
        worst.push_back(error / scale);
      }
      CHECK(worst[2] < 1e-3);
      CHECK(std::log2(worst[1] / worst[2]) == Approx(2).margin(0.3));
    }
}

TEST_CASE("large strain: the same bits on any number of threads", "[fe]")
{
  std::vector<double> first;
  for (const int threads : {1, 2, 3, 8})
  {
    const Threads team(threads);
    ExplicitBody body = box(Ogden(OgdenParameters()), 1, {9, 7, 6}, 0.2);
    deform(body, {{{1.2, 0.1, 0}, {0, 0.9, 0}, {0, 0, 0.95}}});
    const double dt = 0.5 * stable_step(body).time_step;
    for (int k = 0; k < 20; ++k)
      step(body, dt);
    const std::vector<double> now(body.displacement().begin(), body.displacement().end());
    if (first.empty())
      first = now;
    CHECK(std::memcmp(first.data(), now.data(), now.size() * sizeof(double)) == 0);
  }
}

TEST_CASE("large strain: an element that turns inside out ends the run with its place", "[fe]")
{
  ExplicitBody body = box(NeoHooke(rubber), 1, {2, 2, 2}, 0);
  const auto corner = std::find(body.node_position().begin(), body.node_position().end(), std::array{0.1, 0.13, 0.08});
  REQUIRE(corner != body.node_position().end());
  for (int i = 0; i < 3; ++i)
    body.displacement()[3 * (corner - body.node_position().begin()) + i] = -0.1;
  CHECK_THROWS_WITH(body.compute_internal_force(), Catch::Contains("element 7 at (") && Catch::Contains("inside out") &&
                                                       Catch::Contains("smaller time step"));
}

TEST_CASE("materials and elements that do not go together are refused", "[fe]")
{
  CHECK_THROWS_WITH(box(NeoHooke(rubber), 3, {1, 1, 1}, 0), Catch::Contains("degree = 3"));
  dealii::Triangulation<3> mesh;
  make_box({}, mesh);
  ExplicitBodyParameters parameters;
  parameters.material = NeoHooke(rubber);
  parameters.initial_stress = uniform_pressure(1e3);
  CHECK_THROWS_WITH(ExplicitBody(mesh, parameters), Catch::Contains("initial_stress"));
  ExplicitBody body = box(NeoHooke(rubber), 1, {1, 1, 1}, 0);
  CHECK_THROWS_WITH(body.set_share(std::vector<double>(8, 0.5)), Catch::Contains("large strain"));
}
