// A continuum whose elements' forces are computed at every m-th step of the grains: impulses of m steps (r-RESPA;
// Tuckerman, Berne & Martyna, J. Chem. Phys. 97 (1992) 1990-2001). What is kept exactly and what to second order.

#include "coupling/adapter/model_energy.h"
#include "coupling/adapter/two_scale_model.h"
#include "coupling/model/energy_balance.h"
#include "dem/core/error.h"
#include "dem/core/state.h"
#include "dem/loading/compression.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/state/positions_by_id.h"
#include "fe_dealii/conditions/quiet_boundary.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "tests/temporary_folder.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <numbers>

using namespace bergamo;
using coupling::TwoScaleModel;

namespace
{

constexpr double edge = 0.006, layer = 0.002; // [m]; three layers, the middle one shared
constexpr double step = 4e-7;                 // [s]

/// A steady part that stays as it was at the first step.
coupling::Subcycling every(const int n_steps)
{
  return {n_steps, std::numeric_limits<double>::infinity()};
}

std::unique_ptr<fe::ExplicitBody> make_body(const double pressure = 0., const double damping = 0.)
{
  fe::ExplicitBodyParameters parameters;
  parameters.material = fe::MohrCoulomb({.cohesion = 1e9}); // elastic
  parameters.initial_stress = fe::uniform_pressure(pressure);
  parameters.damping = damping;
  return std::make_unique<fe::ExplicitBody>(
      fe::make_box_body({{0., 0., 0.}, {edge, edge, 2. * layer}, {3, 3, 2}}, parameters));
}

std::vector<Vec3> reference_of(const dem::Particles &grains)
{
  return dem::positions_by_id(grains);
}

/// Grains that touch nothing.
std::unique_ptr<dem::Simulation> make_grains(const double time_step)
{
  std::mt19937_64 generator(7);
  const dem::Box box{Vec3(0., 0., layer), Vec3(edge, edge, 3. * layer)};
  const auto grains = dem::draw_grains(dem::GrainDistribution(), 0.2 * box.volume(), generator);
  dem::SimulationParameters parameters;
  parameters.time_step = time_step;
  return std::make_unique<dem::Simulation>(parameters, dem::add_at_random(grains, box, 2650., generator()),
                                           std::vector<dem::PlaneWall>());
}

/// Grains and a body in an overlap. The penalty is soft, so that impulses do not meet the coupling's own vibrations.
TwoScaleModel joined(std::unique_ptr<dem::Simulation> grains, const std::vector<Vec3> &reference,
                     const double damping = 0.)
{
  const double time_step = grains->parameters().time_step;
  TwoScaleModel model(std::move(grains), make_body(0., damping), time_step);
  std::vector<double> weight;
  for (const auto &x : model.body()->node_position())
    weight.push_back(std::clamp((x[2] - layer) / layer, 0., 1.));
  coupling::CouplingParameters join;
  join.penalty = 1e13;
  join.edge.stiffness = 1e14;
  model.join(join, weight, reference);
  return model;
}

TwoScaleModel make_model(const double time_step, const int steps_per_force, const double damping = 0.)
{
  auto grains = make_grains(time_step);
  const std::vector<Vec3> reference = reference_of(grains->particles);
  TwoScaleModel model = joined(std::move(grains), reference, damping);
  model.continuum()->compute_every(every(steps_per_force), time_step);
  return model;
}

/// The body is stretched, so that it vibrates, and the grains fly.
void set_in_motion(TwoScaleModel &model)
{
  const auto u = model.body()->displacement();
  for (std::size_t node = 0; node < model.body()->n_nodes(); ++node)
    for (int d = 0; d < 3; ++d)
      u[3 * node + d] = 1e-4 * (d == 2 ? 1. : 0.3) * (model.body()->node_position()[node][d] - 1e-3);
  for (Vec3 &v : model.grains()->particles.velocity)
    v = Vec3(0.01, -0.005, -0.02);
}

void run(TwoScaleModel &model, const int n_steps)
{
  for (int k = 0; k < n_steps; ++k)
  {
    model.compute_forces();
    model.kick();
    model.drift();
  }
}

std::vector<double> state_of(const TwoScaleModel &model)
{
  std::vector<double> state;
  for (const auto *vectors : {&model.grains()->particles.position, &model.grains()->particles.velocity})
    for (const Vec3 &x : *vectors)
      state.insert(state.end(), x.data(), x.data() + 3);
  const fe::ExplicitBody &body = *model.body();
  for (const auto &values : {body.displacement(), body.velocity()})
    state.insert(state.end(), values.begin(), values.end());
  return state;
}

Vec3 momentum(const TwoScaleModel &model)
{
  Vec3 sum = Vec3::Zero();
  const dem::Particles &p = model.grains()->particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    sum += p.weight[i] * p.mass[i] * p.velocity[i];
  const fe::ExplicitBody &body = *model.body();
  for (std::size_t k = 0; k < body.velocity().size(); ++k)
    sum[k % 3] += body.mass()[k] * body.velocity()[k];
  return sum;
}

/// Largest of the errors of the balance of energy at the first steps of cycles over a time [J].
/// @param load sets what is prescribed, by time
template <class Load>
double energy_error(TwoScaleModel &model, const double time, const Load &load)
{
  const double time_step = model.grains()->parameters().time_step;
  const int n_steps = static_cast<int>(std::lround(time / time_step)), cycle = model.continuum()->steps_per_force();
  double first = 0., largest = 0.;
  for (int k = 0; k <= n_steps; ++k)
  {
    model.compute_forces();
    load((k + 0.5) * time_step);
    model.kick();
    if (k % cycle == 0)
    {
      const double balance = coupling::energy_of(model).balance();
      if (k == 0)
        first = balance;
      largest = std::max(largest, std::abs(balance - first));
    }
    model.drift();
  }
  return largest;
}

/// The same model made anew, with all that snapshots hold put back.
TwoScaleModel restarted(TwoScaleModel &old, const std::vector<Vec3> &reference)
{
  const TemporaryFolder folder;
  {
    ArchiveWriter writer(folder / "snapshot.h5", "subcycled");
    StateWriter state(writer, "coupling");
    state("continuum", std::as_const(*old.continuum()));
    state("overlap", std::as_const(*old.overlap()));
    writer.commit();
  }
  TwoScaleModel fresh = joined(std::make_unique<dem::Simulation>(*old.grains()), reference);
  fresh.continuum()->compute_every(every(old.continuum()->steps_per_force()), step);
  const auto from = old.body()->state();
  const auto to = fresh.body()->state();
  REQUIRE(from.size() == to.size());
  for (std::size_t k = 0; k < from.size(); ++k)
    std::copy(from[k].second.begin(), from[k].second.end(), to[k].second.begin());
  ArchiveReader reader(folder / "snapshot.h5", "subcycled");
  StateReader state(reader, "coupling");
  state("continuum", *fresh.continuum());
  state("overlap", *fresh.overlap());
  return fresh;
}

const auto no_load = [](double) {};

} // namespace

