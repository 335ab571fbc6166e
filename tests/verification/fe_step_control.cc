// The stable step of an explicit run is watched, and the step follows it.

#include "dem/core/error.h"
#include "fe_dealii/body_energy.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/membrane_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/step_control.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <variant>

using namespace bergamo;
using namespace bergamo::fe;
using Catch::Matchers::Contains;

namespace
{

/// A sand that stays elastic, its moduli in proportion to the pressure.
const MohrCoulombParameters stiffening{.young_modulus = 20e6,
                                       .poisson_ratio = 0.3,
                                       .friction_angle = 35,
                                       .cohesion = 1e9,
                                       .density = 1600,
                                       .reference_pressure = 1e5,
                                       .stiffness_exponent = 1};
constexpr double start_pressure = 20e3, thrust = 0.02, duration = 2; // [Pa], of 1 m, [s]

/// A column of 1 m on rollers, whose lid goes down slowly; under an even pressure at the start.
ExplicitBody oedometer(const unsigned int degree, const double distortion,
                       const Material &material = MohrCoulomb(stiffening))
{
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {0.25, 0.25, 1}, {1, 1, 4}}, mesh);
  if (distortion > 0)
    dealii::GridTools::distort_random(distortion, mesh, /*keep_boundary=*/true, /*seed=*/4);
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.degree = degree;
  parameters.damping = 40;
  if (std::holds_alternative<MohrCoulomb>(material))
    parameters.initial_stress = uniform_pressure(start_pressure);
  ExplicitBody body(mesh, parameters);
  for (unsigned int id = 0; id < 5; ++id)
    body.prescribe_velocity(id, id / 2);
  return body;
}

double lid_velocity(const double time)
{
  return -thrust / duration * std::min(1., time / 0.1);
}

/// dσ/dε = M p/p_r and dσ_h = ν/(1 − ν) dσ: the pressure grows as exp(a ε).
double vertical_stress(const double strain)
{
  const double e = stiffening.young_modulus, nu = stiffening.poisson_ratio, sideways = nu / (1 - nu);
  const double modulus = e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), share = (1 + 2 * sideways) / 3;
  return start_pressure * (1 + (std::exp(share * modulus / stiffening.reference_pressure * strain) - 1) / share);
}

void press(ExplicitBody &body, const MovingBody::Constraint lid, const double end,
           const std::function<double()> &step_to_come)
{
  while (body.time() < end)
  {
    body.compute_internal_force();
    const double dt = step_to_come();
    body.set_velocity(lid, lid_velocity(body.time() + 0.5 * dt));
    body.kick(dt);
    body.drift(dt);
  }
  body.compute_internal_force();
}

} // namespace

TEST_CASE("sand that becomes thirty times as stiff is followed to its closed form, its books closed", "[fe]")
{
  const unsigned int degree = GENERATE(1u, 2u);
  const double share = GENERATE(0.9, 0.3);
  CAPTURE(degree, share);
  ExplicitBody body = oedometer(degree, 0.15);
  const auto lid = body.prescribe_velocity(5u, 2);
  StepControl steps(body);
  const double at_start = steps.stable().time_step;
  double largest_growth = 0, last = 0, largest_residual = 0;
  press(body, lid, duration,
        [&]
        {
          const double dt = steps.next(share);
          CHECK(dt <= share * steps.stable().time_step);
          if (last > 0)
            largest_growth = std::max(largest_growth, dt / last);
          last = dt;
          return dt;
        });
  body.kick(last);
  const BodyEnergy energy = body.energy();
  largest_residual = std::abs(energy.residual());
  double settlement = 0;
  for (const unsigned int node : body.boundary_nodes(5))
    settlement = -body.displacement()[3 * node + 2];
  const double stress = vertical_stress(settlement);
  CAPTURE(settlement, stress, energy.stiffness_loss, energy.boundary_work);
  CHECK(stress > 30 * start_pressure);
  // The step of the law takes the stiffness at its start: of first order in the strain of a step, 1e-5 times a = 170.
  CHECK(-body.average_stress()[2] == Approx(stress).epsilon(0.01));
  CHECK(at_start / steps.smallest_stable() ==
        Approx(std::sqrt(1 + (stress / start_pressure - 1) * 1.857 / 3)).epsilon(0.02));
  CHECK(steps.smallest_step() < share * steps.smallest_stable() * 1.0001);
  CHECK(largest_growth < 1.0101);
  CHECK(largest_residual < 1e-10 * energy.boundary_work);
  CHECK(energy.kinetic >= 0);
  CHECK_NOTHROW(require_bounded(energy, "it", "nothing"));
}

