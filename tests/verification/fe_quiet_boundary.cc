// Waves that leave through a quiet boundary (Lysmer and Kuhlemeyer, J. Eng. Mech. Div. ASCE 95 (1969) 859-877). What is
// reflected of a plane wave follows from the tractions and velocities of the incident and the two reflected waves at
// the dashpots: two linear equations.

#include "dem/core/error.h"
#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/conditions/boundary_conditions.h"
#include "fe_dealii/conditions/quiet_boundary.h"
#include "fe_dealii/equilibrium/static_equilibrium.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"
#include "tests/threads.h"

#include <deal.II/grid/tria.h>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

using namespace bergamo;
using namespace bergamo::fe;
using Catch::Matchers::Contains;

namespace
{

const LinearElastic rock({.young_modulus = 5e7, .poisson_ratio = 0.25, .density = 2000}); // c_p / c_s = √3

ExplicitBody box(const BoxMeshParameters &shape, const ExplicitBodyParameters &parameters)
{
  dealii::Triangulation<3> mesh;
  make_box(shape, mesh);
  return ExplicitBody(mesh, parameters);
}

BoundaryConditions conditions(ExplicitBody &body, const std::vector<const char *> &texts)
{
  std::vector<BoundaryCondition> list;
  for (const char *text : texts)
    list.push_back(parse_condition(text));
  return BoundaryConditions(body, std::move(list));
}

double energy_of_motion(const BodyEnergy &energy)
{
  return energy.kinetic + energy.elastic;
}

// A pulse of velocity in a bar along x.

constexpr double width = 0.1, middle = 0.6, length = 1.2; // standard deviation and place of the pulse [m]

/// A bar whose end at x = length is quiet, with a pulse on its way there.
struct Bar
{
  ExplicitBody body;
  double speed, dt;

  /// @param component that moves: 0 for a P pulse, 1 for an S pulse
  Bar(const ExplicitBodyParameters &parameters, const unsigned int n, const unsigned int component,
      const double wave_speed)
      : body(box({{0, 0, 0}, {length, 0.1, 0.1}, {n, 1, 1}}, parameters)), speed(wave_speed)
  {
    for (unsigned int id = 2; id < 6; ++id)
      for (unsigned int i = 0; i < 3; ++i)
        if (i != component)
          body.prescribe_velocity(id, i);
    body.prescribe_velocity(0u, component);
    conditions(body, {"1 quiet"});
    body.compute_internal_force();
    body.rest();
    dt = 0.5 * stable_step(body).time_step;
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const double from_middle = body.node_position()[node][0] - middle;
      const std::size_t dof = 3 * node + component;
      body.displacement()[dof] = displacement(from_middle);
      body.velocity()[dof] = (displacement(from_middle) - displacement(from_middle + speed * dt)) / dt;
    }
  }

  /// Zero ahead of the pulse, constant behind it.
  static double displacement(const double from_middle)
  {
    return 1e-7 * std::erfc(from_middle / (std::numbers::sqrt2 * width));
  }

  struct Reflection
  {
    double energy, amplitude;
  };
  /// When what came back from the boundary would be where the pulse began.
  Reflection reflection()
  {
    const double velocity = body.max_velocity();
    double kinetic = 0;
    for (double time = 0; time < 2 * (length - middle) / speed; time += dt)
    {
      body.compute_internal_force();
      body.kick(dt);
      if (time == 0)
        kinetic = body.energy().kinetic;
      body.drift(dt);
    }
    const BodyEnergy energy = body.energy();
    CHECK(std::abs(energy.residual()) < 1e-11 * (kinetic + energy.elastic));
    CHECK(energy.radiated == Approx(2 * kinetic).epsilon(0.01)); // a wave's energy is half kinetic
    return {energy.kinetic / kinetic, body.max_velocity() / velocity};
  }
};

} // namespace

TEST_CASE("P and S pulses leave through a quiet boundary: below 1 % comes back, with the square of the element's size",
          "[fe]")
{
  const Threads one(1);
  const unsigned int component = GENERATE(0u, 1u), degree = GENERATE(1u, 2u);
  ExplicitBodyParameters parameters;
  parameters.material = rock;
  parameters.degree = degree;
  std::vector<double> amplitude;
  for (const unsigned int n : {24u, 48u})
  {
    Bar bar(parameters, n / degree, component, component == 0 ? p_wave_speed(rock) : s_wave_speed(rock));
    const Bar::Reflection r = bar.reflection();
    CAPTURE(component, degree, n, r.energy, r.amplitude);
    if (n == 48)
    {
      CHECK(r.energy < 1e-4); // the square of the amplitude
      CHECK(r.amplitude < 1e-2);
    }
    amplitude.push_back(r.amplitude);
  }
  CHECK(amplitude[1] < 0.35 * amplitude[0]);
}

