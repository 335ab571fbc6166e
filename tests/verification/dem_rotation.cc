#include "dem/motion/rotation.h"
#include "dem/simulation/simulation.h"

#include "tests/threads.h"
#include <algorithm>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <omp.h>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double pi = std::numbers::pi;

double rotational_energy(const Quaternion &orientation, const Vec3 &inertia, const Vec3 &momentum)
{
  return 0.5 * momentum.dot(angular_velocity(orientation.toRotationMatrix(), inertia, momentum));
}

/// Orientation turned by a rotation vector [rad], as one lane of the kernel.
Quaternion turned_by(const Vec3 &theta, const Quaternion &q)
{
  const Orientation<double> p = turned(Orientation<double>{q.x(), q.y(), q.z(), q.w()}, theta);
  return {p.w, p.x, p.y, p.z};
}

struct FreeRotation
{
  Quaternion orientation;
  double largest_energy_error = 0., last_energy_error = 0.; ///< relative
};

FreeRotation rotate_freely(Quaternion q, const Vec3 &inertia, const Vec3 &momentum, const double time,
                           const int n_steps)
{
  const double dt = time / n_steps, start = rotational_energy(q, inertia, momentum);
  FreeRotation r;
  for (int i = 0; i < n_steps; ++i)
  {
    q = turned_by(dt * mean_angular_velocity(Orientation<double>{q.x(), q.y(), q.z(), q.w()}, inertia, momentum, dt),
                  q);
    r.last_energy_error = rotational_energy(q, inertia, momentum) / start - 1.;
    r.largest_energy_error = std::max(r.largest_energy_error, std::abs(r.last_energy_error));
  }
  r.orientation = q;
  return r;
}

/// Mean order over a series of errors for steps that halve.
double order(const std::vector<double> &errors)
{
  return std::log2(errors.front() / errors.back()) / (errors.size() - 1.);
}

const Quaternion start = Quaternion(0.9, 0.1, 0.2, 0.3).normalized();
const Vec3 momentum(0.9, 0.4, 0.7);
constexpr double time_span = 20.;

} // namespace

TEST_CASE("a rotation by a vector agrees with the axis-angle form through the switch to the series")
{
  const Threads one_thread(1);
  // Series to 1e-16 below an angle of one (half of it counts), closed form above; no jump at the switch.
  const Vec3 axis = Vec3(1., -2., 0.5).normalized();
  for (double angle : {0., 1e-12, 1e-5, 1e-2, 0.3, 0.999999, 1.000001, 3., 7.})
  {
    const Quaternion q = turned_by(angle * axis, Quaternion::Identity()), expected(Eigen::AngleAxisd(angle, axis));
    CHECK((q.coeffs() - expected.coeffs()).norm() < 5e-16);
    CHECK(std::abs(q.norm() - 1.) < 5e-16);
  }
}

TEST_CASE("torque-free rotation is of fourth order in the time step")
{
  const Threads one_thread(1);
  // Runge-Kutta's order 4 for the orientation; the energy, a function of it, is at least as good. The error is measured
  // against the same scheme with steps 32 times shorter than the shortest, whose own error is 1e-6 of it.
  for (const Vec3 &inertia : {Vec3(1., 2.3, 3.1), Vec3(1., 1., 2.), Vec3(2., 1., 2.)})
  {
    const Quaternion reference = rotate_freely(start, inertia, momentum, time_span, 800 * 32).orientation;
    std::vector<double> orientation, energy;
    for (int n = 200; n <= 800; n *= 2)
    {
      const FreeRotation r = rotate_freely(start, inertia, momentum, time_span, n);
      orientation.push_back(r.orientation.angularDistance(reference));
      energy.push_back(r.largest_energy_error);
    }
    CAPTURE(inertia.transpose(), orientation, energy);
    CHECK(order(orientation) > 3.8);
    CHECK(order(orientation) < 4.3);
    CHECK(order(energy) > 3.8);
  }
}

TEST_CASE("a symmetric top precesses at H / I1 and spins at its closed rate")
{
  const Threads one_thread(1);
  // Torque-free top with I1 = I2: the axis turns about H at the rate H/I1, and the body turns about its axis, relative
  // to the precessing frame, at the rate H3 (1/I3 - 1/I1): q(t) = R(H, |H| t/I1) q(0) R(e3, H3 (1/I3 - 1/I1) t).
  for (const Vec3 &inertia : {Vec3(1., 1., 2.), Vec3(2., 2., 0.7)})
  {
    const double h3 = (start.conjugate() * momentum)[2];
    const Quaternion expected =
        Quaternion(Eigen::AngleAxisd(momentum.norm() * time_span / inertia[0], momentum.normalized())) * start *
        Quaternion(Eigen::AngleAxisd(h3 * (1. / inertia[2] - 1. / inertia[0]) * time_span, Vec3::UnitZ()));
    std::vector<double> errors;
    for (int n = 200; n <= 1600; n *= 2)
      errors.push_back(rotate_freely(start, inertia, momentum, time_span, n).orientation.angularDistance(expected));
    CAPTURE(errors);
    CHECK(order(errors) > 3.8);
    CHECK(errors.back() < 1e-7);
  }
}

TEST_CASE("a grain spins freely for 100000 steps")
{
  const Threads one_thread(1);
  // No torque: H is never touched, so |H| is kept to 1e-13 (to the bit). One turn takes some 60 steps; with the order
  // of the scheme the energy's drift over 1600 turns stays below 1e-3 and falls by more than 2^4 with half the step.
  // The orientation stays unit to rounding because it is normalised in every step.
  SimulationParameters parameters;
  const Superquadric shape{{0.3e-3, 0.4e-3, 1.1e-3}, 0.8, 0.9};
  double error[2];
  for (int run = 0; run < 2; ++run)
  {
    Particles grains;
    grains.add(shape, 2650., Vec3::Zero(), start);
    const Vec3 spin(60., 25., 40.); // 1/s
    grains.angular_momentum[0] = start * Vec3(grains.inertia[0].cwiseProduct(start.conjugate() * spin));
    parameters.time_step = (run ? 0.5 : 1.) * 2. * pi / 60. / spin.norm();
    const Vec3 before = grains.angular_momentum[0];
    Simulation simulation(parameters, grains, {});
    const auto energy = [&]
    {
      return rotational_energy(simulation.particles.orientation[0], simulation.particles.inertia[0],
                               simulation.particles.angular_momentum[0]);
    };
    const double energy_before = energy();
    double worst_norm = 0.;
    for (int i = 0; i < (run ? 200000 : 100000); ++i)
    {
      simulation.step();
      worst_norm = std::max(worst_norm, std::abs(simulation.particles.orientation[0].norm() - 1.));
    }
    error[run] = std::abs(energy() / energy_before - 1.);
    CHECK(std::abs(simulation.particles.angular_momentum[0].norm() / before.norm() - 1.) < 1e-13);
    CHECK((simulation.particles.angular_momentum[0] - before).norm() <= 1e-13 * before.norm());
    CHECK(worst_norm < 5e-16);
    CHECK(simulation.particles.position[0].norm() == 0.);
  }
  CAPTURE(error[0], error[1]);
  CHECK(error[0] < 1e-3);
  CHECK(error[1] < error[0] / 16.);
}
