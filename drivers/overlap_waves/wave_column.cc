#include "drivers/overlap_waves/wave_column.h"

#include "dem/core/error.h"
#include "drivers/common/run/visit_models.h"
#include "fe_dealii/conditions/quiet_boundary.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <cmath>
#include <numeric>

namespace bergamo::driver
{
namespace
{

enum Boundary : unsigned int
{
  below = 4
};

double bottom_of_grains(const WaveParameters &p)
{
  return p.kind == ColumnKind::grains ? 0. : p.part_layers() * p.element_height();
}

std::size_t n_grain_layers(const WaveParameters &p)
{
  return std::size_t(p.element_size) *
         (p.kind == ColumnKind::grains ? p.all_layers() : p.all_layers() - p.part_layers());
}

/// Where the grains are at rest, by id: from layer to layer.
std::vector<Vec3> lattice_points(const WaveParameters &p, const double spacing)
{
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < n_grain_layers(p); ++k)
    for (unsigned int j = 0; j < p.width; ++j)
      for (unsigned int i = 0; i < p.width; ++i)
        points.emplace_back((i + 0.5) * spacing, (j + 0.5) * spacing, bottom_of_grains(p) + (k + 0.5) * spacing);
  return points;
}

std::unique_ptr<dem::Simulation> make_grains(const WaveParameters &p, const CubicLattice &lattice)
{
  dem::Particles grains;
  for (const Vec3 &x : lattice_points(p, lattice.spacing))
    grains.add({Vec3::Constant(p.radius), 1., 1.}, p.simulation.grain().density, x, Quaternion::Identity());
  const double gap = 10. * p.radius; // between the column and its image above, which it never meets
  const double width = p.width * lattice.spacing;
  grains.cell = dem::PeriodicCell(Vec3(width, width, p.all_layers() * p.element_height() + gap));
  return std::make_unique<dem::Simulation>(p.simulation, std::move(grains), std::vector<dem::PlaneWall>());
}

std::unique_ptr<fe::ExplicitBody> make_body(const WaveParameters &p, const CubicLattice &lattice)
{
  if (p.kind == ColumnKind::grains)
    return nullptr;
  const double width = p.width * lattice.spacing;
  fe::ExplicitBodyParameters body;
  body.material = fe::LinearElastic(lattice.continuum());
  // A shear moves the sides, which nothing presses: held along z, and of a linear law, the body then does without.
  if (p.wave == Wave::compression)
    body.initial_stress = fe::uniform_pressure(p.pressure);
  return std::make_unique<fe::ExplicitBody>(fe::make_box_body(
      {{0., 0., 0.}, {width, width, p.continuum_layers() * p.element_height()}, {1, 1, p.continuum_layers()}}, body));
}

} // namespace

WaveColumn::WaveColumn(const WaveParameters &p, std::unique_ptr<dem::Simulation> grains)
    : model(grains ? std::move(grains) : make_grains(p, p.lattice()), make_body(p, p.lattice()),
            p.simulation.time_step),
      parameters(p), lattice(p.lattice()), pulse(p.pulse()), direction(p.wave == Wave::compression ? 2 : 0),
      overlap_bottom(p.part_layers() * p.element_height()), overlap_top(p.continuum_layers() * p.element_height())
{
  const std::int64_t n_layer = p.width * p.width, n = n_layer * n_grain_layers(p);
  std::vector<std::int64_t> low(n_layer), high(n_layer);
  std::iota(low.begin(), low.end(), 0);
  std::iota(high.begin(), high.end(), n - n_layer);
  free_ends = high;
  if (p.kind == ColumnKind::grains)
    free_ends.insert(free_ends.end(), low.begin(), low.end());
  if (p.source == PulseSource::grains)
    source_grains = high;
  else if (p.kind == ColumnKind::grains)
    source_grains = low;
  if (model.body())
    join();
  std::vector<Vec3> &external = model.grains()->particles.external_force;
  if (external.empty())
    external.assign(n, Vec3::Zero());
  if (model.grains()->n_steps == 0)
    begin();
}

void WaveColumn::join()
{
  fe::ExplicitBody &body = *model.body();
  std::vector<unsigned int> all(body.n_nodes());
  std::iota(all.begin(), all.end(), 0u);
  for (unsigned int d = 0; d < 3; ++d)
    if (static_cast<int>(d) != direction)
      body.prescribe_velocity(all, d);
  body.add_dashpots(fe::quiet_boundary(body, below));
  if (parameters.source == PulseSource::continuum)
    source_nodes = body.boundary_nodes(below);
  std::vector<double> weight;
  for (const auto &x : body.node_position())
    weight.push_back(coupling::weight_at(parameters.weight, (x[2] - overlap_bottom) / (overlap_top - overlap_bottom)));
  model.join(parameters.coupling, weight, lattice_points(parameters, lattice.spacing));
}

