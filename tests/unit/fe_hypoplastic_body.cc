#include "dem/core/error.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/stable_step.h"
#include "tests/unit/fe_sands.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

using namespace bergamo;
using namespace bergamo::fe;
using namespace bergamo::fe::sands;
using Catch::Matchers::Contains;

namespace
{

/// A cube of 1 m with 2³ elements; boundary 4 is its floor, 5 its top.
ExplicitBody cube(const unsigned int degree, const double pressure, const double void_ratio)
{
  HypoplasticParameters sand = hochstetten();
  sand.initial_void_ratio = void_ratio;
  ExplicitBodyParameters body;
  body.material = HypoplasticSand(sand);
  body.degree = degree;
  body.gravity = {0, 0, -9.81};
  body.initial_stress = uniform_pressure(pressure);
  return make_box_body({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, body);
}

/// Moves the top of a body whose other faces are held on rollers.
void press(ExplicitBody &body, const double velocity)
{
  body.prescribe_velocity(5, 2, velocity);
  for (const unsigned int face : {0u, 1u})
    body.prescribe_velocity(face, 0);
  for (const unsigned int face : {2u, 3u})
    body.prescribe_velocity(face, 1);
  body.prescribe_velocity(4, 2);
}

void step(ExplicitBody &body, const double dt)
{
  body.clear_external_force();
  body.compute_internal_force();
  body.kick(dt);
}

} // namespace

TEST_CASE("Body of sand: a column that is pressed and released closes its energies", "[fe]")
{
  for (const unsigned int degree : {1u, 2u})
  {
    ExplicitBody body = cube(degree, 50e3, 0.7);
    const double dt = 0.3 * stable_step(body).time_step;
    press(body, -0.05);
    double greatest = 0;
    for (int n = 0; n < 300; ++n)
    {
      if (n == 200)
        body.set_velocity(*body.constraint_of(3 * std::size_t(body.boundary_nodes(5)[0]) + 2), 0.05);
      step(body, dt);
      const BodyEnergy energy = body.energy();
      greatest = std::max({greatest, std::abs(energy.boundary_work), std::abs(energy.plastic_dissipation)});
      REQUIRE(std::abs(energy.residual()) < 1e-11 * greatest + 1e-15);
      REQUIRE(energy.elastic == 0);
      REQUIRE(energy.stiffness_loss == 0);
      body.drift(dt);
    }
    CHECK(greatest > 1);
  }
}

TEST_CASE("Body of sand: the stable step is that of pressure and density", "[fe]")
{
  const auto modulus = [](const double pressure, const double void_ratio)
  {
    const Stress stress{-pressure, -pressure, -pressure, 0, 0, 0};
    return HypoplasticSand(hochstetten()).response({stress, void_ratio}).greatest_modulus();
  };
  const double loose = stable_step(cube(1, 50e3, 0.8)).time_step;
  for (const auto &[pressure, void_ratio] : {std::pair(50e3, 0.6), std::pair(200e3, 0.8), std::pair(1., 0.8)})
    CHECK(stable_step(cube(1, pressure, void_ratio)).time_step ==
          Approx(loose * std::sqrt(modulus(50e3, 0.8) / modulus(pressure, void_ratio))).epsilon(1e-10));
  // Waves of compression along an axis are a bound, too: shortest side over their speed.
  const double speed = std::sqrt(modulus(50e3, 0.8) / hochstetten().density);
  CHECK(loose > 0.5 * 0.5 / speed);
  CHECK(loose < 2 * 0.5 / speed);
}

TEST_CASE("Body of sand: a start that the sand cannot have is refused, a motion that it cannot follow stops", "[fe]")
{
  const auto message = [](const double pressure, const double void_ratio) -> std::string
  {
    try
    {
      cube(1, pressure, void_ratio);
    }
    catch (const ConfigError &error)
    {
      return error.what();
    }
    return "";
  };
  CHECK(message(50e3, 0.7).empty());
  CHECK_THAT(message(50e3, 0.45), Contains("initial_void_ratio = 0.45") && Contains("e_d = 0.49"));
  CHECK_THAT(message(50e3, 1.0), Contains("initial_void_ratio = 1") && Contains("e_i = 0.9"));
  CHECK_THAT(message(-1, 0.7), Contains("bears no tension"));
  CHECK_THAT(message(NAN, 0.7), Contains("continuum"));

  ExplicitBody body = cube(1, 50e3, 0.7);
  press(body, -1e6);
  const double dt = 0.3 * stable_step(body).time_step;
  step(body, dt);
  body.drift(dt);
  CHECK_THROWS_WITH(body.compute_internal_force(), Contains("element") && Contains("(") && Contains("at time") &&
                                                       Contains("sand with a stress") && Contains("choose"));
}
