#include "dem/loading/cell_loading.h"

#include "dem/core/error.h"
#include "dem/loading/compression.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace bergamo::dem
{
namespace
{

constexpr double checks_needed = 5.;

} // namespace

CellControlParameters cell_walls_for(const MeanGrain &grain, const double density)
{
  CellControlParameters walls;
  walls.wall_density = density;
  walls.wall_thickness = 0.05 * grain.diameter;
  return walls;
}

CellLoading::CellLoading(const LoadingStage &stage, const MeanGrain &grain, const double density)
    : s(stage), control(cell_walls_for(grain, density)),
      strain_rate(strain_rate_of(grain, stage.inertial_number, stage.pressure))
{
  // Axes across a strained one follow it, and have to be able to make up for what they miss.
  constexpr double across_over_axial = 20.;
  control.parameters.largest_rate = stage.is_strained() ? across_over_axial * strain_rate : strain_rate;
}

void CellLoading::begin(Simulation &simulation)
{
  simulation.particles.cell.require_closed("the loading of a cell");
  SimulationParameters parameters = simulation.parameters();
  parameters.between_grains().friction = s.friction;
  parameters.time_step = s.time_step;
  parameters.contact.overlap_tolerance = s.overlap_tolerance;
  simulation.change(parameters);
  follow_stable_step(simulation);
  now = {};
  now.edges = simulation.particles.cell.edges;
  now.start_time = simulation.time;
  control.start_from(simulation.cell_stress());
  now.applied = control.applied;
}

void CellLoading::resume(const State &state)
{
  now = state;
  control.applied = state.applied;
}

void CellLoading::prepare(Simulation &simulation)
{
  // Where the pressure rises, contacts grow stiffer fast.
  const std::int64_t step_interval = s.is_strained() ? 5000 : 500;
  simulation.compute_forces();
  if (simulation.n_steps % step_interval == 0)
    follow_stable_step(simulation); // by the stress of this step: a restart knows no other
  PeriodicCell &cell = simulation.particles.cell;
  const Vec3 stress = simulation.cell_stress();
  double axial_rate = 0.;
  if (s.is_strained())
  {
    const int leg = static_cast<int>(now.leg);
    const double from = leg == 0 ? 0. : end_of_leg(s, leg - 1), to = end_of_leg(s, leg), at = strain(simulation)[2];
    axial_rate = to < from ? -strain_rate : strain_rate;
    if ((to < from && at <= to) || (to > from && at >= to))
      now.leg += 1.;
  }
  else
    check_rest(simulation, stress);
  control.act(cell, controls_of(s, stress, axial_rate), stress, simulation.steps().next_kick);
  now.applied = control.applied;
  if (simulation.time - now.start_time > s.longest_time)
  {
    std::ostringstream message;
    message << "the stage did not end within " << s.longest_time << " s: stresses " << stress.transpose()
            << " Pa, strains " << strain(simulation).transpose() << ", unbalanced force "
            << unbalanced_force(simulation)
            << "; allow more time (longest time), a larger tolerance or a larger inertial number";
    throw RunError(message.str());
  }
}

void CellLoading::check_rest(Simulation &simulation, const Vec3 &stress)
{
  constexpr std::int64_t check_interval = 50; // steps
  if (simulation.n_steps % check_interval != 0)
    return;
  const std::array<AxisControl, 3> controls = controls_of(s, stress, 0.);
  bool holds = true;
  for (int d = 0; d < 3; ++d)
    holds = holds && std::abs(stress[d] - controls[d].value) < s.stress_tolerance * s.pressure;
  now.n_checks_passed = holds && unbalanced_force(simulation) < s.force_tolerance ? now.n_checks_passed + 1. : 0.;
}

/// Contacts grow stiffer under pressure, as its cube root (Hertz): the time step stays a fifth below the stable one,
/// also of the pressure to come.
void CellLoading::follow_stable_step(Simulation &simulation) const
{
  constexpr double margin = 0.8, least_change = 0.02;
  SimulationParameters parameters = simulation.parameters();
  double step = margin * simulation.stable_time_step();
  const double present = -simulation.cell_stress().mean();
  const double to_come = s.path == LoadingPath::true_triaxial ? s.stresses.maxCoeff() : s.pressure;
  if (!s.is_strained() && present > 0.)
    step *= std::min(1., std::pow(present / to_come, 1. / 6.));
  step = std::min(step, s.time_step);
  if (std::abs(step - parameters.time_step) < least_change * parameters.time_step)
    return;
  parameters.time_step = step;
  simulation.change(parameters);
}

bool CellLoading::is_finished() const
{
  return s.is_strained() ? now.leg >= n_legs(s) : now.n_checks_passed >= checks_needed;
}

Vec3 CellLoading::strain(const Simulation &simulation) const
{
  return simulation.particles.cell.edges.cwiseQuotient(now.edges) - Vec3::Ones();
}

double CellLoading::progress(const Simulation &simulation) const
{
  if (is_finished())
    return 1.;
  if (!s.is_strained())
    return std::clamp(-simulation.cell_stress().mean() / s.pressure, 0., 0.99);
  const int leg = static_cast<int>(now.leg);
  const double from = leg == 0 ? 0. : end_of_leg(s, leg - 1), to = end_of_leg(s, leg);
  double done = std::abs(strain(simulation)[2] - from);
  for (int k = 0; k < leg; ++k)
    done += std::abs(end_of_leg(s, k) - (k == 0 ? 0. : end_of_leg(s, k - 1)));
  return to == from ? 0. : std::clamp(done / strain_path(s), 0., 0.99);
}

} // namespace bergamo::dem