/// Brings both models to rest under the pressure.
void WaveColumn::begin()
{
  if (fe::ExplicitBody *body = model.body())
  {
    body->compute_internal_force();
    body->rest();
  }
  model.compute_forces();
  const dem::Simulation &grains = *model.grains();
  for (const std::int64_t id : free_ends)
    dead_load.push_back(-grains.particles.force[grains.index_of(id)]);
  if (parameters.simulation.time_step > stable_step())
    reject("Output/time step is ", parameters.simulation.time_step, " s: it must stay below ", stable_step(),
           " s, the stable step of the column");
}

/// What sends the pulse, inwards, over the whole end [N]. A quiet boundary bears as much as the wave that it lets in.
double WaveColumn::end_force(const double time) const
{
  const double width = parameters.width * lattice.spacing;
  const double share = source_nodes.empty() ? 1. : 2.;
  const double inwards = parameters.source == PulseSource::grains && direction == 2 ? -1. : 1.;
  return inwards * share * width * width * pulse.stress(time);
}

void WaveColumn::compute()
{
  model.compute_forces();
  dem::Simulation &grains = *model.grains();
  std::vector<Vec3> &external = grains.particles.external_force;
  for (std::size_t k = 0; k < free_ends.size(); ++k)
    external[grains.index_of(free_ends[k])] += dead_load[k];
  const double force = end_force(time());
  for (const std::int64_t id : source_grains)
    external[grains.index_of(id)][direction] += force / source_grains.size();
  for (const unsigned int node : source_nodes)
    model.body()->external_force()[3 * node + direction] += force / source_nodes.size();
  model.kick();
}

void WaveColumn::move()
{
  const double before = time(), dt = parameters.simulation.time_step;
  model.drift();
  const dem::Simulation &grains = *model.grains();
  const std::vector<Vec3> &velocity = grains.particles.drift_velocity;
  double way = 0.; // of the source, on the mean [m]
  for (const std::int64_t id : source_grains)
    way += dt * velocity[grains.index_of(id)][direction] / source_grains.size();
  for (const unsigned int node : source_nodes)
    way += dt * std::as_const(*model.body()).velocity()[3 * node + direction] / source_nodes.size();
  work_of_pulse += 0.5 * (end_force(before) + end_force(time())) * way;
  for (std::size_t k = 0; k < free_ends.size(); ++k)
    work_of_pressure += dt * dead_load[k].dot(velocity[grains.index_of(free_ends[k])]);
}

ColumnPart WaveColumn::part_at(const double z) const
{
  const double nearly = 1e-6 * lattice.spacing;
  return z <= overlap_bottom + nearly ? continuum_part : z < overlap_top + nearly ? overlap_part : grain_part;
}

std::array<double, 3> WaveColumn::kinetic_energy() const
{
  std::array<double, 3> sum{};
  const dem::Particles &p = model.grains()->particles;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const double z = bottom_of_grains(parameters) + (layer_of(p.id[i]) + 0.5) * lattice.spacing;
    sum[part_at(z)] +=
        0.5 * p.weight[i] *
        (p.mass[i] * p.velocity[i].squaredNorm() + p.inertia[i][0] * p.angular_velocity[i].squaredNorm());
  }
  if (const fe::ExplicitBody *body = model.body())
    for (std::size_t dof = 0; dof < body->mass().size(); ++dof)
      sum[part_at(body->node_position()[dof / 3][2])] +=
          0.5 * body->mass()[dof] * body->velocity()[dof] * body->velocity()[dof];
  return sum;
}

std::vector<WaveColumn::Layer> WaveColumn::layers() const
{
  const dem::Particles &p = model.grains()->particles;
  const double bottom = bottom_of_grains(parameters), share = 1. / (parameters.width * parameters.width);
  std::vector<Layer> layers;
  for (std::size_t k = 0; k < n_grain_layers(parameters); ++k)
    layers.push_back({0., bottom + (k + 0.5) * lattice.spacing, 0.});
  for (std::size_t i = 0; i < p.size(); ++i)
    layers[layer_of(p.id[i])].velocity += share * p.velocity[i][direction];
  if (const fe::ExplicitBody *body = model.body())
    for (std::size_t node = 0; node < body->n_nodes(); ++node)
      if (const auto &x = body->node_position()[node]; x[0] == 0. && x[1] == 0.)
        layers.push_back({1., x[2], body->velocity()[3 * node + direction]});
  return layers;
}

void WaveColumn::visit(StateVisitor &visit)
{
  if (model.body())
  {
    visit_body(visit, *model.body());
    visit("overlap", *model.overlap());
  }
  visit("dead_load", dead_load);
  visit("work_of_pulse", work_of_pulse);
  visit("work_of_pressure", work_of_pressure);
}

} // namespace bergamo::driver
