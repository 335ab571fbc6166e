#include "drivers/beam_impact/beam_theory.h"

#include <boost/numeric/odeint.hpp>

#include <cmath>
#include <numbers>

namespace bergamo::driver
{
namespace
{

using State = std::vector<double>; // of the sphere, then of each mode: places before velocities

/// Right side of the equations of motion. A mode's deflection is W sin(k x), its rotation of the section Θ cos(k x).
class Equations
{
public:
  Equations(const ImpactParameters &p, const BeamTheory theory)
      : p(p), is_thick(theory == BeamTheory::thick), area(p.edge * p.edge), second_moment(area * area / 12.)
  {
    const double nu = p.material.poisson_ratio;
    shear_stiffness =
        10. * (1. + nu) / (12. + 11. * nu) * area * p.material.young_modulus / (2. * (1. + nu)); // of a rectangle
  }

  State start() const
  {
    State state(2 + n_of_mode() * p.n_modes, 0.);
    state[1] = p.velocity;
    return state;
  }

  double deflection(const State &state) const
  {
    double sum = 0.;
    for (unsigned int mode = 0; mode < p.n_modes; ++mode)
      sum += in_the_middle(mode) * state[2 + n_of_mode() * mode];
    return sum;
  }

  double force(const State &state) const
  {
    const double overlap = state[0] - deflection(state);
    return overlap > 0. ? p.hertz_stiffness() * overlap * std::sqrt(overlap) : 0.;
  }

  void operator()(const State &state, State &rate, double /*time*/) const
  {
    const double on_beam = force(state), bending = p.material.young_modulus * second_moment,
                 mass = p.material.density * area, inertia = p.material.density * second_moment;
    rate[0] = state[1];
    rate[1] = -on_beam / p.sphere_mass();
    for (unsigned int mode = 0; mode < p.n_modes; ++mode)
    {
      const double k = (2. * mode + 1.) * std::numbers::pi / p.length;
      const double load = 2. / p.length * on_beam * in_the_middle(mode);
      const double *now = &state[2 + n_of_mode() * mode];
      double *then = &rate[2 + n_of_mode() * mode];
      then[0] = now[1];
      if (is_thick)
      {
        const double shear = shear_stiffness * (k * now[0] - now[2]);
        then[1] = (load - k * shear) / mass;
        then[2] = now[3];
        then[3] = (shear - bending * k * k * now[2]) / inertia;
      }
      else
        then[1] = (load - bending * k * k * k * k * now[0]) / mass;
    }
  }

private:
  std::size_t n_of_mode() const { return is_thick ? 4 : 2; }
  static double in_the_middle(const unsigned int mode) { return mode % 2 == 0 ? 1. : -1.; } // sin(k L/2)

  const ImpactParameters &p;
  bool is_thick;
  double area, second_moment; // [m^2], [m^4]
  double shear_stiffness;     // [N]
};

} // namespace

Trajectory solve_impact(const ImpactParameters &p, const BeamTheory theory, const double time_step,
                        const std::int64_t n_steps)
{
  namespace odeint = boost::numeric::odeint;
  constexpr double digits = 1e-9;
  const Equations equations(p, theory);
  State state = equations.start();
  std::vector<double> times;
  for (std::int64_t n = 0; n <= n_steps; ++n)
    times.push_back(static_cast<double>(n) * time_step);
  Trajectory way;
  const auto method =
      odeint::make_dense_output(digits * p.velocity * time_step, digits, odeint::runge_kutta_dopri5<State>());
  odeint::integrate_times(
      method, [&](const State &x, State &rate, const double t) { equations(x, rate, t); }, state, times.begin(),
      times.end(), time_step,
      [&](const State &x, double)
      {
        way.sphere.push_back(x[0]);
        way.beam.push_back(equations.deflection(x));
        way.force.push_back(equations.force(x));
      });
  return way;
}

} // namespace bergamo::driver
