#include "fe_dealii/element/cell_nodes.h"

#include "dem/core/error.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/tria.h>

namespace bergamo::fe
{

template <int dim>
std::vector<unsigned int> cell_nodes(const dealii::DoFHandler<dim, 3> &dof_handler,
                                     const std::optional<unsigned int> material_id)
{
  const auto &element = dof_handler.get_fe();
  const unsigned int n_nodes = element.dofs_per_cell / 3;
  std::vector<unsigned int> nodes;
  std::vector<dealii::types::global_dof_index> dofs(element.dofs_per_cell);
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    if (material_id && cell->material_id() != *material_id)
      continue;
    cell->get_dof_indices(dofs);
    for (unsigned int node = 0; node < n_nodes; ++node)
    {
      const auto first = dofs[element.component_to_system_index(0, node)];
      if (first % 3 != 0 || dofs[element.component_to_system_index(1, node)] != first + 1 ||
          dofs[element.component_to_system_index(2, node)] != first + 2)
        throw RunError("this version of deal.II numbers the displacement components of a node apart; use 9.4, or "
                       "renumber in cell_nodes()");
      nodes.push_back(first / 3);
    }
  }
  return nodes;
}

template <int dim>
std::vector<std::array<double, 3>> node_positions(const dealii::DoFHandler<dim, 3> &dof_handler)
{
  std::vector<dealii::Point<3>> support(dof_handler.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<dim, 3>(), dof_handler, support);
  std::vector<std::array<double, 3>> position(support.size() / 3);
  for (std::size_t node = 0; node < position.size(); ++node)
    for (int i = 0; i < 3; ++i)
      position[node][i] = support[3 * node][i];
  return position;
}

template std::vector<unsigned int> cell_nodes<2>(const dealii::DoFHandler<2, 3> &, std::optional<unsigned int>);
template std::vector<unsigned int> cell_nodes<3>(const dealii::DoFHandler<3, 3> &, std::optional<unsigned int>);
template std::vector<std::array<double, 3>> node_positions<2>(const dealii::DoFHandler<2, 3> &);
template std::vector<std::array<double, 3>> node_positions<3>(const dealii::DoFHandler<3, 3> &);

} // namespace bergamo::fe
