#include "dem/force/contacts.h"
#include "dem/motion/leapfrog.h"
#include "dem/simulation/simulation.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double time_step = 1e-6, range = 1e-4;
constexpr int n_steps = 15; // the lightest bodies are apart after some 50

/// Two bodies and their contact, stepped by hand, so that the order of the arrays is the test's.
struct Pair
{
  Particles particles;
  Contacts contacts{1};
  std::vector<ContactLaw> laws;
  ContactParameters parameters;
  PhaseTimes times;

  Pair(const Superquadric &first, const Superquadric &second, const double friction)
  {
    laws.push_back({elastic_pair({1e8, 0.25, 2500.}, {1e8, 0.25, 2500.}), friction, 0.3, 1e-6});
    const double distance = first.half_axes[2] + second.half_axes[2] - 2e-6;
    particles.add(first, 2500., Vec3::Zero(), Quaternion::Identity());
    particles.add(second, 2500., Vec3(0., 0., distance), Quaternion::Identity());
    particles.velocity[1] = Vec3(1e-2, 3e-3, 0.);
    for (int i = 0; i < 2; ++i) // spins about the normal and across it
      particles.angular_momentum[i] = particles.inertia[i].cwiseProduct(Vec3(0.5 - i, 1. + i, 3. + 2. * i));
    particles.weight = {0.4, 0.9};
    contacts.renew(particles, {}, {}, {range});
  }

  void step()
  {
    contacts.compute(particles, {}, {laws, parameters, time_step}, times);
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
      BodyLoad load;
      for (const LoadSums *sum : contacts.load_sums())
        sum->add_load(i, load);
      particles.force[i] = load.force.head<3>();
      particles.torque[i] = load.torque.head<3>();
    }
    REQUIRE(advance(particles, {}, time_step, time_step));
  }

  /// Who came first comes last.
  void exchange()
  {
    contacts.reorder(particles.reorder({1, 0}), 2);
    contacts.renew(particles, {}, {}, {range});
  }
};

const Superquadric large_sphere{Vec3::Constant(3e-3), 1., 1.}, small_sphere{Vec3::Constant(1e-3), 1., 1.};
const Superquadric large{Vec3(3.2e-3, 2.8e-3, 3e-3), 0.8, 1.2}, small{Vec3(1e-3, 0.8e-3, 1e-3), 0.9, 0.8};

} // namespace

TEST_CASE("exchanged in the arrays, two bodies in contact go on as they would have")
{
  const Threads one_thread(1);
  // Every field of a contact's state takes part: arms, normal, tangential force, spin, weight, stiffness along both
  // axes of the ellipse, budget, last overlap. Rounding alone may differ: 1e-12 of the force at a step, and that over
  // the steps of a contact that makes it no larger.
  for (const auto &[first, second] : {std::pair(large_sphere, small_sphere), std::pair(large, small),
                                      std::pair(large_sphere, small), std::pair(small, large)})
    for (const double friction : {0.05, 1e3})
      for (const bool is_refreshed : {false, true})
      {
        Pair straight(first, second, friction);
        for (int n = 0; n < 20; ++n)
          straight.step();
        REQUIRE(straight.contacts.n_touching() == 1);
        Pair exchanged = straight;
        exchanged.exchange();
        if (is_refreshed)
        {
          straight.contacts.refresh(straight.particles);
          exchanged.contacts.refresh(exchanged.particles);
        }
        const TouchingContact before = straight.contacts.touching(straight.particles)[0],
                              after = exchanged.contacts.touching(exchanged.particles)[0];
        CHECK((after.state.normal + before.state.normal).norm() < 1e-12);
        CHECK((after.state.point - before.state.point).norm() < 1e-15);
        for (int n = 0; n < n_steps; ++n)
        {
          straight.step();
          exchanged.step();
          if (n != 0 && n != n_steps - 1)
            continue;
          const double tolerance = n == 0 ? 1e-12 : 1e-9;
          CAPTURE(friction, is_refreshed, n, first.eps1, second.eps1);
          for (const int i : {0, 1})
          {
            const double force = straight.particles.force[i].norm(), torque = straight.particles.torque[i].norm();
            REQUIRE(force > 0.);
            CHECK((exchanged.particles.force[1 - i] - straight.particles.force[i]).norm() < tolerance * force);
            CHECK((exchanged.particles.torque[1 - i] - straight.particles.torque[i]).norm() < tolerance * torque);
          }
        }
        const ContactLosses lost = straight.contacts.losses(), lost_too = exchanged.contacts.losses();
        CHECK(lost_too.friction == Approx(lost.friction).epsilon(1e-9));
        CHECK(lost_too.viscous == Approx(lost.viscous).epsilon(1e-9));
      }
}

TEST_CASE("the arms of unequal spheres that stick reach from the centres to the contact, in either order")
{
  const Threads one_thread(1);
  // Arms: the radius less half of the overlap; |torque| = arm |tangential force|.
  Pair pair(large_sphere, small_sphere, 1e3);
  for (int n = 0; n < 30; ++n)
    pair.step();
  for (int k = 0; k < 3; ++k)
  {
    const TouchingContact contact = pair.contacts.touching(pair.particles)[0];
    for (std::size_t i = 0; i < 2; ++i)
    {
      const double radius = pair.particles.bounding_radius[i];
      const double tangential = contact.state.weight * contact.state.forces.tangential.norm();
      CHECK(pair.particles.torque[i].norm() ==
            Approx((radius - 0.5 * contact.state.overlap) * tangential).epsilon(1e-3)); // of the step before
    }
    pair.exchange();
    pair.step();
  }
}