TEST_CASE("a quiet boundary takes the stiffness of the present pressure, and the inertia of mass scaling", "[fe]")
{
  const Threads one(1);
  ExplicitBodyParameters parameters;
  // At four times the reference pressure twice the modulus; the boundary of the reference would reflect 17 %.
  const MohrCoulomb sand({.young_modulus = 5e7,
                          .poisson_ratio = 0.25,
                          .cohesion = 1e6,
                          .density = 2000,
                          .reference_pressure = 1e5,
                          .stiffness_exponent = 0.5});
  parameters.material = sand;
  parameters.initial_stress = uniform_pressure(4e5);
  Bar pressed(parameters, 48, 0, std::numbers::sqrt2 * p_wave_speed(sand));
  CHECK(pressed.reflection().amplitude < 1e-2);

  parameters = {};
  parameters.material = rock;
  const double own_step = stable_step(box({{0, 0, 0}, {length, 0.1, 0.1}, {48, 1, 1}}, parameters)).time_step;
  parameters.wanted_time_step = 2 * own_step; // four times the inertia
  Bar heavy(parameters, 48, 0, 0.5 * p_wave_speed(rock));
  CHECK(heavy.body.mass_scaling().share == Approx(3).epsilon(1e-9));
  CHECK(heavy.reflection().amplitude < 1e-2);
}

namespace
{

// Plane waves u = ∇φ + (∂_y ψ, −∂_x ψ) with φ, ψ = exp i(k_x x + k_y y − ω t), against dashpots at x = 0, body below.

struct Reflected
{
  double p, s;   // amplitudes of φ and ψ over that of the incident one
  double energy; // share of the incident one's flux
};

/// @param along k_y; @param across k_x of the incident wave; @param is_s whether that is ψ
Reflected closed_form(const double along, const double across, const bool is_s)
{
  const double cp = p_wave_speed(rock), cs = s_wave_speed(rock), rho = rock.density(), mu = rock.shear_modulus(),
               lambda = rock.lame_modulus();
  const double omega = (is_s ? cs : cp) * std::hypot(along, across);
  const double kx = std::sqrt(std::pow(omega / cp, 2) - along * along),
               qx = std::sqrt(std::pow(omega / cs, 2) - along * along), k2 = std::pow(omega / cp, 2);
  // Residual of σ_xx + ρ c_p v_x and σ_xy + ρ c_s v_y for a wave of unit amplitude that runs along sign x.
  const auto of_p = [&](const double sign) -> Eigen::Vector2d
  {
    return {-lambda * k2 - 2 * mu * kx * kx + omega * rho * cp * sign * kx,
            -2 * mu * sign * kx * along + omega * rho * cs * along};
  };
  const auto of_s = [&](const double sign) -> Eigen::Vector2d
  {
    return {-2 * mu * sign * qx * along + omega * rho * cp * along,
            mu * (qx * qx - along * along) - omega * rho * cs * sign * qx};
  };
  Eigen::Matrix2d outgoing;
  outgoing << of_p(-1), of_s(-1);
  const Eigen::Vector2d amplitude = outgoing.inverse() * -(is_s ? of_s(1) : of_p(1));
  const double incident = is_s ? qx : kx;
  return {amplitude[0], amplitude[1], (kx * amplitude[0] * amplitude[0] + qx * amplitude[1] * amplitude[1]) / incident};
}

/// A packet of waves at ±angle: between rollers at y = 0 and y = 1, half a wavelength apart, these are one mode of the
/// strip, and the boundary at its end meets them as if the strip had no sides.
struct Packet
{
  bool is_s;
  double across;                                    // mean k_x [1/m]
  double spread;                                    // standard deviation of the envelope in x [m]
  double place;                                     // of its middle at time 0, below x = 0 [m]
  static constexpr double along = std::numbers::pi; // k_y

  Packet(const double angle, const bool s) : is_s(s), across(along / std::tan(angle))
  {
    spread = std::max(2., 6 / across);
    place = -4.5 * spread;
  }

  double speed() const { return is_s ? s_wave_speed(rock) : p_wave_speed(rock); }
  double group_speed() const { return speed() * across / std::hypot(along, across); }

