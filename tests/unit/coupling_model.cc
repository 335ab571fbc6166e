// A model of any movers and couplings, here of masses on springs: the order of a step, and its stable length.

#include "coupling/model/model.h"
#include "dem/core/error.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace bergamo::coupling;

namespace
{

/// A mass on a spring to the place 0, moved by the leapfrog.
class MassOnSpring final : public Mover
{
public:
  MassOnSpring(std::string name, const double mass, const double stiffness)
      : Mover(std::move(name)), mass(mass), stiffness(stiffness)
  {
  }

  void compute_forces() override
  {
    force = -stiffness * place;
    log.push_back("forces " + name());
  }
  void kick(const double dt) override
  {
    velocity += dt * force / mass;
    log.push_back("kick " + name());
  }
  void drift(const double dt) override
  {
    place += dt * velocity;
    log.push_back("drift " + name());
  }
  double stable_step() override { return 2. / std::sqrt(stiffness / mass); }
  MoverEnergy energy() const override { return {}; }

  double mass, stiffness, place = 0., velocity = 0., force = 0.;
  inline static std::vector<std::string> log;
};

/// A spring between two masses, at rest where both are at one place.
class Spring final : public Coupling
{
public:
  Spring(MassOnSpring &a, MassOnSpring &b, const double stiffness)
      : Coupling("spring"), a(a), b(b), stiffness(stiffness)
  {
  }

  void apply() override
  {
    const double pull = stiffness * (b.place - a.place);
    a.force += pull;
    b.force -= pull;
    MassOnSpring::log.push_back("apply spring");
  }
  std::vector<const Mover *> movers() const override { return {&a, &b}; }
  double stable_step() override { return 2. / std::sqrt(stiffness * (1. / a.mass + 1. / b.mass)); }

  MassOnSpring &a, &b;
  double stiffness;
};

} // namespace

TEST_CASE("one step of a model: all forces, the couplings, all kicks, all drifts")
{
  Model model;
  auto &a = model.add(std::make_unique<MassOnSpring>("a", 1., 1.));
  auto &b = model.add(std::make_unique<MassOnSpring>("b", 1., 1.));
  model.add(std::make_unique<Spring>(a, b, 1.));
  MassOnSpring::log.clear();
  model.step(0.1);
  CHECK(MassOnSpring::log ==
        std::vector<std::string>{"forces a", "forces b", "apply spring", "kick a", "kick b", "drift a", "drift b"});
}

TEST_CASE("a mover without couplings moves among others as it does alone, bit for bit")
{
  Model model;
  auto &a = model.add(std::make_unique<MassOnSpring>("a", 1., 3.));
  auto &alone = model.add(std::make_unique<MassOnSpring>("alone", 0.7, 5.));
  auto &b = model.add(std::make_unique<MassOnSpring>("b", 2., 1.));
  model.add(std::make_unique<Spring>(a, b, 2.));
  MassOnSpring reference("reference", 0.7, 5.);
  a.velocity = b.velocity = alone.velocity = reference.velocity = 0.3;
  for (int k = 0; k < 500; ++k)
  {
    model.step(0.01);
    reference.compute_forces();
    reference.kick(0.01);
    reference.drift(0.01);
  }
  CHECK(alone.place == reference.place);
  CHECK(alone.velocity == reference.velocity);
  CHECK(a.place != b.place);
}

TEST_CASE("the stable step of a whole counts for each mover the couplings that act on it")
{
  // Two like masses m on springs K, joined by a spring k: their fastest motion, against each other, has
  // ω² = (K + 2 k)/m, which the bound meets. A third, stiffer mass apart is not slowed down by the coupling.
  const double m = 2., stiffness = 3., joint = 50.;
  Model model;
  auto &a = model.add(std::make_unique<MassOnSpring>("a", m, stiffness));
  auto &b = model.add(std::make_unique<MassOnSpring>("b", m, stiffness));
  CHECK(model.stable_steps().combined() == Approx(2. / std::sqrt(stiffness / m)));
  model.add(std::make_unique<Spring>(a, b, joint));
  const double together = 2. / std::sqrt((stiffness + 2. * joint) / m);
  CHECK(model.stable_steps().combined() == Approx(together).epsilon(1e-14));

  model.add(std::make_unique<MassOnSpring>("apart", m, 0.9 * (stiffness + 2. * joint)));
  CHECK(model.stable_steps().combined() == Approx(together).epsilon(1e-14));
  model.add(std::make_unique<MassOnSpring>("stiff", m, 1.1 * (stiffness + 2. * joint)));
  const StableSteps steps = model.stable_steps();
  CHECK(steps.combined() == Approx(together / std::sqrt(1.1)).epsilon(1e-14));
  CHECK(steps.movers[3].name == "stiff");
  CHECK(steps.movers[3].couplings.empty());
  CHECK(steps.movers[1].couplings == std::vector<std::size_t>{0});
  CHECK(steps.couplings[0].name == "spring");
  CHECK(Model().stable_steps().combined() == std::numeric_limits<double>::infinity());
}

TEST_CASE("a coupling of a mover that is no part of the model is refused")
{
  Model model;
  auto &a = model.add(std::make_unique<MassOnSpring>("a", 1., 1.));
  MassOnSpring stranger("stranger", 1., 1.);
  CHECK_THROWS_WITH(model.add(std::make_unique<Spring>(a, stranger, 1.)), Catch::Contains("stranger"));
  CHECK_THROWS_AS(model.add(std::make_unique<Spring>(a, stranger, 1.)), bergamo::ConfigError);
}

namespace
{

/// Largest growth of one cycle of a unit mass on two springs: that of the mover pulls once a cycle, for all of it, that
/// of the coupling is followed exactly. Of the two eigenvalues, whose product is 1.
double growth(const double own_frequency, const double of_coupling, const double interval)
{
  const double half_trace = std::cos(of_coupling * interval) - 0.5 * own_frequency * own_frequency * interval /
                                                                   of_coupling * std::sin(of_coupling * interval);
  return std::abs(half_trace) <= 1. ? 1. : std::abs(half_trace) + std::sqrt(half_trace * half_trace - 1.);
}

} // namespace

TEST_CASE("impulses of a mover's own forces may be as far apart as its own stable step and its couplings' allow")
{
  const double of_coupling = GENERATE(0.01, 0.5, 1., 2., 10.); // over the mover's own frequency of 1 [1/s]
  constexpr int n = 7;
  StableSteps steps;
  steps.movers.push_back({"body", 2., {0}, n});
  steps.couplings.push_back({"overlap", 2. / of_coupling});
  const double interval = n * steps.combined();
  CAPTURE(interval);
  CHECK(growth(1., of_coupling, 0.999 * interval) == 1.);
  CHECK(growth(1., of_coupling, 1.001 * interval) > 1.);
  CHECK(interval <= 2.);
  CHECK(of_coupling * interval < 3.1416);
}
