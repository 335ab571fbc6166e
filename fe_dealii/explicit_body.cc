#include "fe_dealii/explicit_body.h"

#include "dem/core/error.h"
#include "fe_dealii/boundary/surface.h"
#include "fe_dealii/element/cell_nodes.h"
#include "fe_dealii/element/solid_elements.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace bergamo::fe
{
void ExplicitBodyParameters::validate() const
{
  if (degree != 1 && degree != 2)
    reject("continuum: degree = ", degree, " of the elements is not allowed; choose 1 (8 nodes) or 2 (27 nodes)");
  if (degree != 1 && hourglass == Hourglass::bending)
    reject("continuum: degree = ", degree,
           " of the elements is not allowed with hourglass modes that bend, which only "
           "those of 8 nodes have; choose degree 1, or leave the modes: 27 nodes bend anyway");
  MassForces{gravity, damping}.validate("continuum");
  if (!(wanted_time_step >= 0) || !std::isfinite(wanted_time_step))
    reject("continuum: wanted_time_step = ", wanted_time_step,
           " s is not allowed; give a positive time, or zero for no mass scaling");
}

struct ExplicitBody::Mesh
{
  Mesh(const dealii::Triangulation<3, 3> &mesh, const unsigned int degree)
      : element(dealii::FE_Q<3>(degree), 3), dof_handler(triangulation)
  {
    if (mesh.n_active_cells() == 0)
      reject("continuum: the mesh has no cells; fill the triangulation first");
    if (!mesh.all_reference_cells_are_hyper_cube())
      reject("continuum: the mesh has cells that are no hexahedra; only hexahedra are supported");
    if (mesh.has_hanging_nodes())
      reject("continuum: the mesh has hanging nodes; refine it uniformly");
    triangulation.copy_triangulation(mesh);
    dof_handler.distribute_dofs(element);
  }

  dealii::Triangulation<3> triangulation;
  dealii::FESystem<3> element;
  dealii::DoFHandler<3> dof_handler;
};

ExplicitBody::ExplicitBody(const dealii::Triangulation<3, 3> &mesh, const ExplicitBodyParameters &parameters)
    : ExplicitBody(std::make_unique<Mesh>(mesh, (parameters.validate(), parameters.degree)), parameters)
{
}

ExplicitBody::ExplicitBody(std::unique_ptr<Mesh> mesh, const ExplicitBodyParameters &p)
    : MovingBody("continuum", node_positions(mesh->dof_handler),
                 make_solid_elements(mesh->dof_handler, p.material, p.initial_stress, p.hourglass),
                 {p.gravity, p.damping}, p.wanted_time_step),
      mesh_(std::move(mesh)), material_(p.material)
{
}

ExplicitBody::ExplicitBody(ExplicitBody &&) noexcept = default;
ExplicitBody::~ExplicitBody() = default;

const dealii::DoFHandler<3, 3> &ExplicitBody::dof_handler() const
{
  return mesh_->dof_handler;
}

void ExplicitBody::set_share(const std::span<const double> nodal_weight)
{
  if (nodal_weight.size() != n_nodes())
    reject("continuum: ", nodal_weight.size(), " nodal weights given for ", n_nodes(), " nodes; give one per node");
  for (std::size_t node = 0; node < n_nodes(); ++node)
    if (!(nodal_weight[node] >= 0 && nodal_weight[node] <= 1))
      reject("continuum: the weight of node ", node, " is ", nodal_weight[node], "; weights lie in [0, 1]");
  // A node has mass exactly if one of its elements has a node of weight below 1. Checked first: a throw changes
  // nothing.
  std::vector<bool> has_mass(n_nodes(), false);
  for (std::size_t e = 0; e < n_elements(); ++e)
  {
    const std::span<const unsigned int> nodes = element_nodes(e);
    if (std::any_of(nodes.begin(), nodes.end(), [&](const unsigned int node) { return nodal_weight[node] < 1; }))
      for (const unsigned int node : nodes)
        has_mass[node] = true;
  }
  const auto massless = std::find(has_mass.begin(), has_mass.end(), false);
  if (massless != has_mass.end())
    reject("continuum: the weights leave node ", massless - has_mass.begin(),
           " without mass; bound them away from 1, e.g. by 0.999");

  std::vector<double> share(n_nodes());
  for (std::size_t node = 0; node < n_nodes(); ++node)
    share[node] = 1 - nodal_weight[node];
  elements().set_share(share);
  gather_mass();
}

std::vector<unsigned int> ExplicitBody::boundary_nodes(const unsigned int boundary_id) const
{
  std::vector<unsigned int> nodes = boundary_surface(dof_handler(), boundary_id).nodes;
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

ExplicitBody make_box_body(const BoxMeshParameters &box, const ExplicitBodyParameters &parameters)
{
  dealii::Triangulation<3> mesh;
  make_box(box, mesh);
  return ExplicitBody(mesh, parameters);
}

} // namespace bergamo::fe
