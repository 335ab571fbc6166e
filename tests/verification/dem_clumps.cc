#include "dem/core/error.h"
#include "dem/geometry/clump_mass.h"
#include "dem/geometry/rigid_clump.h"
#include "dem/simulation/simulation.h"

#include "tests/threads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double radius = 1e-3, density = 2500., pi = std::numbers::pi;

Superquadric sphere(const double r)
{
  return {Vec3::Constant(r), 1., 1.};
}

Quaternion turn(const double angle, const Vec3 &axis)
{
  return Quaternion(Eigen::AngleAxisd(angle, axis.normalized()));
}

SimulationParameters elastic(const double modulus)
{
  SimulationParameters p;
  p.grain() = p.wall() = {modulus, 0.25, density};
  p.between_grains().friction = p.with_walls().friction = 0.;
  p.set_damping(0.);
  p.contact.overlap_tolerance = 0.; // a search in every step
  p.time_step = 1e-6;
  return p;
}

/// Two spheres on the x axis of their principal frame.
Clump dumbbell(const double half_distance)
{
  Clump clump(
      ClumpShape{{{sphere(radius), Vec3(-half_distance, 0., 0.)}, {sphere(radius), Vec3(half_distance, 0., 0.)}}});
  REQUIRE(std::abs(clump.parts()[0].position[0]) == Approx(half_distance).epsilon(1e-12));
  return clump;
}

/// Rotation of a dumbbell that brings its line of centres into a direction.
Quaternion along(const Vec3 &direction)
{
  return Quaternion::FromTwoVectors(Vec3::UnitX(), direction);
}

/// Stiffness K of Hertz's law F = K overlap^1.5, of a sphere on a plane or of two equal spheres.
double hertz(const Material &m, const double effective_radius)
{
  return 4. / 3. * m.young_modulus / (2. * (1. - m.poisson_ratio * m.poisson_ratio)) * std::sqrt(effective_radius);
}

/// Three spheres in L: the corner and two tips, at a distance from it, along x and z of the frame in which they are
/// given; where that frame lies in the principal one.
struct Hook
{
  ClumpShape shape;
  MassProperties mass;
  Clump clump;

  Hook(const double distance, const Vec3 &first, const Vec3 &second)
      : shape{{{sphere(radius)}, {sphere(radius), distance * first}, {sphere(radius), distance * second}}},
        mass(mass_properties(shape)), clump(shape)
  {
  }

  /// Puts it where its corner is at a place and its frame is the global one.
  void add_to(Particles &particles, const Vec3 &corner) const
  {
    particles.add(clump, density, corner + mass.centre, mass.orientation);
  }
};

/// One body that falls on a floor, and another one on that, with spin.
Simulation falling(const SimulationParameters &parameters, const Clump &body)
{
  SimulationParameters p = parameters;
  p.gravity = Vec3(0.5, 0., -9.81);
  Particles particles;
  particles.add(body, density, Vec3(0., 0., 1.01 * radius), turn(0.4, Vec3(1., 2., 0.)));
  particles.add(body, density, Vec3(0.3e-3, 0.1e-3, 3.1 * radius), turn(1.1, Vec3(1., 0., 3.)));
  particles.velocity[0] = Vec3(0.1, 0., -0.3);
  particles.velocity[1] = Vec3(0., 0.1, -0.6);
  for (std::size_t i = 0; i < 2; ++i)
    particles.angular_momentum[i] = particles.inertia[i].mean() * Vec3(30., -20., 50.);
  return Simulation(p, particles, {PlaneWall()});
}

} // namespace