  /// Sum over the spectrum of the envelope. @param take take(k_x, its amplitude)
  template <class Take>
  void for_each_wave(const Take &take) const
  {
    constexpr int n = 60;
    for (int k = -n; k <= n; ++k)
    {
      const double shift = 4. * k / n / spread;
      if (across + shift > 0)
        take(across + shift, std::exp(-0.5 * std::pow(shift * spread, 2)));
    }
  }

  /// u_x over cos k_y y and u_y over sin k_y y.
  std::array<double, 2> displacement(const double x, const double time) const
  {
    std::array<double, 2> u{};
    for_each_wave(
        [&](const double kx, const double amplitude)
        {
          const double phase = kx * (x - place) - speed() * std::hypot(kx, along) * time;
          u[0] += amplitude * (is_s ? along : kx) * std::sin(phase);
          u[1] += amplitude * (is_s ? -kx : along) * std::cos(phase);
        });
    return u;
  }

  double reflected_energy() const
  {
    double sum = 0, whole = 0;
    for_each_wave(
        [&](const double kx, const double amplitude)
        {
          const double energy = std::pow(amplitude * (kx * kx + along * along), 2);
          sum += energy * closed_form(along, kx, is_s).energy;
          whole += energy;
        });
    return sum / whole;
  }
};

double measured_energy(const Packet &packet, const unsigned int n_across)
{
  const double back = 2 * packet.place;
  const unsigned int n_along = std::lround(-back * n_across);
  ExplicitBodyParameters parameters;
  parameters.material = rock;
  ExplicitBody body = box({{back, 0, 0}, {0, 1, 1. / n_across}, {n_along, n_across, 1}}, parameters);
  conditions(body, {"2 velocity y 0", "3 velocity y 0", "4 velocity z 0", "5 velocity z 0", "0 quiet", "1 quiet"});
  body.compute_internal_force();
  body.rest();
  const double dt = 0.7 * stable_step(body).time_step;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const auto &place = body.node_position()[node];
    const auto now = packet.displacement(place[0], 0), before = packet.displacement(place[0], -dt);
    const double side[] = {std::cos(Packet::along * place[1]), std::sin(Packet::along * place[1])};
    for (std::size_t i = 0; i < 2; ++i)
    {
      body.displacement()[3 * node + i] = 1e-6 * now[i] * side[i];
      body.velocity()[3 * node + i] = 1e-6 * (now[i] - before[i]) * side[i] / dt;
    }
  }
  double at_start = 0;
  for (double time = 0; time < -2 * packet.place / packet.group_speed(); time += dt)
  {
    body.compute_internal_force();
    body.kick(dt);
    if (time == 0)
      at_start = energy_of_motion(body.energy());
    body.drift(dt);
  }
  return 1 - body.energy().radiated / at_start;
}

} // namespace

TEST_CASE("waves at an angle are reflected as the dashpots' two equations say", "[fe]")
{
  const Threads one(1);
  struct Case
  {
    double degrees;
    bool is_s;
  };
  const auto c = GENERATE(Case{30, false}, Case{60, false}, Case{20, true});
  const Packet packet(c.degrees * std::numbers::pi / 180, c.is_s);
  const double expected = packet.reflected_energy();
  const double error[] = {measured_energy(packet, 8) - expected, measured_energy(packet, 16) - expected};
  CAPTURE(c.degrees, c.is_s, expected, error[0], error[1]);
  CHECK(std::abs(error[1]) < 0.35 * std::abs(error[0])); // of second order in the element's size
  CHECK(std::abs(error[1]) < 5e-3);
}

// verification_fe "[angles]": the table in docs/results/continuum.md.
TEST_CASE("reflection over the angle, as a table", "[.][angles]")
{
  for (const bool is_s : {false, true})
    for (const double degrees : {0., 15., 20., 25., 30., 45., 60., 70., 80.})
    {
      if (is_s && degrees > 30)
        continue;
      const double angle = degrees * std::numbers::pi / 180;
      const Reflected plane =
          degrees > 0 ? closed_form(Packet::along, Packet::along / std::tan(angle), is_s) : closed_form(0, 1, is_s);
      std::cout << (is_s ? "S " : "P ") << degrees << " closed form: u_p "
                << std::abs(plane.p) * (is_s ? s_wave_speed(rock) / p_wave_speed(rock) : 1) << " u_s "
                << std::abs(plane.s) * (is_s ? 1 : p_wave_speed(rock) / s_wave_speed(rock)) << " energy "
                << plane.energy << std::flush;
      if (degrees >= 15 && degrees <= 70)
      {
        const Packet packet(angle, is_s);
        std::cout << " packet " << packet.reflected_energy() << " found " << measured_energy(packet, 8) << ' '
                  << measured_energy(packet, 16);
      }
      std::cout << std::endl;
    }
}

