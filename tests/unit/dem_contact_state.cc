#include "dem/core/tangent_frame.h"
#include "dem/force/contact_turn.h"
#include "dem/force/searched_contact.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// A contact of fixed normal and curvature that a machine drives: body 1 rests, body 2 goes along a path.
struct Driven
{
  ContactState<double> s = ContactState<double>::begin();
  ContactLaw law;
  ContactLosses losses; ///< with the weight [J]
  double time_step = 1e-6;
  double work = 0.; ///< of the machine on the contact with its weight, trapezoidal rule on the forces returned [J]
  double largest_energy = 0.;
  Vec3 force = Vec3::Zero();

  Driven(const double friction, const double damping_ratio, const Vec3 &normal = Vec3::UnitZ())
  {
    law.friction = friction;
    law.damping_ratio = damping_ratio;
    s.normal = normal;
    s.axis = tangent_frame(normal).col(0);
    s.stiffness = {1e9, 0.7e9, 0.9e9}; // an ellipse: softer along one axis
    s.reduced_mass = 1e-6;
    s.weight = 1.;
  }

  double stored() const
  {
    const ContactEnergy e = stored_energy(s);
    return e.normal + e.tangential;
  }
  double lost() const { return losses.friction + losses.viscous - losses.quadrature; }

  ContactMotion<double, Vec2> seen(const Vec3 &displacement) const
  {
    return {-s.normal.dot(displacement), {s.axis.dot(displacement), s.second_axis().dot(displacement)}};
  }

  /// Moves body 2 by a displacement relative to body 1; the overlap changes by its normal part.
  void move(const Vec3 &displacement)
  {
    const double old_overlap = s.overlap;
    s.overlap -= s.normal.dot(displacement);
    REQUIRE(s.overlap > 0.);
    advance_contact(s, law, old_overlap, seen(displacement), time_step, losses);
    const Vec3 new_force = s.force();
    work += 0.5 * (force + new_force).dot(displacement); // body 1 is pushed by f, so the machine pulls body 2 by f
    force = new_force;
    largest_energy = std::max(largest_energy, stored());
  }
};

/// Path in the space of displacements of body 2 (overlap = -z): corners with straight lines between.
void follow(Driven &contact, const std::vector<Vec3> &corners, const int n_steps_per_edge)
{
  for (std::size_t i = 1; i < corners.size(); ++i)
    for (int k = 0; k < n_steps_per_edge; ++k)
      contact.move((corners[i] - corners[i - 1]) / n_steps_per_edge);
}

/// A random closed loop that stays in contact: overlaps in (0.1, 2) micrometres, shear of the same size.
std::vector<Vec3> random_loop(std::mt19937_64 &generator, const int n_corners)
{
  std::uniform_real_distribution<double> overlap(0.1e-6, 2e-6), shear(-2e-6, 2e-6);
  std::vector<Vec3> corners;
  for (int i = 0; i < n_corners; ++i)
    corners.emplace_back(shear(generator), shear(generator), -overlap(generator));
  corners.push_back(corners.front());
  return corners;
}

/// Direction of the tangential force that a motion gives.
Vec3 stiffer_along(const ContactState<double> &s, const Vec3 &direction)
{
  const Vec2 force = s.tangential_stiffness().increment({s.axis.dot(direction), s.second_axis().dot(direction)});
  return (s.axis * force[0] + s.second_axis() * force[1]).normalized();
}

} // namespace