TEST_CASE("a step that is given ends the run where the sand becomes too stiff for it", "[fe]")
{
  ExplicitBody body = oedometer(1, 0);
  const auto lid = body.prescribe_velocity(5u, 2);
  StepControl steps(body);
  const double dt = 0.9 * steps.stable().time_step;
  const auto run = [&]
  {
    press(body, lid, duration,
          [&]
          {
            steps.require_stable(dt);
            return dt;
          });
  };
  CHECK_THROWS_WITH(run(), Contains("continuum: element ") && Contains(" at (0.125, 0.125, ") &&
                               Contains("at time 0.") && Contains("become so stiff") &&
                               Contains("choose a smaller time step"));
  CHECK(steps.smallest_stable() < dt);
  CHECK(steps.smallest_stable() > 0.99 * dt); // in the step in which it came
}

TEST_CASE("unwatched, that step ends in energies that are seen", "[fe]")
{
  ExplicitBody body = oedometer(1, 0);
  const auto lid = body.prescribe_velocity(5u, 2);
  const double dt = 0.9 * stable_step(body).time_step;
  const auto run = [&]
  {
    for (double end = 0.1; end <= duration; end += 0.1)
    {
      press(body, lid, end, [&] { return dt; });
      body.kick(dt);
      require_bounded(body.energy(), "the column", "a smaller step");
      body.drift(dt);
    }
  };
  CHECK_THROWS_AS(run(), RunError);
}

TEST_CASE("a run that follows its stable step goes on with the same bits", "[fe]")
{
  const Material materials[] = {MohrCoulomb(stiffening), NeoHooke({.young_modulus = 1e6, .poisson_ratio = 0.4})};
  const Material &material = materials[GENERATE(0, 1)];
  std::vector<double> ends[2];
  for (const bool is_broken : {false, true})
  {
    std::unique_ptr<ExplicitBody> body = std::make_unique<ExplicitBody>(oedometer(1, 0.15, material));
    auto lid = body->prescribe_velocity(5u, 2);
    auto steps = std::make_unique<StepControl>(*body);
    press(*body, lid, 1, [&] { return steps->next(0.9); });
    if (is_broken)
    {
      auto other = std::make_unique<ExplicitBody>(oedometer(1, 0.15, material));
      other->prescribe_velocity(5u, 2);
      auto its_steps = std::make_unique<StepControl>(*other);
      const auto copy = [](const auto &from, const auto &to)
      {
        for (std::size_t k = 0; k < from.size(); ++k)
          std::copy(from[k].second.begin(), from[k].second.end(), to[k].second.begin());
      };
      copy(body->state(), other->state());
      copy(steps->state(), its_steps->state());
      steps = std::move(its_steps);
      body = std::move(other);
    }
    press(*body, lid, 1.5, [&] { return steps->next(0.9); });
    for (const auto &views : {body->state(), steps->state()})
      for (const auto &[name, values] : views)
        ends[is_broken].insert(ends[is_broken].end(), values.begin(), values.end());
  }
  CHECK(ends[0] == ends[1]);
}

