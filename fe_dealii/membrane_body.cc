#include "fe_dealii/membrane_body.h"

#include "dem/core/error.h"
#include "fe_dealii/element/cell_nodes.h"
#include "fe_dealii/material/elastic_parameters.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace bergamo::fe
{

void MembraneBodyParameters::validate() const
{
  require_parameter(thickness > 0 && std::isfinite(thickness), "membrane", "thickness [m]", thickness,
                    "give a positive number");
  MassForces{gravity, damping}.validate("membrane");
}

struct MembraneBody::Mesh
{
  explicit Mesh(const dealii::Triangulation<2, 3> &mesh) : element(dealii::FE_Q<2, 3>(1), 3), dof_handler(triangulation)
  {
    if (mesh.n_active_cells() == 0)
      throw ConfigError("membrane: the mesh has no cells; fill the triangulation first");
    if (!mesh.all_reference_cells_are_hyper_cube())
      throw ConfigError("membrane: the mesh has cells that are no quadrilaterals; only quadrilaterals are "
                        "supported");
    if (mesh.has_hanging_nodes())
      throw ConfigError("membrane: the mesh has hanging nodes; refine it uniformly");
    triangulation.copy_triangulation(mesh);
    dof_handler.distribute_dofs(element);
  }

  dealii::Triangulation<2, 3> triangulation;
  dealii::FESystem<2, 3> element;
  dealii::DoFHandler<2, 3> dof_handler;
};

MembraneBody::MembraneBody(const dealii::Triangulation<2, 3> &mesh, const MembraneBodyParameters &parameters)
    : MembraneBody((parameters.validate(), std::make_unique<Mesh>(mesh)), parameters)
{
}

MembraneBody::MembraneBody(std::unique_ptr<Mesh> mesh, const MembraneBodyParameters &p)
    : MovingBody("membrane", node_positions(mesh->dof_handler),
                 make_membrane_elements(mesh->dof_handler, p.material, p.thickness), {p.gravity, p.damping}, 0),
      mesh_(std::move(mesh)), membranes_(static_cast<const MembraneElements *>(&elements()))
{
}

MembraneBody::MembraneBody(MembraneBody &&) noexcept = default;
MembraneBody::~MembraneBody() = default;

const dealii::DoFHandler<2, 3> &MembraneBody::dof_handler() const
{
  return mesh_->dof_handler;
}

std::vector<unsigned int> MembraneBody::boundary_nodes(const unsigned int boundary_id) const
{
  std::vector<unsigned int> nodes;
  for (const auto &cell : dof_handler().active_cell_iterators())
    for (const auto &edge : cell->face_iterators())
      if (edge->at_boundary() && edge->boundary_id() == boundary_id)
        for (unsigned int vertex = 0; vertex < 2; ++vertex)
          nodes.push_back(edge->vertex_dof_index(vertex, 0) / 3);
  if (nodes.empty())
  {
    std::ostringstream message;
    message << "membrane: the mesh has no boundary " << boundary_id << "; it has";
    for (const auto id : dof_handler().get_triangulation().get_boundary_ids())
      message << ' ' << id;
    throw ConfigError(message.str());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

} // namespace bergamo::fe
