#pragma once

#include <cstdint>

namespace bergamo::dem
{

/// VTK's numbers of the kinds of cells.
inline constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3, vtk_triangle = 5, vtk_quadrilateral = 9,
                              vtk_hexahedron = 12;

/// Vertices, lines, rows of them, and lines of second order.
inline bool is_point_or_line(const double type)
{
  constexpr int vtk_poly_line = 4, vtk_quadratic_edge = 21;
  return (type >= 1. && type <= vtk_poly_line) || type == vtk_quadratic_edge;
}

} // namespace bergamo::dem
