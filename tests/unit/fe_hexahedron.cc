#include "fe_dealii/element/small_strain_hexahedra.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"
#include "tests/unit/fe_dynamic_matrix.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <complex>
#include <random>

using namespace bergamo::fe;

namespace
{

ExplicitBody distorted_box(const unsigned int n, const ExplicitBodyParameters &parameters = {})
{
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 1.3, 0.8}, {n, n, n}}, mesh);
  dealii::GridTools::distort_random(0.25, mesh, /*keep_boundary=*/false, /*seed=*/11);
  return ExplicitBody(mesh, parameters);
}

// A body that never yields.
ExplicitBodyParameters strong(const double poisson_ratio = 0.3)
{
  ExplicitBodyParameters parameters;
  parameters.material = MohrCoulomb({.poisson_ratio = poisson_ratio, .cohesion = 1e12});
  return parameters;
}

const SmallStrainHexahedra<MohrCoulomb> &sand(const ExplicitBody &body)
{
  return dynamic_cast<const SmallStrainHexahedra<MohrCoulomb> &>(body.elements());
}

} // namespace

TEST_CASE("Patch test: a linear displacement on a distorted mesh strains uniformly and leaves inner nodes in balance",
          "[fe]")
{
  ExplicitBody body = distorted_box(3, strong());
  const double gradient[3][3] = {{1e-3, -2e-4, 5e-4}, {3e-4, -7e-4, 1e-4}, {-4e-4, 6e-4, 2e-4}};
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        body.displacement()[3 * node + i] += gradient[i][j] * body.node_position()[node][j];
  body.compute_internal_force();
  const Strain strain{gradient[0][0],
                      gradient[1][1],
                      gradient[2][2],
                      gradient[0][1] + gradient[1][0],
                      gradient[1][2] + gradient[2][1],
                      gradient[2][0] + gradient[0][2]};
  const Stress expected = std::get<MohrCoulomb>(body.material()).elastic_stress(strain);
  for (std::size_t e = 0; e < body.n_elements(); ++e)
    for (int point = 0; point < 8; ++point)
      for (int i = 0; i < 6; ++i)
        REQUIRE(sand(body).stress(e, point)[i] == Approx(expected[i]).margin(1e-7)); // of 1e5 Pa
  std::vector<bool> outer(body.n_nodes(), false);
  for (unsigned int id = 0; id < 6; ++id)
    for (const unsigned int node : body.boundary_nodes(id))
      outer[node] = true;
  int inner = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    for (int i = 0; i < 3; ++i)
      if (!outer[node])
      {
        ++inner;
        REQUIRE(std::abs(body.internal_force()[3 * node + i]) < 1e-8);
      }
  CHECK(inner == 24);
  for (int i = 0; i < 6; ++i)
    CHECK(body.average_stress()[i] == Approx(expected[i]));
}

TEST_CASE("Patch test: rigid motion of a distorted mesh strains nothing", "[fe]")
{
  ExplicitBody body = distorted_box(3, strong());
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const auto &x = body.node_position()[node];
    body.displacement()[3 * node] = 0.1 - 1e-3 * x[1] + 2e-3 * x[2];
    body.displacement()[3 * node + 1] = -0.2 + 1e-3 * x[0] - 3e-3 * x[2];
    body.displacement()[3 * node + 2] = 0.3 - 2e-3 * x[0] + 3e-3 * x[1];
  }
  body.compute_internal_force();
  for (std::size_t e = 0; e < body.n_elements(); ++e)
    for (int point = 0; point < 8; ++point)
      for (int i = 0; i < 6; ++i)
        REQUIRE(std::abs(sand(body).stress(e, point)[i]) < 1e-6); // against E = 6e7 Pa
}

