// Grains and rigid bodies of triangles that move by themselves.

#include "coupling/adapter/surface_contact.h"
#include "coupling/model/model.h"

#include "tests/grains_on_bodies.h"
#include "tests/surfaces.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace bergamo;
using namespace bergamo::coupling;
using Catch::Contains;

namespace
{

constexpr double mm = 1e-3, density = 2650.;

/// Without gravity.
dem::SimulationParameters parameters(const double friction, const double damping, const double time_step)
{
  dem::SimulationParameters p = dem::test::soft_grains(friction, damping);
  p.gravity.setZero();
  p.time_step = time_step;
  return p;
}

/// A cuboid of twelve triangles about a centre, of the grains' density.
fe::RigidBodyShape cuboid(const Vec3 &centre, const Vec3 &edges)
{
  fe::RigidBodyShape shape;
  for (int k = 0; k < 8; ++k)
  {
    const Vec3 x = centre + 0.5 * edges.cwiseProduct(Vec3(k & 1 ? 1. : -1., k & 2 ? 1. : -1., k & 4 ? 1. : -1.));
    shape.vertices.push_back({x[0], x[1], x[2]});
  }
  const auto add = [&](unsigned int a, unsigned int b, unsigned int c, unsigned int d) {
    shape.triangles.insert(shape.triangles.end(), {{a, b, c}, {a, c, d}});
  };
  add(0, 2, 3, 1);
  add(4, 5, 7, 6);
  add(0, 1, 5, 4);
  add(2, 6, 7, 3);
  add(0, 4, 6, 2);
  add(1, 3, 7, 5);
  shape.inertia.mass = density * edges.prod();
  shape.inertia.centre = {centre[0], centre[1], centre[2]};
  for (int i = 0; i < 3; ++i)
    shape.inertia.inertia[i][i] = shape.inertia.mass / 12. * (edges.squaredNorm() - edges[i] * edges[i]);
  return shape;
}

struct GrainsAndBody
{
  Model model;
  GrainsMover *grains = nullptr;
  RigidMover *body = nullptr;
  SurfaceContact *contact = nullptr;

  GrainsAndBody(const dem::SimulationParameters &p, const dem::Particles &particles, const fe::RigidBodyShape &shape)
  {
    grains = &model.add(
        std::make_unique<GrainsMover>(std::make_unique<dem::Simulation>(p, particles, std::vector<dem::PlaneWall>())));
    body = &model.add(std::make_unique<RigidMover>(shape));
    grains->simulation().add_surface(surface_of(body->body()));
    contact = &model.add(std::make_unique<SurfaceContact>(*grains, *body, 0));
  }

  void step() { model.step(grains->simulation().parameters().time_step); }

  Vec3 momentum() const
  {
    const dem::Particles &p = grains->simulation().particles;
    const auto &v = body->body().velocity();
    Vec3 sum = body->body().inertia().mass * Vec3(v[0], v[1], v[2]);
    for (std::size_t i = 0; i < p.size(); ++i)
      sum += p.mass[i] * p.velocity[i];
    return sum;
  }

  /// Kinetic, stored and lost less what came from outside, between kick and drift [J].
  double energy() const { return test::energy_of({grains, body}); }
};

} // namespace

TEST_CASE("grains and a free body of triangles exchange momentum, angular momentum and energy")
{
  // Exact to rounding: momentum. Angular momentum: the leapfrog keeps it as far as forces on both sides have the same
  // moment. Energy: of second order in the step.
  const double damping = GENERATE(0., 0.3);
  double left[2];
  for (int k = 0; k < 2; ++k)
  {
    const double time_step = 1e-6 / (1 << k);
    GrainsAndBody s(parameters(0.3, damping, time_step),
                    test::projectiles({-2. * mm, 0.3 * mm, Vec3(0.02, -0.01, 0.2)}),
                    cuboid(Vec3(0., 0., 1.) * mm, Vec3(8., 6., 2.) * mm));
    const Vec3 before = s.momentum();
    s.model.compute_forces();
    s.model.kick(time_step);
    const double energy = s.energy();
    s.model.drift(time_step);
    const double kinetic = s.grains->energy().kinetic;
    double most = 0.;
    int touched = 0;
    for (int n = 1; n < 8000 * (1 << k); ++n)
    {
      s.model.compute_forces();
      s.model.kick(time_step);
      most = std::max(most, std::abs(s.energy() - energy));
      touched = std::max(touched, s.grains->simulation().contacts.n_touching_walls());
      s.model.drift(time_step);
    }
    CHECK(touched > 0);
    CHECK((s.momentum() - before).norm() < 1e-12 * before.norm());
    CHECK(std::abs(s.body->body().velocity()[2]) > 1e-3); // was hit
    CHECK(std::abs(s.body->body().angular_velocity()[1]) > 0.1);
    left[k] = most / kinetic;
    INFO("step " << time_step << " damping " << damping << " energy left " << left[k]);
    CHECK(left[k] < 1e-4);
  }
  CHECK(left[1] < 0.35 * left[0]); // 1.3e-5 and 3.4e-6 were found
}

