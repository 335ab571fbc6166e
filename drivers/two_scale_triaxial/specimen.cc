#include "drivers/two_scale_triaxial/specimen.h"

#include "fe_dealii/mesh/box_mesh.h"

#include <deal.II/grid/tria.h>

#include <algorithm>

namespace bergamo::driver
{
namespace
{

/// The continuum's part of the cube: it starts under the packing's pressure, so that the overlap starts in equilibrium.
std::unique_ptr<fe::ExplicitBody> make_body(const TriaxialParameters &parameters, const dem::Box &cube)
{
  if (!parameters.has_continuum())
    return nullptr;
  const unsigned int n = parameters.elements_per_edge;
  const unsigned int n_layers = parameters.kind == ModelKind::continuum ? n : parameters.continuum_layers;
  fe::BoxMeshParameters mesh_parameters;
  for (int d = 0; d < 3; ++d)
  {
    mesh_parameters.minimum[d] = cube.low[d];
    mesh_parameters.maximum[d] = cube.high[d];
  }
  mesh_parameters.maximum[2] = cube.low[2] + cube.edges()[2] * n_layers / n;
  mesh_parameters.subdivisions = {n, n, n_layers};
  dealii::Triangulation<3> mesh;
  fe::make_box(mesh_parameters, mesh);

  fe::ExplicitBodyParameters body;
  body.material = fe::MohrCoulomb(parameters.continuum);
  body.damping = parameters.continuum_damping;
  body.initial_stress = fe::uniform_pressure(parameters.compression.pressure);
  return std::make_unique<fe::ExplicitBody>(mesh, body);
}

/// The grains' box, extended downwards by the layers that are continuum alone.
dem::Box whole_cube(const TriaxialParameters &parameters, dem::Box box)
{
  const double layer = box.edges()[2] / parameters.grain_layers();
  if (parameters.kind == ModelKind::two_scale)
    box.low[2] = box.high[2] - parameters.elements_per_edge * layer;
  return box;
}

} // namespace

Specimen::Specimen(const TriaxialParameters &parameters, std::unique_ptr<dem::Simulation> grains, const dem::Box &box,
                   const std::vector<Vec3> &reference_by_id)
    : model(std::move(grains), make_body(parameters, whole_cube(parameters, box)), parameters.simulation.time_step),
      cube(whole_cube(parameters, box)), edges(cube.edges()), current_edges(edges),
      step(parameters.simulation.time_step)
{
  const bool is_joined = parameters.kind == ModelKind::two_scale;
  if (fe::ExplicitBody *body = model.body())
  {
    for (unsigned int face = 0; face < (is_joined ? 5u : 6u); ++face)
      faces[face].constraint = body->prescribe_velocity(face, face / 2);
  }
  if (is_joined)
    join(parameters, reference_by_id, edges[2] / parameters.elements_per_edge);
  if (const dem::Simulation *s = model.grains())
  {
    // Joined, the grains' floor is gone and the wall above has moved up in the list.
    const bool has_floor = s->walls.size() == 6;
    for (std::size_t face = 0; face < 4; ++face)
      faces[face].wall = face;
    if (has_floor)
      faces[4].wall = 4;
    faces[5].wall = has_floor ? 5 : 4;
  }
}

void Specimen::join(const TriaxialParameters &parameters, const std::vector<Vec3> &reference_by_id, const double layer)
{
  // A restarted run finds its floor removed already.
  if (model.grains()->walls.size() == 6)
    model.grains()->remove_wall(4);
  const double top = cube.low[2] + parameters.continuum_layers * layer;
  const double bottom = top - parameters.overlap_layers * layer;
  std::vector<double> weight;
  for (const auto &x : model.body()->node_position())
    weight.push_back(std::clamp((x[2] - bottom) / (top - bottom), 0., 1.));
  model.join(parameters.coupling, weight, reference_by_id);
}

void Specimen::compute(const Vec3 &strain_now, const Vec3 &strain_next)
{
  current_edges = edges.cwiseProduct(Vec3::Ones() + strain_now);
  model.compute_forces();
  for (int d = 0; d < 3; ++d)
  {
    const double velocity = edges[d] * (strain_next[d] - strain_now[d]) / step;
    const Face &face = faces[2 * d + 1];
    if (face.wall)
      model.grains()->walls[*face.wall].velocity = velocity * Vec3::Unit(d);
    if (face.constraint)
      model.body()->set_velocity(*face.constraint, velocity);
  }
  model.kick();
}

Vec3 Specimen::stress() const
{
  Vec3 stress = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
  {
    const double area = current_edges.prod() / current_edges[d];
    int n_faces = 0;
    for (int side = 0; side < 2; ++side)
    {
      const Face &face = faces[2 * d + side];
      if (!face.wall && !face.constraint)
        continue;
      double pull = 0.; // force of the surroundings on the specimen, outwards
      const double outwards = side == 0 ? -1. : 1.;
      if (face.wall)
        pull -= outwards * model.grains()->walls[*face.wall].force[d];
      if (face.constraint)
        pull += outwards * model.body()->reaction(*face.constraint);
      stress[d] += pull / area;
      ++n_faces;
    }
    stress[d] /= n_faces;
  }
  return stress;
}

SpecimenEnergy Specimen::energy() const
{
  SpecimenEnergy e;
  if (const dem::Simulation *grains = model.grains())
  {
    const dem::GrainEnergy g = grains->energy();
    e.kinetic += g.kinetic;
    e.grains_elastic = g.normal + g.tangential;
    e.friction_loss = g.friction_loss;
    e.viscous_loss += g.viscous_loss;
    e.wall_work += g.wall_work;
    e.gravity_work += g.gravity_work;
    e.curvature_work = g.curvature_work;
  }
  if (const fe::ExplicitBody *body = model.body())
  {
    const fe::BodyEnergy b = body->energy();
    e.kinetic += b.kinetic;
    e.continuum_elastic = b.elastic;
    e.plastic_loss = b.plastic_dissipation;
    e.viscous_loss += b.viscous_dissipation;
    e.wall_work += b.boundary_work;
    e.gravity_work += b.gravity_work;
  }
  e.coupling = model.penalty_state().energy;
  return e;
}

} // namespace bergamo::driver