TEST_CASE("a clump of one part is the plain grain, bit for bit, wherever the part was given")
{
  const Threads one_thread(1);
  for (const Superquadric &shape : {sphere(radius), Superquadric{Vec3(1e-3, 0.8e-3, 0.9e-3), 0.7, 1.2}})
  {
    SimulationParameters p = elastic(1e7);
    p.between_grains().friction = p.with_walls().friction = 0.4;
    p.set_damping(0.2);
    p.contact.overlap_tolerance = 1e-3;
    Simulation grain = falling(p, Clump(shape));
    Simulation clump = falling(p, Clump(ClumpShape{{{shape, Vec3(1e-3, 2e-3, -1e-3), turn(0.7, Vec3(1., 1., 0.))}}}));
    Particles plain;
    plain.add(shape, density, Vec3(0., 0., 1.01 * radius), turn(0.4, Vec3(1., 2., 0.)));
    CHECK(plain.mass[0] == grain.particles.mass[0]);
    CHECK(plain.bounding_radius[0] == grain.particles.bounding_radius[0]);
    for (int n = 0; n < 800; ++n)
    {
      grain.step();
      clump.step();
    }
    CHECK(grain.energy().friction_loss > 0.);
    CHECK(grain.energy().viscous_loss > 0.);
    CHECK_FALSE(clump.particles.has_clumps());
    CHECK(state_hash(clump) == state_hash(grain));
  }
}

TEST_CASE("a grain with another one inside it, and one given twice, move like the grain")
{
  // The hidden part touches nothing; of the body given twice each contact is two, or four between two such bodies, so a
  // half or a quarter of the modulus gives the same forces without dashpots. Mass and inertia are the grain's to the
  // bit (mass_properties() knows both cases), so what differs is rounding: 1e-16 of the places in each of 1500 steps,
  // over overlaps of 1e-3 of the radius, and what the collisions make of it.
  const Threads one_thread(1);
  const Superquadric shape{Vec3(1e-3, 0.8e-3, 0.9e-3), 0.7, 1.2};
  const auto compare = [&](const Clump &body, const double share_of_modulus)
  {
    REQUIRE(body.parts().size() == 2);
    CHECK(body.volume() == volume(shape));
    CHECK(body.inertia_per_density() == inertia_per_density(shape));
    SimulationParameters p = elastic(1e7);
    p.between_grains().friction = p.with_walls().friction = 0.3;
    p.wall().young_modulus *= 0.5; // 1/E + 1/(E/2) = 3/E; twice as much is 1/(E/4) + 1/(E/2)
    SimulationParameters softer = p;
    softer.grain().young_modulus *= share_of_modulus;
    Simulation one = falling(p, Clump(shape)), other = falling(softer, body);
    double deepest = 0.;
    for (int n = 0; n < 1500; ++n)
    {
      one.step();
      other.step();
      for (const TouchingContact &contact : one.contacts.touching(one.particles))
        deepest = std::max(deepest, contact.state.overlap);
    }
    CHECK(deepest > 1e-3 * radius); // they did collide
    for (std::int64_t id = 0; id < 2; ++id)
    {
      const auto i = one.index_of(id), j = other.index_of(id);
      CHECK((one.particles.position[i] - other.particles.position[j]).norm() < 1e-9 * radius);
      CHECK(one.particles.orientation[i].angularDistance(other.particles.orientation[j]) < 1e-8);
      CHECK((one.particles.velocity[i] - other.particles.velocity[j]).norm() < 1e-7);
    }
  };
  compare(Clump(ClumpShape{{{shape}, {sphere(0.3e-3), Vec3(0.2e-3, 0., 0.1e-3)}}}), 1.);
  compare(Clump(ClumpShape{{{shape}, {shape}}}), 0.25);
}