TEST_CASE("forces at every step are the model without subcycling, bit for bit")
{
  auto grains = make_grains(step);
  const std::vector<Vec3> reference = reference_of(grains->particles);
  TwoScaleModel plain = joined(std::move(grains), reference), single = make_model(step, 1);
  set_in_motion(plain);
  set_in_motion(single);
  run(plain, 200);
  run(single, 200);
  CHECK(state_of(single) == state_of(plain));
}

TEST_CASE("at the end of each cycle grains and free body have the momentum of the start")
{
  const int m = GENERATE(2, 5, 10);
  TwoScaleModel model = make_model(0.25 * step, m);
  set_in_motion(model);
  const Vec3 start = momentum(model);
  Vec3 of_grains = Vec3::Zero();
  for (int cycle = 0; cycle < 100; ++cycle)
  {
    run(model, m);
    CHECK((momentum(model) - start).norm() < 1e-12 * start.norm());
  }
  const dem::Particles &p = model.grains()->particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    of_grains += p.weight[i] * p.mass[i] * p.velocity[i];
  CHECK((of_grains - start).norm() > 1e-3 * start.norm()); // else nothing has been exchanged
}

TEST_CASE("the energy of a free coupled vibration is kept to second order in the step")
{
  const int m = GENERATE(2, 5);
  const auto error = [&](const double time_step)
  {
    TwoScaleModel model = make_model(time_step, m);
    set_in_motion(model);
    return energy_error(model, 2e-4, no_load);
  };
  TwoScaleModel model = make_model(step, m);
  set_in_motion(model);
  model.compute_forces();
  model.kick();
  const coupling::ModelEnergy start = coupling::energy_of(model);
  const double coarse = error(step), fine = error(0.5 * step), ratio = coarse / fine;
  CAPTURE(m, coarse, fine, start.continuum_elastic, start.kinetic);
  CHECK(ratio > 3.);
  CHECK(ratio < 5.5);
  CHECK(coarse < 0.05 * (start.continuum_elastic + start.kinetic));
}

TEST_CASE("under load and damping the account of a subcycled body closes to second order with the work of its boundary")
{
  constexpr double time = 2e-4, speed = 0.02; // [s], [m/s]
  double work = 0., damped = 0.;
  const auto error = [&](const double time_step)
  {
    TwoScaleModel model = make_model(time_step, 5, 500.);
    const auto foot = model.body()->prescribe_velocity(4, 2);
    const double largest =
        energy_error(model, time,
                     [&](const double t)
                     { model.body()->set_velocity(foot, speed * std::pow(std::sin(std::numbers::pi * t / time), 2)); });
    model.compute_forces();
    model.kick();
    work = coupling::energy_of(model).wall_work;
    damped = coupling::energy_of(model).viscous_loss;
    return largest;
  };
  const double coarse = error(step), fine = error(0.5 * step), ratio = coarse / fine;
  CAPTURE(coarse, fine, work, damped);
  CHECK(damped > 0.01 * std::abs(work));
  CHECK(ratio > 3.);
  CHECK(ratio < 5.5);
  CHECK(coarse < 0.02 * std::abs(work));
}

