#include "drivers/common/run/clocked_body.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <catch2/catch.hpp>

#include <memory>

using namespace bergamo;

TEST_CASE("a body whose time is taken moves as it does without, and its seconds add up")
{
  const auto make = []
  {
    fe::ExplicitBodyParameters parameters;
    parameters.gravity = {0., 0., -10.};
    auto body = std::make_unique<fe::ExplicitBody>(fe::make_box_body({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, parameters));
    body->prescribe_velocity(4u, 2);
    return body;
  };
  coupling::BodyMover plain(make());
  driver::ClockedBody clocked(make());
  const double step = 0.5 * plain.stable_step();
  double seconds = clocked.seconds();
  CHECK(seconds == 0.);
  const auto check_more = [&]
  {
    CHECK(clocked.seconds() > seconds);
    seconds = clocked.seconds();
  };
  for (int k = 0; k < 5; ++k)
  {
    plain.compute_forces();
    clocked.compute_forces();
    check_more();
    plain.kick(step);
    clocked.kick(step);
    check_more();
    plain.drift(step);
    clocked.drift(step);
    check_more();
  }
  REQUIRE(plain.body().max_velocity() > 0.);
  for (std::size_t dof = 0; dof < 3 * plain.body().n_nodes(); ++dof)
  {
    CHECK(clocked.body().displacement()[dof] == plain.body().displacement()[dof]);
    CHECK(clocked.body().velocity()[dof] == plain.body().velocity()[dof]);
  }
}