TEST_CASE("a free dumbbell keeps its angular momentum and precesses about it as a symmetric top does")
{
  // Two spheres apart: I_axis = 2 (2/5) m r^2, I_across = I_axis + 2 m a^2. The axis goes round H at |H| / I_across.
  const Threads one_thread(1);
  const double a = 1.3e-3, m = density * 4. / 3. * pi * std::pow(radius, 3);
  const Clump body = dumbbell(a);
  std::vector<double> errors;
  for (const double step : {4e-5, 2e-5})
  {
    SimulationParameters p = elastic(1e7);
    p.time_step = step;
    Particles particles;
    particles.add(body, density, Vec3::Zero(), turn(0.8, Vec3(0., 1., 0.3)));
    const double along_axis = 0.8 * m * radius * radius, across = along_axis + 2. * m * a * a;
    CHECK(particles.mass[0] == Approx(2. * m).epsilon(1e-13));
    CHECK(particles.inertia[0][0] == Approx(along_axis).epsilon(1e-13));
    CHECK(particles.inertia[0][1] == Approx(across).epsilon(1e-13));
    CHECK(particles.inertia[0][2] == Approx(across).epsilon(1e-13));
    const Vec3 momentum = across * 100. * Vec3(1., 0.4, -0.3);
    particles.angular_momentum[0] = momentum;
    const Vec3 axis = particles.orientation[0] * Vec3::UnitX();
    Simulation s(p, particles, {});
    s.compute_forces();
    const double energy = s.energy().kinetic;
    const int n_steps = static_cast<int>(std::lround(0.04 / step));
    for (int n = 0; n < n_steps; ++n)
      s.step();
    CHECK(s.particles.angular_momentum[0] == momentum);
    s.compute_forces();
    CHECK(s.energy().kinetic == Approx(energy).epsilon(1e-5));
    const Vec3 expected = turn(momentum.norm() / across * n_steps * step, momentum) * axis;
    errors.push_back((s.particles.orientation[0] * Vec3::UnitX() - expected).norm());
    // Its parts go with it.
    CHECK((s.particles.part_position(1) - s.particles.part_position(0)).norm() == Approx(2. * a).epsilon(1e-12));
  }
  CHECK(errors[0] < 1e-3);
  CHECK(errors[0] > 3. * errors[1]); // of second order
}

TEST_CASE("a dumbbell rests on two contacts, each with half of its weight")
{
  const Threads one_thread(1);
  SimulationParameters p = elastic(1e7);
  p.gravity = Vec3(0., 0., -9.81);
  Particles particles;
  particles.add(dumbbell(1.3 * radius), density, Vec3::Zero(), along(Vec3(1., 2., 0.)));
  const double weight = particles.mass[0] * 9.81, overlap = std::pow(0.5 * weight / hertz(p.grain(), radius), 2. / 3.);
  particles.position[0][2] = radius - overlap; // where it is at rest
  Simulation s(p, particles, {PlaneWall()});
  for (int n = 0; n < 1000; ++n)
    s.step();
  s.compute_forces();
  const auto contacts = s.contacts.touching_walls(s.particles);
  REQUIRE(contacts.size() == 2);
  for (const TouchingContact &contact : contacts)
  {
    CHECK(contact.first == 0);
    CHECK(contact.state.forces.normal == Approx(0.5 * weight).epsilon(1e-4));
    CHECK(contact.state.point.head<2>().norm() == Approx(1.3 * radius).epsilon(1e-6));
  }
  CHECK(contacts[0].state.point.head<2>().isApprox(-contacts[1].state.point.head<2>(), 1e-6));
  CHECK(s.walls[0].force[2] == Approx(-weight).epsilon(1e-4));
  CHECK(s.particles.torque[0].norm() < 1e-6 * weight * radius);
}

TEST_CASE("a dumbbell rolls down a slope about its axis like a roller")
{
  // a = g sin / (1 + I/(m r^2)), I = 2/5 m r^2 of the two spheres. The friction comes up over its spring, which then
  // swings: of the speed that is at most 2/5 / (omega t), omega = sqrt(7/2 k_t / m) > sqrt(k_n / m).
  const Threads one_thread(1);
  SimulationParameters p = elastic(1e7);
  p.with_walls().friction = 0.5;
  p.contact.overlap_tolerance = 1e-4;
  const double slope = 0.2, g = 9.81;
  p.gravity = g * Vec3(std::sin(slope), 0., -std::cos(slope));
  Particles particles;
  particles.add(dumbbell(1.3 * radius), density, Vec3::Zero(), along(Vec3::UnitY()));
  const double load = 0.5 * particles.mass[0] * g * std::cos(slope), k = hertz(p.grain(), radius),
               overlap = std::pow(load / k, 2. / 3.), stiffness = 2. * 1.5 * k * std::sqrt(overlap);
  particles.position[0][2] = radius - overlap;
  Simulation s(p, particles, {PlaneWall()});
  for (int n = 0; n < 40000; ++n)
    s.step();
  const double omega = std::sqrt(stiffness / s.particles.mass[0]), speed = g * std::sin(slope) / 1.4 * s.time;
  CAPTURE(omega * s.time);
  CHECK(omega * s.time > 100.);
  CHECK(std::abs(s.particles.velocity[0][0] / speed - 1.) < 0.8 / (omega * s.time));
  CHECK(s.particles.angular_velocity[0][1] * radius == Approx(speed).epsilon(0.01));
  CHECK(std::abs((s.particles.orientation[0] * Vec3::UnitX())[1]) == Approx(1.).epsilon(1e-6));
}