namespace
{

constexpr double gravity = 9.81;

/// Sand under its weight and a surcharge, all around and below on quiet boundaries.
struct Ground
{
  static constexpr double surcharge = 5e3; // [Pa]
  ExplicitBody body;
  double dt;

  explicit Ground(const unsigned int degree = 1, const double surcharge = Ground::surcharge) : body(make(degree))
  {
    conditions(body, {"0 quiet", "1 quiet", "2 velocity y 0", "3 velocity y 0", "4 quiet"});
    SurfaceLoad(boundary_surface(body.dof_handler(), 5), body.node_position())
        .add_traction({0, 0, -surcharge}, body.external_force());
    find_equilibrium(body);
    dt = 0.5 * stable_step(body).time_step;
  }

  static ExplicitBody make(const unsigned int degree)
  {
    const MohrCoulombParameters sand{.young_modulus = 4e7,
                                     .poisson_ratio = 0.3,
                                     .friction_angle = 30,
                                     .cohesion = 1e3,
                                     .density = 1800,
                                     .reference_pressure = 1e5,
                                     .stiffness_exponent = 0.5};
    ExplicitBodyParameters parameters;
    parameters.material = MohrCoulomb(sand);
    parameters.degree = degree;
    parameters.gravity = {0, 0, -gravity};
    parameters.damping = 2;
    parameters.initial_stress = geostatic_stress({.surface_height = 4,
                                                  .unit_weight = sand.density * gravity,
                                                  .earth_pressure_at_rest = 0.6,
                                                  .surcharge = surcharge});
    return box({{0, 0, 0}, {3, 1, 4}, {3, 1, 4}, {1, 1, 0.5}}, parameters);
  }

  /// A blow on the surface, which waves carry away.
  void strike(const int n_steps)
  {
    const auto lid = body.boundary_nodes(5);
    for (int k = 0; k < n_steps; ++k)
    {
      const double push = k < 20 ? -2e3 * std::sin(0.05 * std::numbers::pi * k) : 0,
                   share = 1 + 0.3 * std::sin(0.7 * k);
      body.external_force()[3 * std::size_t(lid.front()) + 2] += push;
      step(share * dt);
      body.external_force()[3 * std::size_t(lid.front()) + 2] -= push;
    }
  }

  void step(const double time)
  {
    body.compute_internal_force();
    body.kick(time);
    body.drift(time);
  }
};

} // namespace

TEST_CASE("ground at rest stays at rest on quiet boundaries, which hold what they held", "[fe]")
{
  Ground ground(GENERATE(1u, 2u));
  ExplicitBody &body = ground.body;
  double speed = 0;
  for (int k = 0; k < 3000; ++k)
  {
    ground.step(ground.dt);
    speed = std::max(speed, body.max_velocity());
  }
  CHECK(speed < 1e-10 * gravity * 4 / p_wave_speed(body.material())); // of a start out of balance
  double held = 0;
  for (const unsigned int node : body.boundary_nodes(4))
    held += body.held_force(3 * std::size_t(node) + 2);
  CHECK(held == Approx(3 * (4 * 1800 * gravity + Ground::surcharge)));
}

TEST_CASE("a settled column keeps its settlement when its quiet foot is let go", "[fe]")
{
  ExplicitBodyParameters parameters;
  parameters.material = rock;
  parameters.gravity = {0, 0, -gravity};
  ExplicitBody body = box({{0, 0, 0}, {1, 1, 5}, {1, 1, 8}}, parameters);
  conditions(body, {"0 velocity x 0", "1 velocity x 0", "2 velocity y 0", "3 velocity y 0", "4 quiet"});
  find_equilibrium(body);
  const double modulus = rock.bulk_modulus() + 4 * rock.shear_modulus() / 3;
  const double settlement = -rock.density() * gravity * 25 / (2 * modulus);
  const double dt = 0.9 * stable_step(body).time_step;
  for (int k = 0; k < 1000; ++k)
  {
    body.compute_internal_force();
    body.kick(dt);
    body.drift(dt);
  }
  for (const unsigned int node : body.boundary_nodes(5))
    CHECK(body.displacement()[3 * node + 2] == Approx(settlement).epsilon(1e-8));
}

