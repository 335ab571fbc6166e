#include "dem/io/grid_vtu.h"

#include "dem/core/error.h"
#include "dem/io/vtk_cell.h"
#include "dem/io/vtu_writer.h"

#include <cstdint>

namespace bergamo::dem
{
namespace
{

VtuArray array_of(const std::string &name, const std::span<const double> values)
{
  return {vtu_attributes("Float64", name), values.size(), sizeof(double),
          [values](const std::size_t n, std::byte *out) { put_bytes(out, values[n]); }};
}

VtuArray array_of(const std::string &name, const std::span<const Vec3> values)
{
  return {vtu_attributes("Float64", name, 3), values.size(), 3 * sizeof(double),
          [values](const std::size_t n, std::byte *out) { put_bytes<double>(out, values[n]); }};
}

/// Nodes of a cell in VTK's order: around the lower face, then around the upper one.
std::array<std::int32_t, 8> nodes_of_cell(const HexahedronGrid &grid, const std::size_t cell)
{
  const auto number = static_cast<std::int32_t>(cell);
  const std::int32_t i = number % grid.n_cells[0], j = number / grid.n_cells[0] % grid.n_cells[1],
                     k = number / (grid.n_cells[0] * grid.n_cells[1]);
  std::array<std::int32_t, 8> nodes;
  for (int n = 0; n < 8; ++n)
    nodes[n] = grid.node_number({i + (n % 4 == 1 || n % 4 == 2), j + (n % 4 >= 2), k + n / 4});
  return nodes;
}

/// @param n values each; @param owners "nodes" or "cells"
std::vector<VtuArray> arrays_of(const std::span<const GridField> fields, const std::size_t n, const std::string &owners)
{
  std::vector<VtuArray> arrays;
  for (const GridField &field : fields)
    std::visit(
        [&](const auto values)
        {
          require(values.size() == n, ("number of values of the field " + field.name).c_str(), values.size(),
                  "that of the grid's " + owners + ", " + std::to_string(n));
          arrays.push_back(array_of(field.name, values));
        },
        field.values);
  return arrays;
}

} // namespace

void write_grid_vtu(const HexahedronGrid &grid, const GridFields &fields, const std::filesystem::path &path)
{
  grid.validate();
  const std::vector<VtuArray> of_nodes = arrays_of(fields.of_nodes, grid.n_nodes(), "nodes"),
                              of_cells = arrays_of(fields.of_cells, grid.size(), "cells");
  const VtuArray points{vtu_attributes("Float64", "Points", 3), grid.n_nodes(), 3 * sizeof(double),
                        [&](const std::size_t n, std::byte *out)
                        { put_bytes<double>(out, grid.node(static_cast<std::int32_t>(n))); }};
  const VtuArray connectivity{vtu_attributes("Int32", "connectivity"), grid.size(), 8 * sizeof(std::int32_t),
                              [&](const std::size_t cell, std::byte *out)
                              {
                                for (const std::int32_t node : nodes_of_cell(grid, cell))
                                  put_bytes(out, node);
                              }};
  const VtuArray offsets{vtu_attributes("Int64", "offsets"), grid.size(), sizeof(std::int64_t),
                         [](const std::size_t cell, std::byte *out)
                         { put_bytes(out, static_cast<std::int64_t>(8 * (cell + 1))); }};
  const VtuArray types{vtu_attributes("UInt8", "types"), grid.size(), sizeof vtk_hexahedron,
                       [](std::size_t, std::byte *out) { put_bytes(out, vtk_hexahedron); }};
  write_vtu({grid.n_nodes(), grid.size(), points, {connectivity, offsets, types}, of_nodes, of_cells}, path);
}

} // namespace bergamo::dem
