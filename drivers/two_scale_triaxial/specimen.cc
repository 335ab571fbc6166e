#include "drivers/two_scale_triaxial/specimen.h"

#include "dem/core/error.h"
#include "dem/measure/contact_list.h"
#include "dem/measure/coordination.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/two_scale_triaxial/contact_forces.h"
#include "drivers/two_scale_triaxial/continuum_body.h"
#include "fe_dealii/stable_step.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace bergamo::driver
{
namespace
{

/// @param limit stable step of the continuum [s]; @param state the body is in
void require_below(const double limit, const TriaxialParameters &parameters, const std::string &state)
{
  const double step = parameters.simulation.time_step;
  if (step * parameters.cycle() <= limit)
    return;
  if (step <= limit)
    reject("Continuum/steps per force is ", parameters.steps_per_force, ": at a Loading/time step of ", step,
           " s it must stay below ", limit / step, ", for the stable step of the continuum is ", limit, " s", state);
  reject("Loading/time step is ", step, " s: it must stay below ", limit, " s, the stable step of the continuum",
         state);
}

} // namespace

void require_stable_continuum(const TriaxialParameters &parameters)
{
  if (!parameters.has_continuum())
    return;
  constexpr double densest = 0.74; // solid fraction; the cube shrinks until the grains bear the pressure
  const double shrinkage = parameters.has_grains() ? std::min(1., parameters.expected_solid_fraction / densest) : 1.;
  LoadingStart least;
  least.box = {Vec3::Zero(), parameters.edges() * std::cbrt(shrinkage)};
  require_below(fe::stable_step(*make_continuum(parameters, least)).time_step, parameters,
                parameters.has_grains() ? " if the grains pack as densely as they can" : "");
}

Specimen::Specimen(const TriaxialParameters &p, std::unique_ptr<dem::Simulation> grains, const LoadingStart &start)
    : model(std::move(grains), make_continuum(p, start), p.simulation.time_step), parameters(p), cube(start.box),
      edges(cube.edges()), step(p.simulation.time_step)
{
  const bool is_joined = parameters.kind == ModelKind::two_scale;
  boundary = parameters.is_periodic() ? in_periodic_cell(model, edges) : between_walls(model, is_joined);
  if (is_joined)
    join(start.reference_by_id);
  if (!model.body())
    return;
  body_steps.emplace(*model.body());
  require_below(body_steps->stable().time_step, parameters, " on the packed cube");
  model.continuum()->compute_every({parameters.cycle(), parameters.coupling.transfer_time}, step);
}

void Specimen::join(const std::vector<Vec3> &reference_by_id)
{
  const Layout layout = parameters.layout(cube);
  std::vector<double> weight;
  for (const auto &x : model.body()->node_position())
    weight.push_back(weight_at(layout, {x[0], x[1], x[2]}, parameters.weight));
  model.join(parameters.coupling, weight, reference_by_id);
}

void Specimen::compute(const Vec3 &strain_now, const Vec3 &strain_next)
{
  strain = strain_now;
  model.compute_forces();
  if (body_steps)
    body_steps->require_stable(step * parameters.cycle());
  boundary->move(edges.cwiseProduct(strain_next - strain_now) / step);
  model.kick();
}

SpecimenSample Specimen::measure(const double time) const
{
  const dem::Simulation *grains = model.grains();
  if (grains)
    grains->check_finite();
  if (model.body())
    fe::require_bounded(model.body()->energy(), "the continuum at time " + std::to_string(time) + " s",
                        "a smaller Loading/time step");
  SpecimenSample sample{
      .time = time, .stage = parameters.program.stage(time), .strain = strain, .energy = coupling::energy_of(model)};
  sample.coupling_difference = model.penalty_state().largest_difference;
  const Vec3 present_edges = edges.cwiseProduct(Vec3::Ones() + strain);
  sample.profile = coupling::stress_profile(model, {cube.low, cube.low + present_edges}, parameters.layers.high());
  sample.stress = boundary->stress(present_edges, sample);
  if (!grains)
    return sample;
  sample.coordination_number = dem::mean_coordination(grains->contacts, grains->particles.size());
  sample.largest_overlap = dem::largest_relative_overlap(grains->contacts, grains->particles);
  dem::check_overlap(sample.largest_overlap, time, "a smaller Loading/time step or smaller strains");
  return sample;
}

void Specimen::look_at_rotation(Progress &progress)
{
  if (model.body())
    rotation.look(*model.body(), progress);
}

void Specimen::add_figures(Summary &summary) const
{
  summary.set("cube_edges_m", std::vector<double>{edges[0], edges[1], edges[2]}, "m");
  if (model.body())
    summary.set("greatest_rotation_degrees", rotation.greatest(), "degrees");
}

void Specimen::write_tables(const std::filesystem::path &folder, const std::vector<coupling::SlabStress> &profile) const
{
  write_profile(folder / "stress_profile.csv", profile);
  if (model.grains())
    write_contact_forces(folder / "contact_forces.csv", *model.grains(), parameters.layout(cube));
}

void visit_loading(StateVisitor &visit, std::unique_ptr<Specimen> &specimen, LoadingStart &start,
                   const TriaxialParameters &parameters)
{
  visit("loading/box_low", start.box.low);
  visit("loading/box_high", start.box.high);
  if (specimen && specimen->model.overlap() && !visit.is_reading())
    start.reference_by_id = specimen->model.overlap()->reference_by_id();
  visit("loading/reference", start.reference_by_id);
  visit("loading/stress_by_layer", start.stress_by_layer);
  visit("loading/solid_fraction", start.solid_fraction);
  visit("loading/coordination_number", start.coordination_number);
  std::unique_ptr<dem::Simulation> grains;
  if (parameters.has_grains())
    grains = visit_grains(visit, specimen ? specimen->model.grains() : nullptr, parameters.simulation);
  if (visit.is_reading())
    specimen = std::make_unique<Specimen>(parameters, std::move(grains), start);
  if (specimen->model.body())
    visit_body(visit, *specimen->model.body());
  if (specimen->model.overlap())
  {
    visit("overlap", *specimen->model.overlap());
    visit("continuum_cycle", *specimen->model.continuum());
  }
  if (specimen->body_steps)
    visit_steps(visit, *specimen->body_steps);
  specimen->rotation.visit(visit);
}

} // namespace bergamo::driver