TEST_CASE("Internal force is work-conjugate to the strain, the stiffness symmetric with six rigid modes", "[fe]")
{
  const ExplicitBody body = distorted_box(1, strong(0.4));
  const auto &geometry = sand(body).geometry(0);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Points stress[6], strain[6];
  for (auto &component : stress)
    for (int point = 0; point < 8; ++point)
      component[point] = normal(random);
  double u[24], force[24], work = 0, virtual_work = 0;
  for (double &x : u)
    x = normal(random);
  hexahedron::strain(geometry, u, strain);
  hexahedron::internal_force(geometry, stress, force);
  for (int i = 0; i < 24; ++i)
    work += force[i] * u[i];
  for (int i = 0; i < 6; ++i)
    virtual_work += sum(geometry.share_volume * stress[i] * strain[i]);
  CHECK(work == Approx(virtual_work).epsilon(1e-12));

  dealii::LAPACKFullMatrix<double> k(24);
  double raw[24][24];
  body.elements().stiffness(0, body.displacement().data(), &raw[0][0]);
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j)
    {
      REQUIRE(raw[i][j] == Approx(raw[j][i]).margin(1e-7));
      k(i, j) = raw[i][j];
    }
  k.compute_eigenvalues();
  int zero = 0;
  for (int i = 0; i < 24; ++i)
    zero += std::abs(k.eigenvalue(i)) < 1e-3; // against 1e6 and more
  CHECK(zero == 6);                           // no hourglass mode
}

TEST_CASE("Stable step: a safe bound on the true limit, of the order of h/c_p", "[fe]")
{
  for (const bool shared : {false, true})
  {
    ExplicitBody body = distorted_box(3, strong(0.2));
    if (shared)
    {
      std::vector<double> weight(body.n_nodes());
      for (std::size_t node = 0; node < weight.size(); ++node)
        weight[node] = std::min(0.99, std::max(0.01, body.node_position()[node][0]));
      body.set_share(weight);
    }
    const StableStep step = stable_step(body);
    const double largest = true_largest_eigenvalue(body);
    CHECK(step.largest_eigenvalue >= largest);
    CHECK(step.largest_eigenvalue < 2 * largest);
    CHECK(step.time_step == Approx(2 / std::sqrt(step.largest_eigenvalue)));
  }
  // A cube: the element's own eigenvalue, by LAPACK, is met from above within 0.4 %.
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {0.1, 0.1, 0.1}, {1, 1, 1}}, mesh);
  const ExplicitBody cube(mesh, strong(0.2));
  const double largest = true_largest_eigenvalue(cube);
  const StableStep step = stable_step(cube);
  CHECK(step.largest_eigenvalue >= largest * (1 - 1e-12));
  CHECK(step.largest_eigenvalue <= largest * 1.004);
  const double crossing = 0.1 / p_wave_speed(cube.material());
  CHECK(step.time_step < 1.05 * crossing);
  CHECK(step.time_step > 0.5 * crossing);
}

TEST_CASE("A time step above the stable one is refused with the element that sets it", "[fe]")
{
  ExplicitBody body = distorted_box(2, strong(0.2));
  const StableStep stable = stable_step(body);
  CHECK_NOTHROW(require_stable(body, stable.time_step));
  CHECK_THROWS_WITH(require_stable(body, 1.001 * stable.time_step),
                    Catch::Contains("above the stable one") &&
                        Catch::Contains("element " + std::to_string(stable.element) + " at ("));
  // A place is that of the present displacement.
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    body.displacement()[3 * node] = 1000;
  CHECK(body.present_centre(stable.element)[0] > 999);
}

TEST_CASE("Stable step: 0.95 of it stays bounded, 1.1 of the true limit diverges", "[fe]")
{
  const auto growth = [](const bool beyond)
  {
    ExplicitBody body = distorted_box(2, strong(0.2));
    const double dt = beyond ? 1.1 * 2 / std::sqrt(true_largest_eigenvalue(body)) : 0.95 * stable_step(body).time_step;
    std::mt19937_64 random(3);
    for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
      body.velocity()[dof] = std::normal_distribution<double>()(random);
    const double start = body.max_velocity();
    double greatest = 0;
    for (int step = 0; step < 600; ++step)
    {
      body.compute_internal_force();
      body.kick(dt);
      body.drift(dt);
      greatest = std::max(greatest, body.max_velocity());
    }
    return greatest / start;
  };
  CHECK(growth(false) < 10);
  CHECK(growth(true) > 1e5);
}
