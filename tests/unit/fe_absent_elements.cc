#include "fe_dealii/equilibrium/static_equilibrium.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/output.h"
#include "tests/temporary_folder.h"
#include "tests/unit/fe_vtu_reader.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace bergamo::fe;
using Catch::Matchers::Contains;

namespace
{

constexpr double top = 3.; // of a column of three cubes of 1 m

ExplicitBody column(const Hourglass hourglass)
{
  ExplicitBodyParameters parameters;
  parameters.material = LinearElastic({.young_modulus = 1e7, .poisson_ratio = 0.2, .density = 2000});
  parameters.kind.hourglass = hourglass;
  parameters.gravity = {0, 0, -10};
  return make_box_body({{0, 0, 0}, {1, 1, top}, {1, 1, 3}}, parameters);
}

/// 1 from a height on, falling to 0 over 1 m below.
std::vector<double> weight_below(const ExplicitBody &body, const double height)
{
  std::vector<double> weight;
  for (const auto &place : body.node_position())
    weight.push_back(std::clamp(1 + place[2] - height, 0., 1.));
  return weight;
}

void run(ExplicitBody &body, const int n_steps, const double dt)
{
  for (int step = 0; step < n_steps; ++step)
  {
    body.compute_internal_force();
    body.kick(dt);
    body.drift(dt);
  }
}

} // namespace

TEST_CASE("Elements without any share are absent: their own nodes stay, the others fall as if they were not", "[fe]")
{
  const Hourglass hourglass = GENERATE(Hourglass::at_points, Hourglass::bending);
  ExplicitBody body = column(hourglass);
  body.set_share(weight_below(body, 2.));
  CHECK(body.is_absent(2));
  CHECK_FALSE(body.is_absent(1));
  run(body, 100, 1e-4);
  const double fallen = 0.5 * 10 * 1e-2 * 1e-2;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const bool is_gone = body.node_position()[node][2] == top;
    CHECK((body.mass()[3 * node] == 0) == is_gone);
    CHECK(body.displacement()[3 * node + 2] == (is_gone ? Approx(0).margin(1e-300) : Approx(-fallen).epsilon(0.02)));
  }
  CHECK(std::abs(body.energy().residual()) < 1e-9 * body.energy().gravity_work);
  CHECK(body.state_of(2).stress == Stress{}); // whatever becomes of the nodes that it shares

  const TemporaryFolder folder;
  write_vtu(body, folder / "body.vtu");
  CHECK(VtuReader(folder / "body.vtu").array("types").size() == 2);
  CHECK_THROWS_WITH(find_equilibrium(body), Contains("absent elements"));
}

TEST_CASE("A share that changes in motion books the energy that goes with it", "[fe]")
{
  const Hourglass hourglass = GENERATE(Hourglass::at_points, Hourglass::bending);
  CAPTURE(hourglass == Hourglass::bending);
  constexpr double dt = 2e-4;
  ExplicitBody body = column(hourglass);
  for (const unsigned int face : {0u, 1u, 2u, 3u, 4u})
    body.prescribe_velocity(face, face / 2);
  body.set_share(weight_below(body, 4.)); // the top's share is the least, all are there
  run(body, 100, dt);
  body.compute_internal_force();
  body.kick(dt);
  const BodyEnergy before = body.energy();
  const double scale = before.elastic + std::abs(before.gravity_work);
  CHECK(std::abs(before.residual()) < 1e-9 * scale);
  body.drift(dt);
  body.set_share(weight_below(body, 2.));
  run(body, 50, dt);
  CHECK(body.energy().exchanged < -0.1 * scale); // else the next line sees nothing of it
  CHECK(std::abs(body.energy().residual()) < 1e-9 * scale);
  CHECK_THROWS_WITH(body.set_share(weight_below(body, 4.)), Contains("bring back element 2"));
}
