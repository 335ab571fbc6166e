// Triquadratic hexahedra at small strain, and a stiffness that grows with the pressure, as bodies.

#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace bergamo::fe;

namespace
{

constexpr ElasticParameters steel{.young_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800};

ExplicitBody body_of(const BoxMeshParameters &shape, const ExplicitBodyParameters &parameters, const double distortion)
{
  dealii::Triangulation<3> mesh;
  make_box(shape, mesh);
  if (distortion > 0)
    dealii::GridTools::distort_random(distortion, mesh, /*keep_boundary=*/false, /*seed=*/3);
  return ExplicitBody(mesh, parameters);
}

ExplicitBodyParameters quadratic(const Material &material)
{
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.degree = 2;
  return parameters;
}

} // namespace

TEST_CASE("27 nodes, patch test: a uniform strain on a distorted mesh, and rigid rotation", "[fe]")
{
  for (const Material &material : {Material(LinearElastic(steel)), Material(MohrCoulomb({.cohesion = 1e12}))})
  {
    CAPTURE(material.index());
    ExplicitBody body = body_of({{0, 0, 0}, {1, 1.2, 0.7}, {2, 3, 2}}, quadratic(material), 0.2);
    const double gradient[3][3] = {{1e-3, -2e-4, 5e-4}, {3e-4, -7e-4, 1e-4}, {-4e-4, 6e-4, 2e-4}};
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          body.displacement()[3 * node + i] += gradient[i][j] * body.node_position()[node][j];
    body.compute_internal_force();
    double k = 0, g = 0;
    std::visit(
        [&](const auto &law)
        {
          k = law.bulk_modulus();
          g = law.shear_modulus();
        },
        material);
    const double dilatation = gradient[0][0] + gradient[1][1] + gradient[2][2];
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (std::size_t e = 0; e < body.n_elements(); ++e)
    {
      const Stress stress = body.state_of(e).stress;
      for (int c = 0; c < 6; ++c)
      {
        const double expected = g * (gradient[row[c]][column[c]] + gradient[column[c]][row[c]]) +
                                (c < 3 ? (k - 2 * g / 3) * dilatation : 0);
        REQUIRE(stress[c] == Approx(expected).margin(1e-12 * k));
      }
    }
    double resultant[3] = {};
    for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
      resultant[dof % 3] += body.internal_force()[dof];
    for (const double r : resultant)
      CHECK(std::abs(r) < 1e-13 * k);
  }
}

TEST_CASE("27 nodes: pure bending is exact, one element over the depth and nearly incompressible too", "[fe]")
{
  // u of a beam bent to the curvature κ about y, with no stress across: sigma_xx = −E κ z, and no forces inside.
  for (const double poisson_ratio : {0., 0.3, 0.499})
  {
    const ElasticParameters rubber{.young_modulus = 1e6, .poisson_ratio = poisson_ratio, .density = 1000};
    ExplicitBody body = body_of({{0, -0.1, -0.1}, {1, 0.1, 0.1}, {4, 1, 1}}, quadratic(LinearElastic(rubber)), 0);
    const double curvature = 1e-3, nu = poisson_ratio;
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const auto &[x, y, z] = body.node_position()[node];
      body.displacement()[3 * node] = -curvature * x * z;
      body.displacement()[3 * node + 1] = nu * curvature * y * z;
      body.displacement()[3 * node + 2] = 0.5 * curvature * (x * x + nu * (z * z - y * y));
    }
    body.compute_internal_force();
    const double edge_stress = 1e6 * curvature * 0.1;
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const double x = body.node_position()[node][0];
      if (x > 1e-9 && x < 1 - 1e-9) // no loads on the sides
        for (int i = 0; i < 3; ++i)
          REQUIRE(std::abs(body.internal_force()[3 * node + i]) < 1e-9 * edge_stress * 0.04);
    }
    // Half of E I κ² per length is stored.
    const double inertia = 0.2 * std::pow(0.2, 3) / 12;
    CHECK(body.elements().elastic_energy() == Approx(0.5 * 1e6 * inertia * curvature * curvature).epsilon(1e-9));
  }
}

TEST_CASE("a sand whose stiffness grows with the pressure keeps the account of its energy", "[fe]")
{
  for (const auto &[degree, hourglass] :
       {std::pair(1u, Hourglass::at_points), {1u, Hourglass::bending}, {2u, Hourglass::at_points}})
  {
    CAPTURE(degree, hourglass == Hourglass::bending);
    ExplicitBodyParameters parameters;
    parameters.material = MohrCoulomb({.young_modulus = 60e6, .reference_pressure = 1e5});
    parameters.degree = degree;
    parameters.kind.hourglass = hourglass;
    parameters.initial_stress = uniform_pressure(2e4);
    ExplicitBody body = body_of({{0, 0, 0}, {1, 1, 1}, {4, 4, 3}}, parameters, 0.15);
    for (unsigned int id = 0; id < 5; ++id)
      body.prescribe_velocity(id, id / 2);
    const auto lid = body.prescribe_velocity(5u, 2);
    const double dt = 0.3 * stable_step(body).time_step;
    for (int k = 0; k < 400; ++k)
    {
      body.set_velocity(lid, -2 * std::sin(0.02 * k));
      body.compute_internal_force();
      body.kick(dt);
      if (k > 0)
      {
        const BodyEnergy e = body.energy();
        REQUIRE(std::abs(e.residual()) < 1e-12 * (e.kinetic + std::abs(e.boundary_work) + std::abs(e.elastic) + 1));
      }
      body.drift(dt);
    }
    CHECK(body.energy().plastic_dissipation > 0);
  }
}

TEST_CASE("the stable step of a sand under pressure follows its stiffness", "[fe]")
{
  ExplicitBodyParameters parameters;
  double step[2];
  for (int k = 0; k < 2; ++k)
  {
    parameters.material = MohrCoulomb({.reference_pressure = 1e5, .stiffness_exponent = 0.5});
    parameters.initial_stress = uniform_pressure(k == 0 ? 1e5 : 16e5);
    step[k] = stable_step(body_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, parameters, 0)).time_step;
  }
  CHECK(step[0] / step[1] == Approx(2).epsilon(1e-6)); // fourth root of the pressure
}
