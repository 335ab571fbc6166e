#include "dem/core/error.h"
#include "fe_dealii/body_energy.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace bergamo;
using namespace bergamo::fe;
using Catch::Matchers::Contains;

TEST_CASE("energies that no slow motion has end a run", "[fe]")
{
  const BodyEnergy sound{.kinetic = -1e-6, .elastic = 3, .stiffness_loss = -0.5, .boundary_work = 1.5, .initial = 1};
  const auto check = [](const BodyEnergy &energy)
  { require_bounded(energy, "the ground at time 3 s", "a smaller step"); };
  CHECK_NOTHROW(check(sound));
  CHECK_NOTHROW(check({}));
  BodyEnergy wrong = sound;
  wrong.kinetic = -0.1;
  CHECK_THROWS_WITH(check(wrong), Contains("diverged: the ground at time 3 s has a negative kinetic energy, -0.1 J") &&
                                      Contains("choose a smaller step"));
  wrong = sound;
  wrong.stiffness_loss = -2.6;
  CHECK_THROWS_WITH(check(wrong), Contains("got 2.6 J from the change of its stiffness, more than the 2.5 J"));
  wrong = sound;
  wrong.viscous_dissipation = std::nan("");
  CHECK_THROWS_AS(check(wrong), RunError);
}