TEST_CASE("a closed loop of pressing and shearing never makes energy")
{
  // Without a dashpot. The elastic normal force has a potential, so a closed loop books nothing but the trapezoidal
  // rule's error, which is the same function forth and back. Tangentially every step without slip loses
  //   (k_old/k_new - 1) T^2/(2 k_old) >= 0                          while pressed, and
  //   (1 - r)/2 T.(s + T/k_old), r = k_new/k_old                    while unloaded,
  // which is negative for at most a step of |s| > |T|/k and then by no more than (1 - r) k s^2/8: with n steps an edge
  // the sum over an edge is O(1/n^2) of the energies of the loop, and vanishes with n.
  std::mt19937_64 generator(1);
  double worst_coarse = 0., worst_fine = 0., largest_loss = 0.;
  for (int i = 0; i < 300; ++i)
  {
    for (const double friction : {0.1, 0.5, 1e9})
    {
      const std::vector<Vec3> loop = random_loop(generator, 2 + i % 6);
      for (const int n : {20, 200})
      {
        Driven contact(friction, 0.);
        contact.move(loop.front());
        const double start_stored = contact.stored(), start_work = contact.work, start_loss = contact.lost();
        for (int turn = 0; turn < 2; ++turn)
          follow(contact, loop, n);
        // What the machine put in, less what is stored: never below zero.
        const double made = contact.stored() - start_stored - (contact.work - start_work);
        const double scale = contact.largest_energy;
        double &worst = n == 20 ? worst_coarse : worst_fine;
        worst = std::max(worst, made / scale);
        largest_loss = std::max(largest_loss, -made / scale);
        CHECK(std::abs(made + contact.lost() - start_loss) < 1e-11 * scale);
      }
    }
  }
  CAPTURE(worst_coarse, worst_fine, largest_loss);
  CHECK(worst_coarse < 1e-3);
  CHECK(worst_fine < 1e-5);
  CHECK(largest_loss > 0.1); // the loops do slip and lose
}

TEST_CASE("the cycle that makes energy without the shrinking rule loses some with it")
{
  // Press to overlap d, shear by s, unload to d/4, shear back by s, press again. Stiffness k sqrt(overlap), r = 1/2:
  // put in k s^2/2, kept after unloading r k s^2/2 (spring energy r^2 (k s)^2/(2 r k)), after shearing back T = 0.
  // Work got back on shearing back: r k s^2/2. Lost: (1 - r) k s^2/2. Without the rule T = k s would be kept while the
  // spring softens, and shearing back by s would give k s^2 (1 - r/2): more than was put in.
  for (const int n : {100, 400})
  {
    Driven contact(1e9, 0.);
    const double d = 1e-6, shear = 3e-7;
    contact.move({0., 0., -d});
    const double start = contact.work;
    follow(contact, {{0., 0., -d}, {shear, 0., -d}, {shear, 0., -0.25 * d}, {0., 0., -0.25 * d}, {0., 0., -d}}, n);
    const double k = contact.s.stiffness.tangential_major * std::sqrt(d);
    // The shares multiply to exactly 1/2, and the tangential energies of straight lines are exact; the normal path
    // goes forth and back over the same points. Rounding of 4 n steps.
    CHECK(contact.work - start == Approx(0.25 * k * shear * shear).epsilon(1e-10));
    CHECK(contact.losses.friction == Approx(0.25 * k * shear * shear).epsilon(1e-10));
    CHECK(contact.s.forces.tangential.norm() < 1e-10 * k * shear);
  }
}

