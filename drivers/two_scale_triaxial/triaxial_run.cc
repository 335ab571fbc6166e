#include "drivers/two_scale_triaxial/triaxial_run.h"

#include "dem/core/error.h"
#include "dem/core/pvd.h"
#include "dem/core/whole_file.h"
#include "dem/io/vtu.h"
#include "drivers/common/interrupt.h"
#include "fe_dealii/output.h"
#include "fe_dealii/stable_step.h"

#include <omp.h>

#include <cmath>
#include <cstdio>
#include <sstream>

namespace bergamo::driver
{
namespace
{

const std::vector<std::string> columns = {"time_s",
                                          "stage",
                                          "strain_1",
                                          "strain_2",
                                          "strain_3",
                                          "stress_1_Pa",
                                          "stress_2_Pa",
                                          "stress_3_Pa",
                                          "energy_kinetic_J",
                                          "energy_grains_elastic_J",
                                          "energy_continuum_elastic_J",
                                          "energy_coupling_J",
                                          "energy_friction_loss_J",
                                          "energy_viscous_loss_J",
                                          "energy_plastic_loss_J",
                                          "energy_wall_work_J",
                                          "energy_gravity_work_J",
                                          "energy_curvature_work_J",
                                          "energy_residual_J",
                                          "coordination_number",
                                          "max_overlap_over_radius",
                                          "coupling_difference_m"};

std::string picture_name(const char *model, const std::size_t number)
{
  char name[64];
  std::snprintf(name, sizeof name, "%s_%04zu.vtu", model, number);
  return name;
}

std::vector<Vec3> places_by_id(const dem::Simulation &grains)
{
  std::vector<Vec3> places(grains.particles.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    places[grains.particles.id[i]] = grains.particles.position[i];
  return places;
}

const char *name_of(const ModelKind kind)
{
  switch (kind)
  {
  case ModelKind::grains:
    return "grains";
  case ModelKind::continuum:
    return "continuum";
  default:
    return "two-scale";
  }
}

} // namespace

TriaxialRun::TriaxialRun(const TriaxialParameters &p, const CommandLine &command_line, std::string text, RunFolder &f)
    : parameters(p), parameter_text(std::move(text)), folder(f), is_restart(command_line.restart),
      progress(ProgressOptions::standard(command_line.quiet)), snapshot_timer(p.snapshot_interval)
{
  if (is_restart)
  {
    const SnapshotReader reader(folder.snapshot(), parameter_text);
    if (reader.stage() == Stage::packing)
    {
      packing.emplace(
          PackingStage{reader.grains(parameters.packing_simulation()), dem::Compression(parameters.compression)});
      reader.read(packing->compression);
    }
    else
    {
      state = reader.loading_state();
      auto grains = parameters.has_grains() ? reader.grains(parameters.simulation) : nullptr;
      specimen = std::make_unique<Specimen>(parameters, std::move(grains), state.box, state.reference_by_id);
      if (specimen->model.body())
        reader.read_body(*specimen->model.body());
    }
  }
  else if (parameters.has_grains())
    packing.emplace(begin_packing(parameters));
  else
  {
    state.box = {Vec3::Zero(), Vec3::Constant(parameters.edge)};
    begin_loading();
  }
}

bool TriaxialRun::run()
{
  folder.open();
  if (!is_restart)
    write_whole_file(folder.parameters(), parameter_text);
  if (packing)
  {
    if (!run_packing())
      return false;
    begin_loading();
  }
  return run_loading();
}

bool TriaxialRun::run_packing()
{
  dem::Simulation &grains = *packing->grains;
  const auto n_particles = static_cast<std::int64_t>(grains.particles.size());
  const double aim = parameters.expected_solid_fraction;
  const auto here = [&]
  {
    // The solid fraction tells how far the compression is until the pressure rises.
    const double fraction = packing_figures(grains).solid_fraction / aim;
    return ProgressState{std::min(0.99, fraction), grains.time, grains.n_steps, n_particles};
  };
  progress.begin_stage("packing", here());
  while (!packing->compression.is_finished())
  {
    packing->compression.step(grains);
    ++steps_here;
    if (grains.n_steps % 200 == 0)
    {
      grains.check_finite();
      progress.update(here());
      const bool stop = interrupted();
      if (stop || snapshot_timer.is_due())
        write_packing(folder.snapshot(), parameter_text, grains, packing->compression);
      if (stop)
        return false;
    }
  }
  progress.end_stage();
  state.packing_steps = grains.n_steps;
  return true;
}

void TriaxialRun::begin_loading()
{
  std::unique_ptr<dem::Simulation> grains;
  if (packing)
  {
    const PackingFigures figures = packing_figures(*packing->grains);
    state.box = figures.box;
    state.solid_fraction = figures.solid_fraction;
    state.coordination_number = figures.coordination_number;
    grains = std::move(packing->grains);
    packing.reset();
    for (dem::PlaneWall &wall : grains->walls)
      wall.velocity.setZero();
    grains->rest();
    grains->change(parameters.loading_simulation());
    state.reference_by_id = places_by_id(*grains);
  }
  specimen = std::make_unique<Specimen>(parameters, std::move(grains), state.box, state.reference_by_id);
  if (dem::Simulation *s = specimen->model.grains())
    s->reset_accounts();
  if (const fe::ExplicitBody *body = specimen->model.body())
  {
    const double limit = fe::stable_step(*body).time_step;
    if (specimen->time_step() > limit)
    {
      std::ostringstream message;
      message << "Loading/time step is " << specimen->time_step() << " s: it must stay below " << limit
              << " s, the stable step of the continuum";
      throw ConfigError(message.str());
    }
  }
}

bool TriaxialRun::run_loading()
{
  History history = state.step > 0
                        ? History::continued(folder.history(), columns, (state.step - 0.5) * specimen->time_step())
                        : History(folder.history(), columns);
  const double dt = specimen->time_step();
  const auto n_steps = static_cast<std::int64_t>(std::ceil(parameters.program.end_time() / dt - 1e-9));
  const std::int64_t sample_interval = std::max<std::int64_t>(1, n_steps / parameters.n_samples);
  const std::int64_t picture_interval =
      parameters.n_pictures > 1 ? std::max<std::int64_t>(1, n_steps / (parameters.n_pictures - 1)) : n_steps;
  const std::int64_t watch_interval = std::max<std::int64_t>(1, n_steps / 10);
  const dem::Simulation *grains = specimen->model.grains();
  const std::int64_t n_particles = grains ? grains->particles.size() : 0;
  const auto here = [&] {
    return ProgressState{static_cast<double>(state.step) / n_steps, state.step * dt, state.step, n_particles};
  };

  progress.begin_stage("loading", here());
  for (;; ++state.step, ++steps_here)
  {
    const bool is_last = state.step >= n_steps;
    if (state.step % 50 == 0)
    {
      progress.update(here());
      const bool stop = interrupted() && !is_last;
      if (stop || snapshot_timer.is_due())
        write_loading(folder.snapshot(), parameter_text, *specimen, state);
      if (stop)
        return false;
    }
    const double time = state.step * dt;
    const Vec3 strain = parameters.program.strain(time);
    specimen->compute(strain, parameters.program.strain(time + dt));
    if (state.step % sample_interval == 0 || is_last)
      sample(time, strain, history);
    if (state.step % watch_interval == 0)
      watch_stable_step();
    if (state.step % picture_interval == 0 || is_last)
      write_picture(time);
    if (is_last)
      break;
    specimen->move();
  }
  progress.end_stage();
  return true;
}

void TriaxialRun::sample(const double time, const Vec3 &strain, History &history)
{
  const dem::Simulation *grains = specimen->model.grains();
  const fe::ExplicitBody *body = specimen->model.body();
  if (grains)
    grains->check_finite();
  if (body && !body->is_finite())
    throw RunError("the run diverged: the continuum is not finite at time " + std::to_string(time) +
                   " s; choose a smaller Loading/time step");

  last_stress = specimen->stress();
  last_energy = specimen->energy();
  if (state.step == 0)
    state.first_balance = last_energy.balance();
  const double residual = last_energy.balance() - state.first_balance;
  state.largest_residual = std::max(state.largest_residual, std::abs(residual));
  largest_work = std::max(largest_work, std::abs(last_energy.wall_work));
  const double overlap = grains ? max_overlap_over_radius(*grains) : 0.;
  largest_overlap = std::max(largest_overlap, overlap);
  largest_difference = specimen->model.penalty_state().largest_difference;
  if (overlap > 0.2)
    throw RunError("the run diverged: grains overlap by " + std::to_string(overlap) + " of their radius at time " +
                   std::to_string(time) + " s; choose a smaller Loading/time step or smaller strains");

  const SpecimenEnergy &e = last_energy;
  const double coordination = grains ? coordination_number(*grains) : 0.;
  const double row[] = {time,
                        static_cast<double>(parameters.program.stage(time)),
                        strain[0],
                        strain[1],
                        strain[2],
                        last_stress[0],
                        last_stress[1],
                        last_stress[2],
                        e.kinetic,
                        e.grains_elastic,
                        e.continuum_elastic,
                        e.coupling,
                        e.friction_loss,
                        e.viscous_loss,
                        e.plastic_loss,
                        e.wall_work,
                        e.gravity_work,
                        e.curvature_work,
                        residual,
                        coordination,
                        overlap,
                        largest_difference};
  history.append(row);
}

void TriaxialRun::write_picture(const double time)
{
  const std::size_t number = state.picture_times.size();
  state.picture_times.push_back(time);
  std::vector<std::pair<double, std::string>> grain_frames, continuum_frames;
  for (std::size_t k = 0; k <= number; ++k)
  {
    grain_frames.emplace_back(state.picture_times[k], picture_name("grains", k));
    continuum_frames.emplace_back(state.picture_times[k], picture_name("continuum", k));
  }
  if (const dem::Simulation *grains = specimen->model.grains())
  {
    std::vector<double> force;
    for (const Vec3 &f : grains->particles.force)
      force.push_back(f.norm());
    const dem::GrainField fields[] = {{"weight", grains->particles.weight}, {"resultant_force", force}};
    dem::write_grains_vtu(grains->particles, fields, folder.file(picture_name("grains", number)));
    write_pvd(folder.file("grains.pvd"), grain_frames);
  }
  if (const fe::ExplicitBody *body = specimen->model.body())
  {
    fe::write_vtu(*body, folder.file(picture_name("continuum", number)));
    write_pvd(folder.file("continuum.pvd"), continuum_frames);
  }
}

void TriaxialRun::watch_stable_step()
{
  const double stable = specimen->model.stable_steps().combined();
  state.smallest_stable_step = state.smallest_stable_step > 0. ? std::min(state.smallest_stable_step, stable) : stable;
  if (specimen->time_step() <= stable || has_warned)
    return;
  std::ostringstream message;
  message << "warning: Loading/time step is " << specimen->time_step() << " s, the stable step is now estimated at "
          << stable << " s";
  progress.message(message.str());
  has_warned = true;
}

Summary TriaxialRun::summary() const
{
  const dem::Simulation *grains = specimen->model.grains();
  const double wall_time = std::chrono::duration<double>(Clock::now() - start).count();
  const std::int64_t n_particles = grains ? grains->particles.size() : 0;

  Summary summary;
  summary.set("model", std::string(name_of(parameters.kind)));
  RunFigures figures;
  figures.wall_time_s = wall_time;
  figures.steps = state.packing_steps + state.step;
  figures.particles = n_particles;
  figures.threads = omp_get_max_threads();
  figures.particle_steps_per_second = n_particles * steps_here / wall_time;
  figures.time_step_s = specimen->time_step();
  figures.stable_time_step_s = state.smallest_stable_step;
  figures.energy_residual = largest_work > 0. ? state.largest_residual / largest_work : 0.;
  figures.undecided_contacts = grains ? grains->contacts.n_undecided() : 0;
  figures.max_overlap_over_radius = largest_overlap;
  summary.set(figures);
  if (grains)
  {
    summary.set("packing_solid_fraction", state.solid_fraction);
    summary.set("packing_coordination_number", state.coordination_number);
  }
  const Vec3 edges = specimen->reference_edges();
  summary.set("cube_edges_m", std::vector<double>{edges[0], edges[1], edges[2]}, "m");
  for (int d = 0; d < 3; ++d)
    summary.set("stress_" + std::to_string(d + 1) + "_Pa", last_stress[d], "Pa");
  summary.set("coupling_difference_m", largest_difference, "m");
  return summary;
}

} // namespace bergamo::driver