TEST_CASE("two dumbbells carry force and torque over two contacts of one pair")
{
  // B lies over A, its line of centres pitched, so that one pair of spheres overlaps more than the other. The forces of
  // spheres go along their lines of centres: F = K overlap^1.5, torque = sum of arm x F.
  const Threads one_thread(1);
  const SimulationParameters p = elastic(1e7);
  const double a = 1.2 * radius, pitch = 3e-3;
  const Clump body = dumbbell(a);
  Particles particles;
  particles.add(body, density, Vec3::Zero(), Quaternion::Identity());
  particles.add(body, density, Vec3(0., 0., 1.99 * radius), turn(pitch, Vec3::UnitY()));
  Simulation s(p, particles, {});
  s.compute_forces();
  REQUIRE(s.contacts.n_touching() == 2);
  Vec3 force = Vec3::Zero(), on_a = Vec3::Zero(), on_b = Vec3::Zero(); // on B; torques
  for (const double side : {-1., 1.})
  {
    const Vec3 arm_a(side * a, 0., 0.), arm_b = turn(pitch, Vec3::UnitY()) * arm_a;
    const Vec3 line = particles.position[1] + arm_b - arm_a;
    const double overlap = 2. * radius - line.norm();
    REQUIRE(overlap > 0.);
    const Vec3 f = hertz(p.grain(), 0.5 * radius) * std::pow(overlap, 1.5) * line.normalized();
    force += f;
    on_b += arm_b.cross(f);
    on_a -= arm_a.cross(f);
  }
  const auto i = s.index_of(0), j = s.index_of(1);
  CHECK((s.particles.force[j] - force).norm() < 1e-8 * force.norm());
  CHECK((s.particles.force[i] + force).norm() < 1e-8 * force.norm());
  CHECK(on_b.norm() > 0.1 * a * force.norm());
  CHECK((s.particles.torque[j] - on_b).norm() < 1e-8 * a * force.norm());
  CHECK((s.particles.torque[i] - on_a).norm() < 1e-8 * a * force.norm());
}

TEST_CASE("a twist of one body against another is held by the friction of both contacts")
{
  // B turns slowly about the vertical over A, which is fixed: each contact is sheared by a w t, its force is its
  // tangential stiffness times that, and the torque has the arm a twice.
  const Threads one_thread(1);
  SimulationParameters p = elastic(1e7);
  p.between_grains().friction = 100.;
  const double a = 1.2 * radius, w = 1e-3;
  constexpr int n_steps = 20;
  const Clump body = dumbbell(a);
  Particles particles;
  particles.add(body, density, Vec3::Zero(), Quaternion::Identity());
  particles.add(body, density, Vec3(0., 0., 1.99 * radius), Quaternion::Identity());
  particles.fix(0);
  Simulation s(p, particles, {});
  s.step(); // the contacts begin
  s.particles.angular_momentum[s.index_of(1)] = Vec3(0., 0., w * s.particles.inertia[s.index_of(1)][2]);
  s.particles.velocity[s.index_of(1)].setZero();
  double angle = 0.;
  for (int n = 0; n < n_steps; ++n)
  {
    s.step();
    angle += s.particles.angular_velocity[s.index_of(1)][2] * p.time_step;
  }
  s.compute_forces();
  const auto contacts = s.contacts.touching(s.particles);
  REQUIRE(contacts.size() == 2);
  double torque = 0.;
  for (const TouchingContact &contact : contacts)
    torque -= contact.state.stiffness.tangential_major * std::sqrt(contact.state.overlap) * a * a * angle;
  CHECK(angle > 0.5 * n_steps * w * p.time_step);
  CHECK(s.particles.torque[s.index_of(1)][2] == Approx(torque).epsilon(0.02)); // the stiffness changes as B rises
}

