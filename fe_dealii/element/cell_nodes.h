#pragma once

#include <array>
#include <optional>
#include <vector>

namespace dealii
{
template <int dim, int spacedim>
class DoFHandler;
}

/// The bodies number nodes, not dofs: dof = 3 node + component, which is deal.II's order up to degree 2. Made for
/// FESystem(FE_Q(degree), 3) on hexahedra (dim 3) and on quadrilaterals in space (dim 2).
namespace bergamo::fe
{

/// Nodes of the active cells in their order, in the order of the cell's shape functions.
/// @param material_id of the cells to take; none: all
/// @throws RunError where deal.II numbers in another way
template <int dim>
std::vector<unsigned int> cell_nodes(const dealii::DoFHandler<dim, 3> &dof_handler,
                                     std::optional<unsigned int> material_id = {});

/// Places of all nodes [m].
template <int dim>
std::vector<std::array<double, 3>> node_positions(const dealii::DoFHandler<dim, 3> &dof_handler);

extern template std::vector<unsigned int> cell_nodes<2>(const dealii::DoFHandler<2, 3> &, std::optional<unsigned int>);
extern template std::vector<unsigned int> cell_nodes<3>(const dealii::DoFHandler<3, 3> &, std::optional<unsigned int>);
extern template std::vector<std::array<double, 3>> node_positions<2>(const dealii::DoFHandler<2, 3> &);
extern template std::vector<std::array<double, 3>> node_positions<3>(const dealii::DoFHandler<3, 3> &);

} // namespace bergamo::fe