TEST_CASE("the tangential force obeys Coulomb's limit and slides along the motion")
{
  // |T| <= mu f_N in every step (rounding of one product), the normal force never pulls. Long sliding by s a step turns
  // the force to where T = share (T + K s), that is along K s: the direction of sliding for a circular contact.
  std::mt19937_64 generator(2);
  for (int i = 0; i < 100; ++i)
    for (const double damping : {0., 0.9})
    {
      Driven contact(0.3, damping);
      const std::vector<Vec3> loop = random_loop(generator, 5);
      contact.move(loop.front());
      for (std::size_t corner = 1; corner < loop.size(); ++corner)
        for (int k = 0; k < 50; ++k)
        {
          contact.move((loop[corner] - loop[corner - 1]) / 50.);
          CHECK(contact.s.forces.normal >= 0.);
          CHECK(contact.s.forces.tangential.norm() <= 0.3 * contact.s.forces.normal * (1. + 1e-15));
          const Vec3 tangential = contact.s.tangential_force();
          CHECK(std::abs(tangential.dot(contact.s.normal)) <= 1e-15 * contact.s.forces.normal);
          CHECK((contact.force - (tangential - contact.s.forces.normal * contact.s.normal)).norm() == 0.);
        }
    }
  Driven contact(0.3, 0.);
  contact.move({0., 0., -1e-6});
  const Vec3 direction = Vec3(1., 2., 0.).normalized();
  const Vec3 force_direction = stiffer_along(contact.s, direction);
  follow(contact, {{0., 0., 0.}, 1e-4 * direction}, 1000);
  const double limit = 0.3 * 1e9 * std::pow(1e-6, 1.5);
  CHECK((contact.s.tangential_force() - limit * force_direction).norm() < 1e-6 * limit);
  // Sliding at the limit over a length l loses limit * l less what the spring holds: T^2/(2 k).
  const double spring =
      tangential_energy(contact.s.tangential_stiffness(), contact.s.forces.tangential, std::sqrt(contact.s.overlap));
  CHECK(contact.losses.friction + spring ==
        Approx(contact.work - 0.5 * 1e9 * std::pow(1e-6, 1.5) * 1e-6).epsilon(1e-12));
  // Of that way the first 1e-6 loads the spring; the rest costs limit * cos(angle between force and sliding).
  CHECK(contact.losses.friction == Approx(limit * force_direction.dot(direction) * 1e-4).epsilon(1e-2));
}

TEST_CASE("booked losses are the work put in less the energy stored, on any path")
{
  // Both losses are made of the trapezoidal rule and the stored energies: the sum is exact but for rounding, in any
  // frame, with dashpot and slip, from first touch to release.
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 300; ++i)
  {
    const Vec3 n = Vec3(normal(generator), normal(generator), normal(generator)).normalized();
    Driven contact(0.1 * (i % 10), 0.15 * (i % 7), n);
    contact.s.weight = i % 2 ? 1. : 0.37;
    const auto frame = tangent_frame(n);
    const std::vector<Vec3> loop = random_loop(generator, 6);
    const auto global = [&](const Vec3 &d) -> Vec3 { return frame * d.head<2>() + n * d[2]; };
    contact.move(global(loop.front()));
    for (std::size_t corner = 1; corner < loop.size(); ++corner)
      for (int k = 0; k < 30; ++k)
        contact.move(global((loop[corner] - loop[corner - 1]) / 30.));
    const double scale = contact.work + contact.largest_energy;
    CHECK(std::abs(contact.work - contact.stored() - contact.lost()) < 1e-12 * scale);

    // Drawn apart in one step: the force acts with its half (trapezoidal rule) and what is left is lost.
    const Vec3 last = 1.1 * contact.s.overlap * n + 0.2e-6 * frame.col(0);
    const double work = contact.work + 0.5 * contact.force.dot(last);
    contact.losses += separate(contact.s, contact.seen(last));
    CHECK(std::abs(work - contact.lost()) < 1e-12 * scale);
  }
}