TEST_CASE("a clump hooks over another one and none of its contacts is lost")
{
  // A, fixed: a lip above the right end of a ledge. B: one tip down behind the lip, on the ledge, the corner above it,
  // the other tip on the lip. Gravity pulls B down and half as much to the right. Without friction the tip behind the
  // lip alone holds it there, with half of mg; the moments about its centre of mass, (2/3, 10/3) r from the tip on the
  // ledge, leave mg/3 to the ledge and 2/3 mg to the top of the lip.
  const Threads one_thread(1);
  SimulationParameters p = elastic(1e7);
  p.set_damping(0.5);
  p.contact.overlap_tolerance = 1e-3;
  p.sort_interval = 1;
  const double d = 2. * radius;
  const Hook ledge(d, -Vec3::UnitX(), Vec3::UnitZ()), hook(d, Vec3::UnitX(), -Vec3::UnitZ());
  Particles particles;
  ledge.add_to(particles, Vec3(d, 0., 0.));
  hook.add_to(particles, Vec3(0., 0., 2. * d));
  particles.fix(0);
  p.gravity = 9.81 * Vec3(0.5, 0., -1.);
  Simulation s(p, particles, {});
  const Vec3 start = s.particles.position[s.index_of(1)];
  std::int32_t fewest = 3;
  for (int n = 0; n < 20000; ++n)
  {
    s.step();
    if (n > 10000)
      fewest = std::min(fewest, s.contacts.n_touching());
  }
  s.compute_forces();
  CHECK(fewest == 3);
  const auto b = s.index_of(1);
  CHECK((s.particles.position[b] - start).norm() < 0.01 * radius);
  const double weight = 9.81 * s.particles.mass[b];
  CHECK((s.particles.force[b] + s.particles.mass[b] * p.gravity).norm() < 1e-3 * weight);
  std::vector<double> forces;
  for (const TouchingContact &contact : s.contacts.touching(s.particles))
    forces.push_back(contact.state.forces.normal / weight);
  std::sort(forces.begin(), forces.end());
  REQUIRE(forces.size() == 3);
  CHECK(forces[0] == Approx(1. / 3.).epsilon(0.01));
  CHECK(forces[1] == Approx(0.5).epsilon(0.01));
  CHECK(forces[2] == Approx(2. / 3.).epsilon(0.01));
  // A body without that tip slides off.
  Particles straight;
  ledge.add_to(straight, Vec3(d, 0., 0.));
  straight.add(dumbbell(radius), density, Vec3(0.5 * d, 0., 2. * d), Quaternion::Identity());
  straight.fix(0);
  Simulation free(p, straight, {});
  const double left = free.particles.position[free.index_of(1)][0];
  for (int n = 0; n < 20000; ++n)
    free.step();
  CHECK(free.particles.position[free.index_of(1)][0] > left + 0.1 * radius);
}

TEST_CASE("a body that turns in its place meets what lies in the way of its parts")
{
  // Its centre stays, so only the turn tells that a part has come near: the ball lies a right angle ahead, far out of
  // range at the start.
  const Threads one_thread(1);
  const double a = 5. * radius;
  Particles particles;
  particles.add(dumbbell(a), density, Vec3::Zero(), Quaternion::Identity());
  particles.add(sphere(radius), density, Vec3(0., a, 0.), Quaternion::Identity());
  const double spin = 100.;
  particles.angular_momentum[0] = Vec3(0., 0., spin * particles.inertia[0][2]);
  SimulationParameters p = elastic(1e7);
  p.time_step = 2e-6;
  Simulation s(p, particles, {});
  CHECK(s.contacts.n_candidates() == 0);
  const double until = (0.5 * pi - 2. * std::asin(radius / a)) / spin; // the arc to where both spheres touch
  while (s.time < until - 10. * p.time_step)
    s.step();
  CHECK(s.contacts.n_touching() == 0);
  while (s.time < until + 10. * p.time_step)
    s.step();
  CHECK(s.contacts.n_touching() == 1);
  for (int n = 0; n < 1000; ++n)
    s.step();
  CHECK(s.contacts.n_touching() == 0);
  CHECK(s.particles.velocity[s.index_of(1)].norm() > 0.1 * spin * a);
}

