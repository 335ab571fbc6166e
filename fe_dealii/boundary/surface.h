#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace dealii
{
template <int dim, int spacedim>
class DoFHandler;
}

namespace bergamo::fe
{

/// Faces of a boundary or of a membrane, by the nodes of the body: tensor products of (degree + 1)² nodes, x fastest,
/// ordered so that the cross product of the first and the second direction points out of the body.
struct Surface
{
  int degree = 1; ///< 1 or 2
  std::vector<unsigned int> nodes;
  std::vector<unsigned int> elements; ///< that the faces belong to

  int nodes_per_face() const { return (degree + 1) * (degree + 1); }
  std::size_t size() const { return nodes.size() / nodes_per_face(); }
  std::span<const unsigned int> face(const std::size_t k) const
  {
    return {&nodes[k * nodes_per_face()], std::size_t(nodes_per_face())};
  }
};

/// All faces of a boundary. Throws ConfigError where the mesh has no such boundary.
/// @param dof_handler of a body: FESystem(FE_Q(degree), 3), dofs 3*node + component
Surface boundary_surface(const dealii::DoFHandler<3, 3> &dof_handler, unsigned int boundary_id);

/// All cells of a mesh of membranes; their order of nodes and deal.II's direction flag say where the cross product
/// points: out of the spheres of GridGenerator. Throws ConfigError where two neighbours disagree.
/// @param dof_handler of a body: FESystem(FE_Q(1), 3), dofs 3*node + component
Surface membrane_surface(const dealii::DoFHandler<2, 3> &dof_handler);

/// Linear triangles between the nodes of the surface, outward counterclockwise: two for each face of 4 nodes, eight for
/// each of 9 (the analogue of Wellmann's fig. 4.1).
std::vector<std::array<unsigned int, 3>> triangles(const Surface &surface);

/// Two triangles for each square of a grid of n × n, by the numbers of its (n + 1)² points, x fastest; counterclockwise
/// with x to the right and y up.
std::vector<std::array<unsigned int, 3>> grid_triangles(unsigned int n_squares);

} // namespace bergamo::fe