TEST_CASE("a dashpot loses 2 zeta sqrt(k m) v^2 a second, and never pulls")
{
  // At constant speed with the force positive: power c v^2, c = 2 zeta sqrt(1.5 gamma sqrt(d) m), integrated over the
  // overlap from d0 to d1: loss = v int c dd = 2 zeta v sqrt(1.5 gamma m) (4/5) [d^(5/4)]; trapezoidal rule O(1/n^2).
  double error[2];
  for (int i = 0; i < 2; ++i)
  {
    const int n = i ? 400 : 200;
    Driven contact(0., 0.4);
    const double d0 = 1e-6, d1 = 2e-6, speed = 1e-3;
    contact.time_step = (d1 - d0) / n / speed;
    contact.s.overlap = d0 - (d1 - d0) / n; // one step before, so that the force at d0 is already the moving one
    contact.move({0., 0., -(d1 - d0) / n});
    contact.losses.viscous = 0.;
    follow(contact, {{0., 0., -d0}, {0., 0., -d1}}, n);
    const double expected =
        2. * 0.4 * speed * std::sqrt(1.5 * 1e9 * 1e-6) * 0.8 * (std::pow(d1, 1.25) - std::pow(d0, 1.25));
    error[i] = std::abs(contact.losses.viscous / expected - 1.);
  }
  CHECK(error[1] < 1e-3);
  CHECK(error[0] / error[1] == Approx(4.).epsilon(0.01));

  Driven contact(0.3, 0.9);
  contact.move({0., 0., -1e-6});
  contact.time_step = 1e-12; // torn apart
  contact.move({0., 0., 0.5e-6});
  CHECK(contact.s.forces.normal == 0.);
  CHECK(contact.force.norm() == 0.);
}

TEST_CASE("a contact that turns takes its tangential force along")
{
  // The force keeps its numbers in the frame, and the frame turns with normal and spin: after a rigid rotation of
  // everything by n steps the force is turned rigidly with an error of second order in the step.
  double error[2];
  for (int i = 0; i < 2; ++i)
  {
    const int n = i ? 2000 : 1000;
    ContactState<double> s = ContactState<double>::begin();
    s.normal = Vec3(0.2, -0.4, 0.8).normalized();
    s.axis = tangent_frame(s.normal).col(1);
    s.forces.tangential = {3., -4.};
    const Vec3 start = s.tangential_force(), axis = Vec3(1., 0.5, 2.).normalized(), turn = axis * (2.5 / n);
    for (int step = 0; step < n; ++step)
    {
      TangentFrame frame;
      frame << s.axis, s.second_axis();
      ContactTurn<double> in_step{};
      in_step.tilt = in_frame<double>(frame, turn.cross(s.normal));
      in_step.spin = turn.dot(s.normal);
      const TurnedFrame<double> turned(s.normal, frame, in_step);
      s.normal = turned.normal;
      s.axis = turned.axis;
      const double drift = (step + 1) * std::pow(2.5 / n, 4); // a step's share of the length: w^4 / 8
      CHECK(std::abs(s.normal.norm() - 1.) < drift);
      CHECK(std::abs(s.axis.norm() - 1.) < drift);
      CHECK(std::abs(s.axis.dot(s.normal)) < drift);
    }
    error[i] = (s.tangential_force() - Quaternion(Eigen::AngleAxisd(2.5, axis)) * start).norm() / 5.;
  }
  CHECK(error[0] < 1e-5);
  CHECK(error[0] / error[1] == Approx(4.).epsilon(0.05));
}

TEST_CASE("a contact that is placed takes its tangential force onto the new tangent plane, magnitude kept")
{
  const ElasticPair elastic{1e9, 2e-9, 4e-10};
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i)
  {
    ContactState<double> s = ContactState<double>::begin();
    s.normal = Vec3(normal(generator), normal(generator), normal(generator)).normalized();
    s.axis = tangent_frame(s.normal).col(0);
    s.forces.tangential = {normal(generator), normal(generator)};
    const Vec3 before = s.tangential_force();
    const Vec3 turn = 1e-3 * Vec3(normal(generator), normal(generator), normal(generator));
    const Vec3 turned = (s.normal + turn.cross(s.normal)).normalized();
    const Vec3 axis = from_frame<double>(tangent_frame(turned), {0.6, 0.8});
    place_contact(s, turned, Vec3(0., 0., 0.), 1e-6, RelativeCurvature<double>{1., 2., axis}, elastic);
    CHECK(std::abs(s.tangential_force().norm() - before.norm()) < 1e-14);
    CHECK(std::abs(s.tangential_force().dot(turned)) < 1e-14);
    CHECK((s.tangential_force() - before).norm() < 1e-2 * before.norm());
  }
}
