#include "fe_dealii/explicit_body.h"

#include "dem/core/error.h"
#include "fe_dealii/boundary/surface.h"
#include "fe_dealii/element/cell_nodes.h"
#include "fe_dealii/element/layered_elements.h"
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
  if (degree != 1 && kind.hourglass == Hourglass::bending)
    reject("continuum: degree = ", degree,
           " of the elements is not allowed with hourglass modes that bend, which only "
           "those of 8 nodes have; choose degree 1, or leave the modes: 27 nodes bend anyway");
  MassForces{gravity, damping}.validate("continuum");
  if (!(wanted_time_step >= 0) || !std::isfinite(wanted_time_step))
    reject("continuum: wanted_time_step = ", wanted_time_step,
           " s is not allowed; give a positive time, or zero for no mass scaling");
}

namespace
{

/// The material of each id that the mesh has.
std::map<unsigned int, Material> materials_of(const dealii::DoFHandler<3> &dof_handler,
                                              const ExplicitBodyParameters &parameters)
{
  std::map<unsigned int, Material> materials;
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    const unsigned int id = cell->material_id();
    if (parameters.layers.empty())
      materials.try_emplace(id, parameters.material);
    else if (const auto layer = parameters.layers.find(id); layer != parameters.layers.end())
      materials.insert(*layer);
    else
    {
      std::ostringstream known;
      for (const auto &[known_id, material] : parameters.layers)
        known << ' ' << known_id;
      reject("continuum: cell ", cell->active_cell_index(), " at (", cell->center(), ") m has the material id ", id,
             ", which has no material; give it one beside those of", known.str(),
             ", or put the cell into another layer");
    }
  }
  for (const auto &[id, material] : parameters.layers)
    if (!materials.contains(id))
      reject("continuum: a material is given for the id ", id,
             ", but no cell of the mesh has it; leave it out, or look for the cells that should");
  return materials;
}

std::unique_ptr<ElementGroup> make_elements(const dealii::DoFHandler<3> &dof_handler,
                                            const ExplicitBodyParameters &parameters)
{
  const std::map<unsigned int, Material> materials = materials_of(dof_handler, parameters);
  if (parameters.layers.size() < 2)
    return make_solid_elements(dof_handler, materials.begin()->second, parameters.initial_stress, parameters.kind);
  std::vector<std::unique_ptr<ElementGroup>> groups;
  std::map<unsigned int, std::size_t> group_of_id;
  for (const auto &[id, material] : materials)
  {
    group_of_id[id] = groups.size();
    groups.push_back(make_solid_elements(dof_handler, material, parameters.initial_stress, parameters.kind, id));
  }
  std::vector<std::size_t> group_of_element;
  for (const auto &cell : dof_handler.active_cell_iterators())
    group_of_element.push_back(group_of_id.at(cell->material_id()));
  return std::make_unique<LayeredElements>(std::move(groups), group_of_element);
}

} // namespace

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
    : MovingBody("continuum", node_positions(mesh->dof_handler), make_elements(mesh->dof_handler, p),
                 {p.gravity, p.damping}, p.wanted_time_step),
      mesh_(std::move(mesh)), materials_(materials_of(mesh_->dof_handler, p))
{
  for (const auto &cell : mesh_->dof_handler.active_cell_iterators())
    material_id_.push_back(cell->material_id());
}

ExplicitBody::ExplicitBody(ExplicitBody &&) noexcept = default;
ExplicitBody::~ExplicitBody() = default;

const dealii::DoFHandler<3, 3> &ExplicitBody::dof_handler() const
{
  return mesh_->dof_handler;
}

const Material &ExplicitBody::material(const std::size_t element) const
{
  return materials_.at(material_id_[element]);
}

void ExplicitBody::set_share(const std::span<const double> nodal_weight)
{
  if (nodal_weight.size() != n_nodes())
    reject("continuum: ", nodal_weight.size(), " nodal weights given for ", n_nodes(), " nodes; give one per node");
  for (std::size_t node = 0; node < n_nodes(); ++node)
    if (!(nodal_weight[node] >= 0 && nodal_weight[node] <= 1))
      reject("continuum: the weight of node ", node, " is ", nodal_weight[node], "; weights lie in [0, 1]");
  std::vector<bool> absent(n_elements());
  for (std::size_t e = 0; e < n_elements(); ++e)
  {
    const std::span<const unsigned int> nodes = element_nodes(e);
    absent[e] =
        std::all_of(nodes.begin(), nodes.end(), [&](const unsigned int node) { return nodal_weight[node] == 1; });
    if (is_absent(e) && !absent[e])
      reject("continuum: the weights bring back element ", e,
             ", which was absent, and its nodes have stayed behind; let weights grow there");
  }
  if (std::find(absent.begin(), absent.end(), false) == absent.end())
    reject("continuum: the weights leave no element with a share; bound some of them away from 1");

  std::vector<double> share(n_nodes());
  for (std::size_t node = 0; node < n_nodes(); ++node)
    share[node] = 1 - nodal_weight[node];
  exchange(
      [&]
      {
        elements().set_share(share);
        for (std::size_t e = 0; e < n_elements(); ++e)
          if (absent[e])
            elements().make_rigid(e);
      });
  is_absent_ = std::move(absent);
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
