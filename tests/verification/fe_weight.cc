// Gravity as a body force, ∫ N ρ g dV, on meshes that are no bricks.

#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/equilibrium/static_equilibrium.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace bergamo::fe;

namespace
{

constexpr double gravity = 9.81;
constexpr ElasticParameters rock{.young_modulus = 1e7, .poisson_ratio = 0.25, .density = 2000};

ExplicitBodyParameters heavy(const Material &material, const unsigned int degree)
{
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.degree = degree;
  parameters.gravity = {0, 0, -gravity};
  return parameters;
}

ExplicitBody distorted_box(const BoxMeshParameters &box, const ExplicitBodyParameters &parameters)
{
  dealii::Triangulation<3> mesh;
  make_box(box, mesh);
  dealii::GridTools::distort_random(0.2, mesh, /*keep_boundary=*/true, /*seed=*/5);
  return ExplicitBody(mesh, parameters);
}

/// Rollers at the sides and the bottom.
void hold(ExplicitBody &body)
{
  for (unsigned int id = 0; id < 5; ++id)
    body.prescribe_velocity(id, id / 2);
}

/// Root mean square of the error of a column's settlement u_z = −ρ g (H z − z²/2)/M, over the largest one.
double error_of_settlement(const unsigned int refinement, const ExplicitBodyParameters &parameters)
{
  const unsigned int n = 2 * refinement;
  const double height = 2, modulus = rock.bulk_modulus() + 4 * rock.shear_modulus() / 3;
  ExplicitBody body = distorted_box({{0, 0, 0}, {1, 1, height}, {n, n, 2 * n}}, parameters);
  hold(body);
  find_equilibrium(body, {.tolerance = 1e-13, .direct_limit = 100000});
  double square = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const double z = body.node_position()[node][2];
    const double exact = -rock.density * gravity * (height * z - z * z / 2) / modulus;
    square += std::pow(body.displacement()[3 * node + 2] - exact, 2) / body.n_nodes();
  }
  return std::sqrt(square) / (rock.density * gravity * height * height / (2 * modulus));
}

} // namespace

TEST_CASE("the weight of a frustum acts in the frustum's centre, whatever element it is", "[fe]")
{
  // h/4 (A + 2 √(A a) + 3 a)/(A + √(A a) + a) above the base, of areas A and a = A/4 at the height h = 1: 11/28.
  const Material materials[] = {LinearElastic(rock), NeoHooke(rock)};
  const Material &material = materials[GENERATE(0, 1)];
  const unsigned int degree = GENERATE(1u, 2u);
  CAPTURE(material.index(), degree);
  dealii::Triangulation<3> mesh;
  make_box({{-0.5, -0.5, 0}, {0.5, 0.5, 1}, {1, 1, 1}}, mesh);
  dealii::GridTools::transform([](const dealii::Point<3> &p)
                               { return dealii::Point<3>((1 - 0.5 * p[2]) * p[0], (1 - 0.5 * p[2]) * p[1], p[2]); },
                               mesh);
  const ExplicitBody body(mesh, heavy(material, degree));
  double weight = 0, moment = 0, mass = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    weight -= body.weight(3 * node + 2);
    moment -= body.weight(3 * node + 2) * body.node_position()[node][2];
    mass += body.mass()[3 * node + 2];
    CHECK(body.mass()[3 * node + 2] > 0);
    if (degree == 1) // falls as one
      CHECK(body.weight(3 * node + 2) == Approx(-gravity * body.mass()[3 * node + 2]).epsilon(1e-13));
  }
  CHECK(weight == Approx(rock.density * gravity * 7 / 12).epsilon(1e-13));
  CHECK(mass * gravity == Approx(weight).epsilon(1e-13));
  CHECK(moment / weight == Approx(11. / 28).epsilon(1e-13));
}

TEST_CASE("a column under its own weight on a distorted mesh: exact with 27 nodes, of second order with 8", "[fe]")
{
  // The settlement is a parabola, which triquadratic elements hold on any mesh of straight edges.
  CHECK(error_of_settlement(1, heavy(LinearElastic(rock), 2)) < 1e-12);
  const double coarse = error_of_settlement(3, heavy(LinearElastic(rock), 1)),
               fine = error_of_settlement(5, heavy(LinearElastic(rock), 1));
  CAPTURE(coarse, fine);
  CHECK(fine < coarse * std::pow(3. / 5, 1.5)); // of first order it would be more, whatever the random meshes add
}

TEST_CASE("a column at large strain settles as at small strain where its weight is small, on a distorted mesh", "[fe]")
{
  // ρ g H/M is 3e-3: the settlement differs from the linear one by that share, the mesh does the rest.
  CHECK(error_of_settlement(1, heavy(NeoHooke(rock), 2)) < 5e-3);
  CHECK(error_of_settlement(2, heavy(NeoHooke(rock), 1)) < 0.015);
}

TEST_CASE("ground at rest under its K0 stress on a distorted mesh starts and stays in balance, and keeps its books",
          "[fe]")
{
  const MohrCoulombParameters sand{.young_modulus = 40e6, .poisson_ratio = 0.3, .friction_angle = 30, .density = 1800};
  const unsigned int degree = GENERATE(1u, 2u);
  const bool bends = GENERATE(false, true);
  if (degree == 2 && bends)
    return;
  CAPTURE(degree, bends);
  ExplicitBodyParameters parameters = heavy(MohrCoulomb(sand), degree);
  parameters.kind.hourglass = bends ? Hourglass::bending : Hourglass::at_points;
  parameters.initial_stress = geostatic_stress(
      {.surface_height = 4, .unit_weight = sand.density * gravity, .earth_pressure_at_rest = 0.5, .surcharge = 5e3});
  ExplicitBody body = distorted_box({{0, 0, 0}, {2, 3, 4}, {2, 3, 4}}, parameters);
  hold(body);
  SurfaceLoad(boundary_surface(body.dof_handler(), 5), body.node_position())
      .add_traction({0, 0, -5e3}, body.external_force());
  const EquilibriumReport report = find_equilibrium(body);
  CHECK(report.residual.size() == 1); // nothing to do
  CHECK(report.residual[0] < 1e-13);

  const double dt = 0.8 * stable_step(body).time_step;
  const auto run = [&](const int n_steps)
  {
    double largest = 0;
    for (int k = 0; k < n_steps; ++k)
    {
      body.compute_internal_force();
      body.kick(dt);
      largest = std::max(largest, std::abs(body.energy().residual()));
      body.drift(dt);
    }
    return largest;
  };
  run(300);
  CHECK(body.max_velocity() < 1e-11 * gravity * 4 / 170); // what a wave's time of free fall over the body gives
  const auto side = body.prescribe_velocity(1u, 1);
  body.set_velocity(side, 0.05);
  CHECK(run(300) < 1e-12 * body.energy().elastic); // rounding of what is summed up
}