TEST_CASE("forces on the nodes of a surface have the sum and the moment of its contacts")
{
  GrainsAndBody s(parameters(0.5, 0.3, 1e-6), test::projectiles({-2. * mm, 0.3 * mm, Vec3(0.02, -0.01, 0.2)}),
                  cuboid(Vec3(0., 0., 1.) * mm, Vec3(8., 6., 2.) * mm));
  int n_compared = 0;
  for (int n = 0; n < 8000; ++n)
  {
    s.model.compute_forces();
    const dem::Simulation &grains = s.grains->simulation();
    if (grains.contacts.n_touching_walls() > 0)
    {
      const dem::SurfaceLoad load = grains.surface_loads()[0];
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      for (std::size_t k = 0; k < 8; ++k)
      {
        force += grains.surfaces[0].force[k];
        moment += grains.surfaces[0].node[k].cross(grains.surfaces[0].force[k]);
      }
      REQUIRE((force - load.force).norm() <= 1e-13 * load.force.norm());
      REQUIRE((moment - load.moment).norm() <= 1e-13 * load.force.norm() * 10. * mm);
      ++n_compared;
    }
    s.model.kick(1e-6);
    s.model.drift(1e-6);
  }
  CHECK(n_compared > 100);
}

TEST_CASE("a sphere rebounds from a free cuboid of triangles as two masses do")
{
  // A sphere hits the middle of a heavy cuboid and rebounds with 2 m2 / (m1 + m2) - 1 of its velocity, elastic.
  dem::Particles grains;
  grains.add({Vec3::Constant(mm), 1., 1.}, density, Vec3(0., 0., -1.01) * mm, Quaternion::Identity());
  grains.velocity[0] = Vec3(0., 0., 0.1);
  GrainsAndBody s(parameters(0., 0., 2e-7), grains, cuboid(Vec3(0., 0., 1.) * mm, Vec3(4., 4., 2.) * mm));
  const double m1 = s.grains->simulation().particles.mass[0], m2 = s.body->body().inertia().mass;
  while (s.grains->simulation().contacts.n_touching_walls() == 0)
    s.step();
  const double step = s.model.stable_steps().combined();
  CHECK(step > s.grains->simulation().parameters().time_step);
  CHECK(step < s.grains->simulation().stable_time_step());
  while (s.grains->simulation().contacts.n_touching_walls() > 0)
    s.step();
  CHECK(s.grains->simulation().particles.velocity[0][2] == Approx(0.1 * (m1 - m2) / (m1 + m2)).margin(2e-6));
  CHECK(s.body->body().velocity()[2] == Approx(0.1 * 2. * m1 / (m1 + m2)).margin(2e-6));
  CHECK(std::abs(s.body->body().angular_velocity()[0]) < 1e-9);
}

TEST_CASE("a body may take its surface when the grains' forces are known already")
{
  dem::Particles grains;
  grains.add({Vec3::Constant(mm), 1., 1.}, density, Vec3(0., 0., -0.99) * mm, Quaternion::Identity());
  const fe::RigidBodyShape block = cuboid(Vec3(0., 0., 1.) * mm, Vec3(4., 4., 2.) * mm);
  GrainsAndBody s(parameters(0., 0., 1e-6), grains, block);
  Model late;
  GrainsMover &mover = late.add(std::make_unique<GrainsMover>(
      std::make_unique<dem::Simulation>(parameters(0., 0., 1e-6), grains, std::vector<dem::PlaneWall>())));
  RigidMover &body = late.add(std::make_unique<RigidMover>(block));
  mover.simulation().add_surface(surface_of(body.body()));
  mover.simulation().compute_forces();
  REQUIRE(mover.simulation().contacts.n_touching_walls() == 1);
  late.add(std::make_unique<SurfaceContact>(mover, body, 0));
  for (int n = 0; n < 10; ++n)
  {
    s.step();
    late.step(1e-6);
  }
  CHECK(body.body().velocity()[2] > 0.);
  CHECK(body.body().velocity() == s.body->body().velocity());
}

TEST_CASE("a surface contact asks for the body's own surface")
{
  Model model;
  dem::Particles grains;
  grains.add({Vec3::Constant(mm), 1., 1.}, density, Vec3::Zero(), Quaternion::Identity());
  GrainsMover &mover = model.add(std::make_unique<GrainsMover>(
      std::make_unique<dem::Simulation>(parameters(0., 0., 1e-6), grains, std::vector<dem::PlaneWall>())));
  RigidMover &body = model.add(std::make_unique<RigidMover>(cuboid(Vec3(0., 0., 9.) * mm, Vec3::Constant(mm))));
  CHECK_THROWS_WITH(SurfaceContact(mover, body, 0), Contains("number of the surface of 'rigid body' is 0"));
  mover.simulation().add_surface({{Vec3(0, 0, -9.), Vec3(1., 0., -9.), Vec3(0., 1., -9.)}, {{0, 1, 2}}});
  CHECK_THROWS_WITH(SurfaceContact(mover, body, 0), Contains("number of nodes") && Contains("8"));
}