TEST_CASE("parts of one body never touch each other")
{
  const Threads one_thread(1);
  const Hook hook(0.7 * radius, Vec3::UnitX(), Vec3::UnitZ()); // parts that overlap
  Particles particles;
  hook.add_to(particles, Vec3::Zero());
  particles.angular_momentum[0] = particles.inertia[0].cwiseProduct(Vec3(100., 50., -70.));
  Simulation s(elastic(1e7), particles, {});
  for (int n = 0; n < 200; ++n)
    s.step();
  CHECK(s.contacts.n_candidates() == 0);
  CHECK(s.contacts.n_touching() == 0);
  CHECK(s.particles.force[0] == Vec3::Zero());
}

TEST_CASE("clumps that cannot be are refused")
{
  CHECK_THROWS_AS(Clump(ClumpShape{}), ConfigError);
  CHECK_THROWS_AS(Clump(sphere(-1.)), ConfigError);
  const Clump body = dumbbell(radius);
  for (const double factor : {0., -1., double(NAN), double(INFINITY), 1e40})
    CHECK_THROWS_AS(body.scaled(factor), ConfigError);
  Particles particles;
  CHECK_THROWS_AS(particles.add(body, 0., Vec3::Zero(), Quaternion::Identity()), ConfigError);
  CHECK_THROWS_AS(particles.add(body, 1., Vec3(NAN, 0., 0.), Quaternion::Identity()), ConfigError);
  CHECK(particles.size() == 0);

  // Arrays that were changed by hand.
  particles.add(body, density, Vec3::Zero(), Quaternion::Identity());
  particles.add(sphere(radius), density, Vec3(1e-2, 0., 0.), Quaternion::Identity());
  CHECK_NOTHROW(particles.check(2));
  const auto spoilt = [&](const auto &spoil)
  {
    Particles wrong = particles;
    spoil(wrong);
    CHECK_THROWS_AS(wrong.check(2), ConfigError);
  };
  spoilt([](Particles &p) { p.parts.place[2] = Vec3(1e-3, 0., 0.); });      // a plain grain is at its centre
  spoilt([](Particles &p) { p.parts.turn[2] = turn(0.1, Vec3::UnitX()); }); // and not turned
  spoilt([](Particles &p) { p.parts.place[0][1] = NAN; });
  spoilt([](Particles &p) { p.parts.turn[0].coeffs() *= 2.; });
  spoilt([](Particles &p) { p.parts.reach[0] = 2. * p.bounding_radius[0]; });
  spoilt([](Particles &p) { p.parts.bounding_radius[1] = 0.; });
  spoilt([](Particles &p) { p.parts.particle[0] = 1; });
  spoilt([](Particles &p) { p.first_part = {0, 0, 3}; });
  spoilt([](Particles &p) { p.first_part = {0, 2, 2}; });
}

TEST_CASE("a scaled clump is the clump of scaled parts")
{
  const Hook hook(1.1 * radius, Vec3::UnitX(), Vec3::UnitZ());
  ClumpShape large = hook.shape;
  for (ClumpPart &part : large.parts)
  {
    part.shape.half_axes *= 3.;
    part.position *= 3.;
  }
  const Clump one = hook.clump.scaled(3.), other(large);
  CHECK(one.volume() == Approx(other.volume()).epsilon(1e-5)); // the tolerance of the integrals
  CHECK(one.inertia_per_density().isApprox(other.inertia_per_density(), 1e-5));
  CHECK(one.bounding_radius() == Approx(other.bounding_radius()).epsilon(1e-6));
  CHECK(Clump(sphere(1.)).scaled(2.).volume() == volume(sphere(2.)));
  // Widths of a dumbbell: along its axis the distance and a diameter, across it a diameter.
  const Clump body = dumbbell(1.5);
  CHECK(caliper_width(body, Vec3::UnitX()) == Approx(3. + 2. * radius).epsilon(1e-12));
  CHECK(caliper_width(body, Vec3::UnitY()) == Approx(2. * radius).epsilon(1e-12));
}
