#include "drivers/strip_footing/footing_model.h"

#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/mesh/material_box.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace bergamo::driver
{
namespace
{

enum Boundary : unsigned int
{
  axis,
  far_side,
  front,
  back,
  bottom,
  surface,
  footing
};

} // namespace

fe::ExplicitBody make_ground(const FootingParameters &p)
{
  const double size = p.element_size();
  fe::BoxMeshParameters box;
  box.subdivisions = {static_cast<unsigned int>(p.elements_along(p.ground_width)), 1,
                      static_cast<unsigned int>(p.elements_along(p.ground_depth))};
  box.minimum = {0, 0, -size * box.subdivisions[2]};
  box.maximum = {size * box.subdivisions[0], size, 0};
  dealii::Triangulation<3> mesh;
  fe::make_box(box, mesh);
  constexpr double everywhere = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < p.layer_depths.size(); ++k) // each takes what is below it from the one before
    fe::set_material({{-everywhere, -everywhere, -everywhere},
                      {everywhere, everywhere, p.layer_top(k)},
                      static_cast<unsigned int>(k + 1)},
                     mesh);
  for (const auto &cell : mesh.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() == surface && face->center()[0] < p.elements_across * size)
        face->set_boundary_id(footing);

  fe::ExplicitBodyParameters body;
  body.layers = {{0u, p.continuum.material()}};
  for (std::size_t k = 0; k < p.layer_depths.size(); ++k)
    body.layers.insert({static_cast<unsigned int>(k + 1), p.deeper[k].material()});
  body.degree = p.degree;
  body.kind.hourglass = p.bending_elements ? fe::Hourglass::bending : fe::Hourglass::at_points;
  body.kind.kinematics = p.large_strain ? fe::Kinematics::large_strain : fe::Kinematics::small_strain;
  body.gravity = {0, 0, -p.gravity};
  body.damping = p.damping;
  fe::GeostaticStress ground{.surface_height = 0,
                             .unit_weight = p.continuum.density() * p.gravity,
                             .earth_pressure_at_rest = p.earth_pressure_at_rest,
                             .surcharge = p.surcharge};
  for (std::size_t k = 0; k < p.layer_depths.size(); ++k)
    ground.deeper.push_back({p.layer_top(k), p.deeper[k].density() * p.gravity});
  if (p.gravity > 0 || p.surcharge > 0)
    body.initial_stress = fe::geostatic_stress(ground);
  return fe::ExplicitBody(mesh, body);
}

namespace
{

/// Downwards; from rest to a steady speed, and the settlement at the end.
fe::TimeFunction velocity_of(const FootingParameters &p)
{
  std::ostringstream text;
  text.precision(17);
  text << -p.speed() << "*min(t/" << p.ramp_time() << ", 1)";
  return fe::TimeFunction(text.str());
}

fe::BoundaryCondition motion(const unsigned int boundary, const unsigned int component, fe::TimeFunction velocity = 0.)
{
  return {boundary, fe::ConditionKind::velocity, component, std::move(velocity)};
}

} // namespace

FootingModel::FootingModel(const FootingParameters &p)
    : area(0.5 * p.width * p.element_size()), ground(std::make_unique<fe::ExplicitBody>(make_ground(p))),
      share(p.step_share)
{
  std::vector<fe::BoundaryCondition> list;
  list.push_back(motion(footing, 2, velocity_of(p)));
  if (p.rough)
    list.push_back(motion(footing, 0));
  for (const auto &[boundary, component] : {std::pair(axis, 0u), std::pair(front, 1u), std::pair(back, 1u)})
    list.push_back(motion(boundary, component));
  if (p.far_boundaries == FarBoundaries::held)
    for (const auto &[boundary, component] : {std::pair(far_side, 0u), std::pair(bottom, 0u), std::pair(bottom, 2u)})
      list.push_back(motion(boundary, component));
  else
    for (const unsigned int boundary : {unsigned(far_side), unsigned(bottom)})
      list.push_back({boundary, fe::ConditionKind::quiet, 0, 0.});
  conditions = std::make_unique<fe::BoundaryConditions>(*ground, std::move(list));
  footing_nodes = ground->boundary_nodes(footing);

  if (p.surcharge > 0)
    for (const unsigned int boundary : {unsigned(surface), unsigned(footing)})
      fe::SurfaceLoad(fe::boundary_surface(ground->dof_handler(), boundary), ground->node_position())
          .add_traction({0, 0, -p.surcharge}, ground->external_force());
  start_report = fe::find_equilibrium(*ground);
  control = std::make_unique<fe::StepControl>(*ground);
}

void FootingModel::compute_forces()
{
  ground->compute_internal_force();
  dt = control->next(share);
  conditions->apply(time(), dt);
}

double FootingModel::footing_pressure() const
{
  double force = 0; // of the footing on the ground: the reaction and its part of the surcharge
  for (const unsigned int node : footing_nodes)
    force += ground->reaction_force()[3 * std::size_t(node) + 2] + ground->external_force()[3 * std::size_t(node) + 2];
  return -force / area;
}

} // namespace bergamo::driver
