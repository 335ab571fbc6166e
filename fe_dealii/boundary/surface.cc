#include "fe_dealii/boundary/surface.h"

#include "dem/core/error.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <sstream>
#include <utility>

namespace bergamo::fe
{

Surface boundary_surface(const dealii::DoFHandler<3, 3> &dof_handler, const unsigned int boundary_id)
{
  Surface surface;
  surface.degree = dof_handler.get_fe().degree;
  const int n = surface.degree + 1;
  const std::vector<unsigned int> place = dealii::FE_Q<2>(surface.degree).get_poly_space_numbering_inverse();
  std::vector<dealii::types::global_dof_index> dofs(dof_handler.get_fe().n_dofs_per_face());
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
    {
      if (!face->at_boundary() || face->boundary_id() != boundary_id)
        continue;
      face->get_dof_indices(dofs, cell->active_fe_index());
      const auto normal =
          dealii::cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
      const bool outward = normal * (face->center() - cell->center()) > 0;
      surface.elements.push_back(cell->active_cell_index());
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          surface.nodes.push_back(dofs[3 * place[outward ? n * j + i : n * i + j]] / 3);
    }
  if (surface.nodes.empty())
  {
    std::ostringstream message;
    message << "continuum: the mesh has no boundary " << boundary_id << "; it has";
    for (const auto id : dof_handler.get_triangulation().get_boundary_ids())
      message << ' ' << id;
    throw ConfigError(message.str());
  }
  return surface;
}

Surface membrane_surface(const dealii::DoFHandler<2, 3> &dof_handler)
{
  Surface surface;
  // An edge that two cells run along in the same direction has one's front beside the other's back.
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> cell_of_edge;
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    std::array<unsigned int, 4> node;
    for (unsigned int vertex = 0; vertex < 4; ++vertex)
      node[vertex] = cell->vertex_dof_index(vertex, 0) / 3;
    if (!cell->direction_flag())
      std::swap(node[1], node[2]);
    surface.nodes.insert(surface.nodes.end(), node.begin(), node.end());
    surface.elements.push_back(cell->active_cell_index());
    constexpr int around[] = {0, 1, 3, 2, 0};
    for (int k = 0; k < 4; ++k)
    {
      const auto [other, is_new] =
          cell_of_edge.insert({{node[around[k]], node[around[k + 1]]}, cell->active_cell_index()});
      if (is_new)
        continue;
      std::ostringstream message;
      message << "membrane: cells " << other->second << " and " << cell->active_cell_index() << " at ("
              << cell->center() << ") m turn opposite sides to the same side of the membrane; order the nodes of all "
              << "cells alike, or put no pressure on a membrane that has one side only";
      throw ConfigError(message.str());
    }
  }
  return surface;
}

std::vector<std::array<unsigned int, 3>> triangles(const Surface &surface)
{
  std::vector<std::array<unsigned int, 3>> result;
  for (std::size_t k = 0; k < surface.size(); ++k)
    for (const auto &[a, b, c] : grid_triangles(surface.degree))
      result.push_back({surface.face(k)[a], surface.face(k)[b], surface.face(k)[c]});
  return result;
}

std::vector<std::array<unsigned int, 3>> grid_triangles(const unsigned int n_squares)
{
  std::vector<std::array<unsigned int, 3>> result;
  const unsigned int n = n_squares + 1;
  for (unsigned int j = 0; j < n_squares; ++j)
    for (unsigned int i = 0; i < n_squares; ++i)
    {
      const unsigned int a = n * j + i, b = a + 1, c = b + n, d = a + n;
      result.push_back({a, b, c});
      result.push_back({a, c, d});
    }
  return result;
}

} // namespace bergamo::fe
