// Mass scaling: a few thin elements get the inertia that a wanted time step takes, and nothing else changes.

#include "dem/core/error.h"
#include "fe_dealii/equilibrium/static_equilibrium.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

using namespace bergamo::fe;

namespace
{

constexpr double rho = 1800, side = 2, height = 3, gravity = 9.81;
constexpr double whole_mass = rho * side * side * height;

std::vector<Material> materials()
{
  return {LinearElastic({.young_modulus = 2e7, .poisson_ratio = 0.3, .density = rho}),
          NeoHooke({.young_modulus = 2e7, .poisson_ratio = 0.3, .density = rho})};
}

/// A column whose layers get thinner upwards, the last one 1/8 of the first; held below.
ExplicitBody column(const Material &material, const double wanted_time_step, const unsigned int degree = 1,
                    const double damping = 0)
{
  dealii::Triangulation<3> mesh;
  make_box({.minimum = {0, 0, 0}, .maximum = {side, side, height}, .subdivisions = {2, 2, 6}, .grading = {1, 1, 0.125}},
           mesh);
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.degree = degree;
  parameters.gravity = {0, 0, -gravity};
  parameters.damping = damping;
  parameters.wanted_time_step = wanted_time_step;
  ExplicitBody body(mesh, parameters);
  for (unsigned int i = 0; i < 3; ++i)
    body.prescribe_velocity(4, i);
  return body;
}

double inertia(const ExplicitBody &body)
{
  return std::accumulate(body.mass().begin(), body.mass().end(), 0.) / 3;
}

double step_of(const Material &material, const unsigned int degree)
{
  return stable_step(column(material, 0, degree)).time_step;
}

} // namespace

TEST_CASE("mass scaling: the wanted step is stable, and the mass that this adds is reported", "[fe]")
{
  for (const Material &material : materials())
    for (const unsigned int degree : {1u, 2u})
    {
      CAPTURE(material.index(), degree);
      const double own_step = step_of(material, degree), wanted = 1.8 * own_step;
      const ExplicitBody plain = column(material, 0, degree), scaled = column(material, wanted, degree);
      CHECK(plain.mass_scaling().n_elements == 0);
      CHECK(plain.mass_scaling().added_mass == 0);
      CHECK(inertia(plain) == Approx(whole_mass).epsilon(1e-12));

      CHECK(stable_step(scaled).time_step >= wanted);
      CHECK(stable_step(scaled).time_step == Approx(wanted).epsilon(1e-9)); // no more than it takes
      const MassScaling &report = scaled.mass_scaling();
      CHECK(inertia(scaled) - whole_mass == Approx(report.added_mass).epsilon(1e-9));
      CHECK(report.share == Approx(report.added_mass / whole_mass).epsilon(1e-12));
      CHECK(report.largest_factor == Approx(1.8 * 1.8).epsilon(1e-9));
      CHECK(report.n_elements % 4 == 0); // whole layers
      CHECK(report.n_elements > 0);
      CHECK(report.n_elements < scaled.n_elements());
      for (std::size_t e = 0; e < scaled.n_elements(); ++e)
        CHECK((scaled.mass_factor(e) > 1) == (e / 4 >= 6 - report.n_elements / 4)); // the thin ones, above
      // A step that all elements bear changes no bit.
      const ExplicitBody unchanged = column(material, 0.9 * own_step, degree);
      CHECK(unchanged.mass_scaling().n_elements == 0);
      CHECK(std::equal(plain.mass().begin(), plain.mass().end(), unchanged.mass().begin()));
    }
}

TEST_CASE("mass scaling: weight, its reaction and the state of rest stay those of the true mass", "[fe]")
{
  for (const Material &material : materials())
  {
    const double wanted = 3 * step_of(material, 1);
    ExplicitBody plain = column(material, 0), scaled = column(material, wanted);
    REQUIRE(scaled.mass_scaling().share > 0.1);
    for (ExplicitBody *body : {&plain, &scaled})
      find_equilibrium(*body);
    CHECK(std::equal(plain.displacement().begin(), plain.displacement().end(), scaled.displacement().begin()));
    double reaction = 0, weight = 0;
    for (std::size_t node = 0; node < scaled.n_nodes(); ++node)
    {
      reaction += scaled.reaction_force()[3 * node + 2];
      weight += scaled.weight(3 * node + 2);
    }
    CHECK(weight == Approx(-gravity * whole_mass).epsilon(1e-12));
    CHECK(reaction == Approx(gravity * whole_mass).epsilon(1e-8)); // of Newton's tolerance of 1e-9

    // A damped run with the longer step comes to rest at the same place.
    const double slowest = M_PI / 2 / height * std::sqrt(2e7 / rho);
    ExplicitBody moving = column(material, wanted, 1, slowest); // oscillations die off like exp(−slowest t/2)
    const double dt = 0.9 * wanted;
    for (double time = 0; time < 40 / slowest; time += dt)
    {
      moving.compute_internal_force();
      moving.kick(dt);
      moving.drift(dt);
    }
    double greatest = 0;
    for (const double displacement : plain.displacement())
      greatest = std::max(greatest, std::abs(displacement));
    for (std::size_t dof = 0; dof < 3 * plain.n_nodes(); ++dof)
      CHECK(moving.displacement()[dof] == Approx(plain.displacement()[dof]).margin(1e-6 * greatest));
  }
}

TEST_CASE("mass scaling: the energy balance closes to rounding, with gravity and damping", "[fe]")
{
  const Material material = materials().front();
  const double wanted = 2 * step_of(material, 1);
  ExplicitBody body = column(material, wanted, 1, 5);
  REQUIRE(body.mass_scaling().n_elements > 0);
  double error = 0, scale = 0;
  for (int k = 0; k < 500; ++k)
  {
    body.compute_internal_force();
    body.kick(0.9 * wanted);
    error = std::max(error, std::abs(body.energy().residual()));
    scale = std::max(scale, std::abs(body.energy().gravity_work));
    body.drift(0.9 * wanted);
  }
  CHECK(scale > 1); // it moves
  CHECK(error < 1e-12 * scale);
}

TEST_CASE("mass scaling: a step that is no time is refused", "[fe]")
{
  for (const double bad : {-1e-4, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_WITH(column(materials().front(), bad),
                      Catch::Contains("wanted_time_step = ") && Catch::Contains("zero for no mass scaling"));
}
