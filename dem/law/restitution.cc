#include "dem/law/restitution.h"

#include "dem/core/error.h"

#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <sstream>

namespace bergamo::dem
{
namespace
{

/// With lengths over L = (m v^2 / k)^(2/5), times over T = L / v, both elastic force and inertia have the factor one:
///   x'' = -max(x^(3/2) + (3/2) a sqrt(x) x', 0), x(0) = 0, x'(0) = 1, a = A / T
/// so that e depends on the damping number a alone.
double impact_time(const double normal_stiffness, const double reduced_mass, const double speed)
{
  return std::pow(reduced_mass * speed * speed / normal_stiffness, 0.4) / speed;
}

using State = std::array<double, 2>; // depth, velocity

/// Restitution of the impact x'' = -max(x^(3/2) + damping(x) x', 0). The bodies part where the force vanishes, with
/// x > 0, not where x = 0: there the force would be attractive. With y = x^(5/2) for the depth near the start and the
/// velocity w as unknown the equation would be singular; time as variable and a start by the series keep it smooth.
/// @param start the state at t0
template <class Damping>
double restitution_of(const Damping &damping, State s, const double t0)
{
  const auto pull = [&](const State &state) // of the sign of the force
  {
    const double depth = std::max(state[0], 0.);
    return depth * std::sqrt(depth) + damping(depth) * state[1];
  };
  const auto rates = [&](const State &state, State &rate, double)
  {
    rate[0] = state[1];
    rate[1] = -pull(state);
  };
  using Stepper = boost::numeric::odeint::runge_kutta_dopri5<State>;
  auto stepper = boost::numeric::odeint::make_dense_output(1e-13, 1e-13, Stepper());
  stepper.initialize(s, t0, t0);
  for (;;)
  {
    const auto [begin, end] = stepper.do_step(rates);
    if (pull(stepper.current_state()) > 0.)
      continue;
    const auto force = [&](const double t)
    {
      State state;
      stepper.calc_state(t, state);
      return pull(state);
    };
    std::uintmax_t iterations = 100;
    const auto [low, high] =
        boost::math::tools::toms748_solve(force, begin, end, boost::math::tools::eps_tolerance<double>(50), iterations);
    stepper.calc_state(0.5 * (low + high), s);
    return -s[1];
  }
}

double restitution_of_number(const double a)
{
  if (a == 0.)
    return 1.;
  // Leading terms: x = t - (2/5) a t^(5/2) - (4/35) t^(7/2), x' = 1 - a t^(3/2) - (2/5) t^(5/2); next a^2 t^4.
  const double t0 = 1e-5 / (1. + a);
  return restitution_of([a](const double x) { return 1.5 * a * std::sqrt(x); },
                        {t0 - 0.4 * a * std::pow(t0, 2.5), 1. - a * std::pow(t0, 1.5)}, t0);
}

/// Of the dashpot, whose damping is 2 zeta sqrt((3/2) sqrt(x)) in the same units: e depends on zeta alone.
double restitution_of_dashpot(const double ratio)
{
  if (ratio == 0.)
    return 1.;
  const double c = 2. * ratio * std::sqrt(1.5);
  // Leading terms: x = t - (16/45) c t^(9/4), x' = 1 - (4/5) c t^(5/4); next c^2 t^(3/2).
  const double t0 = 1e-7 / (1. + c * c);
  return restitution_of([c](const double x) { return c * std::sqrt(std::sqrt(x)); },
                        {t0 - 16. / 45. * c * std::pow(t0, 2.25), 1. - 0.8 * c * std::pow(t0, 1.25)}, t0);
}

/// 1 - e = first_order a + O(a^2): the work of the damping along the elastic motion w^2 = 1 - (4/5) x^(5/2), there and
/// back, over the energy doubled: 3 int sqrt(x) w dx = (6/5) (5/4)^(3/5) B(3/5, 3/2). It is (3/2) C1 = (3/2) 1.15344 of
/// Schwager & Poeschel (1998).
const double first_order = 1.2 * std::pow(1.25, 0.6) * std::tgamma(0.6) * std::tgamma(1.5) / std::tgamma(2.1);

constexpr double least_restitution = 0.01;

void require_impact(const double normal_stiffness, const double reduced_mass, const double speed)
{
  const auto is_positive = [](const double x) { return x > 0. && std::isfinite(x); };
  require(is_positive(normal_stiffness), "normal stiffness of the impact", normal_stiffness,
          "positive [N/m^1.5]; check moduli and radii");
  require(is_positive(reduced_mass), "reduced mass of the impact", reduced_mass, "positive [kg]; check the density");
  require(is_positive(speed), "speed of the impact", speed, "positive [m/s]; give the speed at which e was measured");
}

} // namespace

double restitution(const double relaxation_time, const double normal_stiffness, const double reduced_mass,
                   const double speed)
{
  require_impact(normal_stiffness, reduced_mass, speed);
  require(relaxation_time >= 0. && std::isfinite(relaxation_time), "relaxation time", relaxation_time,
          "0 or more and finite [s]; 0 is elastic");
  const double time = impact_time(normal_stiffness, reduced_mass, speed);
  if (!(relaxation_time <= 1000. * time)) // e is below 1e-5 there, and the equation stiff
  {
    std::ostringstream allowed;
    allowed << "at most " << 1000. * time << " s for this impact: with more there is no rebound";
    require(false, "relaxation time", relaxation_time, allowed.str());
  }
  return restitution_of_number(relaxation_time / time);
}

double relaxation_time(const double restitution, const double normal_stiffness, const double reduced_mass,
                       const double speed)
{
  require_impact(normal_stiffness, reduced_mass, speed);
  require(restitution >= least_restitution && restitution <= 1., "coefficient of restitution", restitution,
          "in [0.01, 1]; for no rebound use 0.01");
  const double time = impact_time(normal_stiffness, reduced_mass, speed);
  // Nearly elastic: the first order in a, whose error is below that of a difference of e from 1.
  if (1. - restitution < 1e-6)
    return (1. - restitution) / first_order * time;
  // Over the logarithm of the damping number, which spans decades.
  const auto excess = [restitution](const double log_number)
  { return restitution_of_number(std::exp(log_number)) - restitution; };
  const double low = std::log(1e-3 * (1. - restitution));
  double high = 0.;
  while (excess(high) > 0.)
    high += 1.;
  std::uintmax_t iterations = 100;
  const auto [from, to] =
      boost::math::tools::toms748_solve(excess, low, high, boost::math::tools::eps_tolerance<double>(45), iterations);
  return std::exp(0.5 * (from + to)) * time;
}

double restitution_of_ratio(const double damping_ratio)
{
  require(damping_ratio >= 0. && damping_ratio <= 10., "damping ratio", damping_ratio, "in [0, 10]");
  return restitution_of_dashpot(damping_ratio);
}

double damping_ratio_of(const double restitution)
{
  require(restitution >= least_restitution && restitution <= 1., "coefficient of restitution", restitution,
          "in [0.01, 1]; for no rebound use 0.01");
  if (1. - restitution < 1e-6) // below the error of the integration
    return std::sqrt(5. / 6.) * (1. - restitution) / std::numbers::pi;
  const auto excess = [restitution](const double log_ratio)
  { return restitution_of_dashpot(std::exp(log_ratio)) - restitution; };
  double high = -2.;
  while (excess(high) > 0.)
    high += 0.5;
  std::uintmax_t iterations = 100;
  const auto [from, to] = boost::math::tools::toms748_solve(excess, std::log(0.1 * (1. - restitution)), high,
                                                            boost::math::tools::eps_tolerance<double>(45), iterations);
  return std::exp(0.5 * (from + to));
}

} // namespace bergamo::dem
