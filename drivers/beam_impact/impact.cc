#include "drivers/beam_impact/impact.h"

#include "coupling/adapter/surface_contact.h"
#include "drivers/common/run/visit_models.h"
#include "fe_dealii/boundary/face_triangles.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <cmath>

namespace bergamo::driver
{
namespace
{

enum Boundary : unsigned int
{
  left,
  right,
  front,
  back,
  bottom,
  top
};

std::unique_ptr<fe::ExplicitBody> make_beam(const ImpactParameters &p)
{
  const double x = 0.5 * p.length, y = 0.5 * p.edge;
  fe::ExplicitBodyParameters body;
  body.material = fe::LinearElastic(p.material);
  body.degree = p.element == BeamElement::quadratic ? 2 : 1;
  body.kind.hourglass = p.element == BeamElement::bending ? fe::Hourglass::bending : fe::Hourglass::at_points;
  auto beam = std::make_unique<fe::ExplicitBody>(
      fe::make_box_body({{-x, -y, -y}, {x, y, y}, {p.n_along, p.n_across, p.n_across}}, body));
  for (const Boundary end : {left, right})
    beam->prescribe_velocity(end, 2);
  return beam;
}

std::vector<unsigned int> nodes_in_the_middle(const fe::ExplicitBody &beam, const double length)
{
  std::vector<unsigned int> nodes;
  for (unsigned int node = 0; node < beam.n_nodes(); ++node)
    if (std::abs(beam.node_position()[node][0]) < 1e-9 * length)
      nodes.push_back(node);
  return nodes;
}

} // namespace

Impact::Impact(const ImpactParameters &p) : parameters(p)
{
  step = p.step_share * fe::stable_step(*make_beam(p)).time_step;
  set_up(sphere_at_start());
}

dem::SimulationParameters Impact::simulation_parameters() const
{
  dem::SimulationParameters p;
  p.grain() = {parameters.material.young_modulus, parameters.material.poisson_ratio, parameters.material.density};
  p.wall() = p.grain();
  p.with_walls().friction = 0.;
  p.set_damping(0.);
  p.time_step = step;
  return p;
}

std::unique_ptr<dem::Simulation> Impact::sphere_at_start() const
{
  dem::Particles sphere;
  sphere.add({Vec3::Constant(parameters.radius), 1., 1.}, parameters.material.density,
             Vec3(0., 0., 0.5 * parameters.edge + parameters.radius), Quaternion::Identity());
  sphere.velocity[0] = Vec3(0., 0., -parameters.velocity);
  return std::make_unique<dem::Simulation>(simulation_parameters(), std::move(sphere), std::vector<dem::PlaneWall>());
}

/// @param sphere at its start, or as it was stored, with the beam's surface
void Impact::set_up(std::unique_ptr<dem::Simulation> sphere)
{
  constexpr unsigned int n_squares = 2; // nodes are corners, and a corner lies under the sphere
  model = std::make_unique<coupling::Model>();
  grains = &model->add(std::make_unique<coupling::GrainsMover>(std::move(sphere), "sphere"));
  beam = &model->add(std::make_unique<coupling::SolidMover>(make_beam(parameters), "beam"));
  const fe::Surface upper = fe::boundary_surface(body().dof_handler(), top);
  const fe::FaceTriangles faces = fe::divide_faces({&upper, 1}, n_squares);
  if (simulation().surfaces.empty())
    grains->simulation().add_surface(coupling::surface_of(body(), faces));
  model->add(std::make_unique<coupling::SurfaceContact>(*grains, *beam, faces, 0));
  section = nodes_in_the_middle(body(), parameters.length);
}

void Impact::compute()
{
  model->compute_forces();
  model->kick(step);
}

void Impact::move()
{
  model->drift(step);
}

void Impact::look()
{
  looked.sphere.push_back(sphere_displacement());
  looked.beam.push_back(beam_displacement());
  looked.force.push_back(force());
}

double Impact::sphere_displacement() const
{
  return 0.5 * parameters.edge + parameters.radius - simulation().particles.position[0][2];
}

/// Mean over the section, by the inertia of its nodes.
double Impact::beam_displacement() const
{
  double sum = 0., mass = 0.;
  for (const unsigned int node : section)
  {
    const double part = body().mass()[3 * std::size_t(node)];
    sum -= part * body().displacement()[3 * std::size_t(node) + 2];
    mass += part;
  }
  return sum / mass;
}

double Impact::force() const
{
  return simulation().particles.force[0][2];
}

void Impact::visit(StateVisitor &visit)
{
  visit("way/sphere", looked.sphere);
  visit("way/beam", looked.beam);
  visit("way/force", looked.force);
  if (auto read = visit_grains(visit, &simulation(), simulation_parameters()))
    set_up(std::move(read));
  visit_body(visit, beam->solid());
}

} // namespace bergamo::driver