TEST_CASE("the stable step of a body of large strain is followed to some percent", "[fe]")
{
  const auto make = GENERATE(
      as<std::function<std::unique_ptr<MovingBody>()>>(),
      []
      {
        ExplicitBodyParameters parameters;
        parameters.material = NeoHooke({.young_modulus = 1e6, .poisson_ratio = 0.4, .density = 1000});
        return std::make_unique<ExplicitBody>(make_box_body({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, parameters));
      },
      []
      {
        ExplicitBodyParameters parameters;
        parameters.material = MooneyRivlin({});
        parameters.kind.hourglass = Hourglass::bending;
        return std::make_unique<ExplicitBody>(make_box_body({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, parameters));
      },
      []
      {
        ExplicitBodyParameters parameters;
        parameters.material = Ogden({});
        parameters.degree = 2;
        return std::make_unique<ExplicitBody>(make_box_body({{0, 0, 0}, {1, 1, 1}, {1, 1, 2}}, parameters));
      },
      []
      {
        dealii::Triangulation<2> flat;
        dealii::GridGenerator::subdivided_hyper_rectangle(flat, {4, 4}, dealii::Point<2>(), dealii::Point<2>(1, 1),
                                                          true);
        dealii::Triangulation<2, 3> mesh;
        dealii::GridGenerator::flatten_triangulation(flat, mesh);
        return std::make_unique<MembraneBody>(mesh, MembraneBodyParameters{});
      });
  const std::unique_ptr<MovingBody> body = make();
  // Stretched along x and thinned across, to twice its length: the thinner it is, the stiffer is the same material
  // across.
  const bool is_membrane = dynamic_cast<MembraneBody *>(body.get());
  StepControl steps(*body);
  double least = 1e300;
  for (int k = 0; k <= 100; ++k)
  {
    const double stretch = 1 + 0.01 * k, across = 1 / std::sqrt(stretch);
    for (std::size_t node = 0; node < body->n_nodes(); ++node)
      for (std::size_t i = 0; i < 3; ++i)
        body->displacement()[3 * node + i] = ((i == 0 ? stretch : across) - 1) * body->node_position()[node][i];
    const double exact = stable_step(*body).time_step;
    steps.next(0.9);
    least = std::min(least, exact);
    REQUIRE(steps.stable().time_step == Approx(exact).epsilon(0.04));
    REQUIRE(steps.smallest_stable() == Approx(least).epsilon(0.04));
  }
  if (!is_membrane) // which softens
    CHECK(least < 0.95 * stable_step(*make()).time_step);
}

TEST_CASE("a step shrinks at once and grows by a percent at most", "[fe]")
{
  ExplicitBody body = oedometer(1, 0, NeoHooke({.young_modulus = 1e6, .poisson_ratio = 0.4}));
  StepControl steps(body);
  const double at_rest = steps.next(0.9);
  const auto lower_to = [&](const double height)
  {
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      body.displacement()[3 * node + 2] = (height - 1) * body.node_position()[node][2];
  };
  lower_to(0.2);
  const double stiff = steps.next(0.9);
  CHECK(stiff == 0.9 * steps.stable().time_step);
  CHECK(stiff < 0.9 * at_rest);
  lower_to(1);
  CHECK(steps.next(0.9) == Approx(1.01 * stiff).epsilon(1e-12));
  CHECK(steps.stable().time_step == Approx(at_rest / 0.9).epsilon(1e-12));
  for (int k = 0; k < 500; ++k)
    steps.next(0.9);
  CHECK(steps.next(0.9) == Approx(at_rest).epsilon(1e-12));
  CHECK(steps.smallest_step() == stiff);
}

TEST_CASE("the share of the stable step is checked", "[fe]")
{
  ExplicitBody body = oedometer(1, 0);
  StepControl steps(body);
  for (const double wrong : {0., 1., -0.5, std::nan("")})
    CHECK_THROWS_AS(steps.next(wrong), ConfigError);
}
