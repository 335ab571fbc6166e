// A rigid body without a mesh in a model beside a solid, joined by a spring.

#include "coupling/adapter/body_mover.h"
#include "coupling/adapter/rigid_mover.h"
#include "coupling/model/model.h"
#include "fe_dealii/explicit_body.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace bergamo;
using namespace bergamo::coupling;

namespace
{

/// Between the middle of a rigid body and a fixed place at the height z.
class Spring final : public Coupling
{
public:
  Spring(RigidMover &rigid, const double stiffness, const double height)
      : Coupling("spring"), rigid_(rigid), stiffness_(stiffness), height_(height)
  {
  }
  void apply() override { rigid_.body().add_force({0., 0., -stiffness_ * stretch()}, rigid_.body().centre()); }
  std::vector<const Mover *> movers() const override { return {&rigid_}; }
  double stable_step() override { return std::numeric_limits<double>::infinity(); }
  double energy() const override { return 0.5 * stiffness_ * stretch() * stretch(); }

private:
  double stretch() const { return rigid_.body().centre()[2] - height_; }

  RigidMover &rigid_;
  double stiffness_, height_;
};

} // namespace

TEST_CASE("a rigid body hung on a spring swings beside a falling solid with the frequency of its mass")
{
  Model model;
  fe::RigidBodyShape shape;
  shape.inertia.mass = 4.;
  shape.inertia.centre = {0., 0., 1.};
  for (int i = 0; i < 3; ++i)
    shape.inertia.inertia[i][i] = 1.;
  shape.gravity = {0., 0., -10.};
  RigidMover &rigid = model.add(std::make_unique<RigidMover>(shape));
  fe::ExplicitBodyParameters solid;
  solid.gravity = {0., 0., -10.};
  SolidMover &block = model.add(std::make_unique<SolidMover>(
      std::make_unique<fe::ExplicitBody>(fe::make_box_body({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, solid))));
  model.add(std::make_unique<Spring>(rigid, 400., 1.)); // omega = 10 / s

  const double dt = 1e-3;
  rigid.body().velocity()[2] = 0.5 * dt * 10.; // at rest at time 0
  for (std::size_t node = 0; node < block.solid().n_nodes(); ++node)
    block.solid().velocity()[3 * node + 2] = 0.5 * dt * 10.;
  double worst = 0., largest_imbalance = 0.;
  for (int k = 0; k < 1000; ++k)
  {
    model.compute_forces();
    model.kick(dt);
    const MoverEnergy energy = rigid.energy();
    if (k > 0)
      largest_imbalance =
          std::max(largest_imbalance, std::abs(energy.kinetic + model.couplings()[0]->energy() - energy.work));
    model.drift(dt);
    // z = 1 - m g/k (1 - cos(omega t))
    const double exact = 1. - 0.1 * (1. - std::cos(10. * (k + 1) * dt));
    worst = std::max(worst, std::abs(rigid.body().centre()[2] - exact));
  }
  CHECK(worst < 0.1 * 10. * 100. * dt * dt / 24. * 2.); // (omega dt)^2/24 of the phase, after ten radians
  // Of the mean of the kinetic energies: m (omega^2 a dt)^2/8, from the greatest acceleration of 10 m/s^2, and as much
  // of the work's rule.
  CHECK(largest_imbalance < 4. * std::pow(10. * dt, 2));
  CHECK(block.solid().displacement()[2] == Approx(-5.).epsilon(1e-9));
  CHECK(std::isinf(rigid.stable_step()));
}