TEST_CASE("a first step that does not know what its quiet boundaries hold is refused", "[fe]")
{
  ExplicitBody body = Ground::make(1);
  conditions(body, {"4 quiet"});
  body.compute_internal_force();
  CHECK_THROWS_WITH(body.kick(1e-4), Contains("find_equilibrium()") && Contains("rest()"));
  body.rest();
  body.kick(1e-4);
  CHECK_THROWS_WITH(conditions(body, {"1 quiet"}), Contains("after 0 steps"));
}

TEST_CASE("with quiet boundaries the energies close to rounding at changing steps", "[fe]")
{
  Ground ground;
  double largest = 0, turnover = 0;
  for (int k = 0; k < 40; ++k)
  {
    ground.strike(25);
    ground.body.compute_internal_force();
    ground.body.kick(ground.dt);
    const BodyEnergy energy = ground.body.energy();
    largest = std::max(largest, std::abs(energy.residual()));
    turnover = std::max({turnover, energy.elastic, energy.radiated});
    ground.body.drift(ground.dt);
  }
  CHECK(largest < 1e-12 * turnover);
  CHECK(ground.body.energy().radiated > 100 * largest);
}

TEST_CASE("dashpots of any size set no limit to the time step and only take energy", "[fe]")
{
  ExplicitBodyParameters parameters;
  parameters.material = rock;
  const double size = GENERATE(1e-3, 1., 1e3, 1e9); // times those of a quiet boundary
  ExplicitBody body = box({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, parameters);
  body.prescribe_velocity(0u, 1);
  for (const unsigned int side : {1u, 5u})
  {
    std::vector<Dashpot> dashpots = quiet_boundary(body, side);
    for (Dashpot &dashpot : dashpots)
    {
      auto &[xx, yy, zz, xy, yz, zx] = dashpot.viscosity;
      xy = yz = zx = 0.3 * std::min({xx, yy, zz}); // as on a face at an angle to the axes
      for (double &component : dashpot.viscosity)
        component *= size;
    }
    body.add_dashpots(dashpots);
  }
  body.compute_internal_force();
  body.rest();
  for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
    body.velocity()[dof] = std::sin(7. * dof);
  const double dt = 0.99 * stable_step(body).time_step;
  // ½ v⁺·M v⁺ + ½ u_n·K u_{n+1} loses Δt v̄·C v̄ in a step, whatever C; below the stable step it is positive.
  double before = HUGE_VAL;
  body.compute_internal_force();
  for (int k = 0; k < 2000; ++k)
  {
    body.kick(dt);
    const BodyEnergy energy = body.energy();
    // To rounding of the drag, which nearly cancels where dashpots are as good as rigid.
    REQUIRE(std::abs(energy.residual()) < 1e-11 * (1. + size) * (energy.initial + energy.radiated));
    const std::vector<double> displacement(body.displacement().begin(), body.displacement().end());
    body.drift(dt);
    body.compute_internal_force();
    double now = 0;
    for (std::size_t dof = 0; dof < displacement.size(); ++dof)
      now += 0.5 * body.mass()[dof] * std::pow(body.velocity()[dof], 2) +
             0.5 * displacement[dof] * body.internal_force()[dof];
    REQUIRE(now > 0);
    REQUIRE(now <= before * (1 + 1e-12));
    before = now;
  }
}

TEST_CASE("a run with quiet boundaries goes on from its state with the same bits", "[fe]")
{
  Ground first, second(1, 0.9 * Ground::surcharge); // its boundaries hold another load, until the state is put into it
  first.strike(30);
  second.dt = first.dt;
  std::copy(first.body.external_force().begin(), first.body.external_force().end(),
            second.body.external_force().begin());
  const auto from = first.body.state(), to = second.body.state();
  REQUIRE(from.size() == to.size());
  for (std::size_t k = 0; k < from.size(); ++k)
    std::copy(from[k].second.begin(), from[k].second.end(), to[k].second.begin());
  // strike() counts its blows from its own beginning, so both go on with another one.
  Ground whole;
  whole.strike(30);
  whole.strike(30);
  second.strike(30);
  const auto ends = whole.body.state(), found = second.body.state();
  for (std::size_t k = 0; k < ends.size(); ++k)
    CHECK(std::equal(ends[k].second.begin(), ends[k].second.end(), found[k].second.begin()));
  CHECK(whole.body.energy().radiated > 0);
}
