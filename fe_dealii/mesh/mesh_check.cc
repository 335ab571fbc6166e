#include "fe_dealii/mesh/mesh_check.h"

#include "dem/core/error.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace bergamo::fe
{
namespace
{

using Mesh = dealii::Triangulation<3>;
using Point = dealii::Point<3>;

template <class... Parts>
[[noreturn]] void reject(const Parts &...parts)
{
  bergamo::reject("mesh: ", parts...);
}

std::string place(const Point &point)
{
  std::ostringstream text;
  text << '(' << point[0] << ", " << point[1] << ", " << point[2] << ") m";
  return text.str();
}

void check_shapes(const Mesh &mesh)
{
  if (mesh.n_active_cells() == 0)
    reject("it has no cells; give one with hexahedra");
  for (const auto &cell : mesh.active_cell_iterators())
    if (!cell->reference_cell().is_hyper_cube())
      reject("cell ", cell->active_cell_index(), " at ", place(cell->center()), " is a ",
             cell->reference_cell().to_string(),
             "; only hexahedra are supported: mesh by sweeping or transfinite volumes, and recombine the surfaces");
}

/// @return the length of the shortest edge [m]
double check_corners(const Mesh &mesh)
{
  // A sound cell is far above this share of the volume that its edges at the corner would span at right angles; a flat
  // one differs from zero by rounding.
  constexpr double flat = 1e-9;
  double shortest = std::numeric_limits<double>::max();
  for (const auto &cell : mesh.active_cell_iterators())
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      dealii::Tensor<1, 3> edge[3];
      double box = 1;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int bit = 1u << i;
        edge[i] = cell->vertex(corner | bit) - cell->vertex(corner & ~bit);
        box *= edge[i].norm();
        shortest = std::min(shortest, edge[i].norm());
      }
      const double jacobian = edge[0] * dealii::cross_product_3d(edge[1], edge[2]);
      if (!(jacobian > flat * box))
        reject("cell ", cell->active_cell_index(), " with its centre at ", place(cell->center()), " is ",
               jacobian < -flat * box ? "turned inside out" : "flat", " at its corner ", place(cell->vertex(corner)),
               " (Jacobian ", jacobian, " m^3); move that vertex or mesh anew, smoother there");
    }
  return shortest;
}

void check_seams(const Mesh &mesh, const double tolerance)
{
  std::vector<bool> on_surface(mesh.n_vertices(), false);
  for (const auto &face : mesh.active_face_iterators())
    if (face->at_boundary())
      for (const unsigned int v : face->vertex_indices())
        on_surface[face->vertex_index(v)] = true;
  // Sorted along a direction in which the vertices of regular meshes do not lie above each other, so that each has few
  // neighbours to be compared with.
  const dealii::Tensor<1, 3> direction(Point(0.6180339887, 0.2360679775, 0.7498506060));
  std::vector<std::pair<double, unsigned int>> sorted;
  for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
    if (on_surface[v])
      sorted.emplace_back(direction * mesh.get_vertices()[v], v);
  std::sort(sorted.begin(), sorted.end());
  std::size_t pairs = 0;
  Point first;
  for (std::size_t a = 0; a < sorted.size(); ++a)
    for (std::size_t b = a + 1; b < sorted.size() && sorted[b].first - sorted[a].first <= tolerance; ++b)
      if (const Point &x = mesh.get_vertices()[sorted[a].second];
          x.distance(mesh.get_vertices()[sorted[b].second]) <= tolerance && pairs++ == 0)
        first = x;
  if (pairs > 0)
    reject(
        "vertices coincide at ", place(first), " without being joined, ", pairs, pairs == 1 ? " pair" : " pairs",
        " in all; join them before the mesh is written (Gmsh: Coherence on the geometry, or remove duplicate nodes)");
}

void check_connection(const Mesh &mesh)
{
  constexpr unsigned int none = -1;
  std::vector<unsigned int> piece_of(mesh.n_active_cells(), none);
  std::vector<Mesh::active_cell_iterator> first;
  for (const auto &start : mesh.active_cell_iterators())
  {
    if (piece_of[start->active_cell_index()] != none)
      continue;
    std::vector<Mesh::active_cell_iterator> open{start};
    piece_of[start->active_cell_index()] = first.size();
    while (!open.empty())
    {
      const auto cell = open.back();
      open.pop_back();
      for (const unsigned int f : cell->face_indices())
        if (!cell->at_boundary(f))
          if (const auto next = cell->neighbor(f); piece_of[next->active_cell_index()] == none)
          {
            piece_of[next->active_cell_index()] = first.size();
            open.push_back(next);
          }
    }
    first.push_back(start);
  }
  if (first.size() > 1)
    reject("it consists of ", first.size(), " pieces that share no face; the second, of ",
           std::count(piece_of.begin(), piece_of.end(), 1u), " of its ", mesh.n_active_cells(), " cells, lies at ",
           place(first[1]->center()), "; join the pieces or make a body of each");
}

} // namespace

void check_mesh(const dealii::Triangulation<3, 3> &triangulation)
{
  check_shapes(triangulation);
  if (triangulation.has_hanging_nodes())
    reject("it has hanging nodes; refine it uniformly");
  const double shortest = check_corners(triangulation);
  check_seams(triangulation, 1e-3 * shortest);
  check_connection(triangulation);
}

} // namespace bergamo::fe