TEST_CASE("a subcycled run has the same bits on any number of threads and after a restart at any step of a cycle")
{
  constexpr int m = 4, n_steps = 47;
  const auto run_on = [&](const int n_threads)
  {
    const Threads threads(n_threads);
    TwoScaleModel model = make_model(step, m);
    set_in_motion(model);
    run(model, n_steps);
    return state_of(model);
  };
  const std::vector<double> one = run_on(1);
  CHECK(run_on(2) == one);
  CHECK(run_on(3) == one);
  for (int phase = 0; phase < m; ++phase)
  {
    CAPTURE(phase);
    auto grains = make_grains(step);
    const std::vector<Vec3> reference = reference_of(grains->particles);
    TwoScaleModel model = make_model(step, m);
    set_in_motion(model);
    run(model, 20 + phase);
    TwoScaleModel further = restarted(model, reference);
    run(further, n_steps - 20 - phase);
    CHECK(state_of(further) == one);
  }
}

TEST_CASE("a subcycled body at rest stays at rest between walls and quiet boundaries, and tells what they bear")
{
  constexpr double pressure = 1e5; // [Pa]
  constexpr int m = 5;
  TwoScaleModel model(nullptr, make_body(pressure), step);
  fe::ExplicitBody &body = *model.body();
  const auto wall = body.prescribe_velocity(0, 0);
  for (unsigned int face = 1; face < 5; ++face)
    if (face != 4)
      body.prescribe_velocity(face, face / 2);
  const auto top = body.prescribe_velocity(5, 2);
  body.add_dashpots(fe::quiet_boundary(body, 4));
  model.continuum()->compute_every(every(m), step);
  model.compute_forces();
  body.rest();
  run(model, 40 * m);
  model.compute_forces();
  model.kick();
  // Rounding of displacements of zero: stresses of 1e-16 p move nodes by that share of what p would.
  CHECK(body.max_velocity() < 1e-12 * pressure / (1780. * 300.));
  CHECK(model.continuum()->reaction(wall) == Approx(pressure * edge * 2. * layer));
  CHECK(model.continuum()->reaction(top) == Approx(-pressure * edge * edge));
}

TEST_CASE("forces further apart than the stable step of the elements are refused before the run")
{
  TwoScaleModel model = make_model(step, 1);
  const double stable = model.parts().movers()[1]->stable_step();
  const int most = static_cast<int>(stable / step);
  CHECK_NOTHROW(model.continuum()->compute_every(every(most), step));
  CHECK_THROWS_WITH(model.continuum()->compute_every(every(most + 1), step),
                    Catch::Contains("stable step of its elements") && Catch::Contains("more often"));
  CHECK_THROWS_WITH(model.continuum()->compute_every(every(0), step), Catch::Contains("1 or more"));
  CHECK_THROWS_WITH(model.continuum()->compute_every({2, 0.}, step), Catch::Contains("positive time"));
  CHECK(model.continuum()->steps_per_force() == most);
  run(model, 1);
  CHECK_THROWS_WITH(model.continuum()->compute_every(every(1), step), Catch::Contains("before the first"));
}

TEST_CASE("the steady part of the loads follows them in its time, at the price of a growth that is as small as it says")
{
  // Free vibrations gain n dt / 4 steady_time^2 of their energy in unit time at most: 0.25 % in 0.2 ms here.
  constexpr int m = 5;
  constexpr double steady_time = 2e-4, time = 2e-4; // [s]
  const auto gain = [&](const double follows)
  {
    auto grains = make_grains(step);
    const std::vector<Vec3> reference = reference_of(grains->particles);
    TwoScaleModel model = joined(std::move(grains), reference);
    model.continuum()->compute_every({m, follows}, step);
    set_in_motion(model);
    return energy_error(model, time, no_load);
  };
  TwoScaleModel model = make_model(step, m);
  set_in_motion(model);
  model.compute_forces();
  model.kick();
  const coupling::ModelEnergy start = coupling::energy_of(model);
  const double all = start.continuum_elastic + start.kinetic;
  const double stays = gain(std::numeric_limits<double>::infinity()), follows = gain(steady_time);
  CAPTURE(all, stays, follows);
  CHECK(std::abs(follows - stays) < 4. * m * step / (4. * steady_time * steady_time) * time * all);
}
