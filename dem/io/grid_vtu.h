#pragma once

#include "dem/measure/hexahedron_grid.h"

#include <filesystem>
#include <span>
#include <string>
#include <variant>

namespace bergamo::dem
{

/// One number or vector a node or a cell, shown under its name.
struct GridField
{
  std::string name;
  std::variant<std::span<const double>, std::span<const Vec3>> values; ///< in the order of the grid
};

struct GridFields
{
  std::span<const GridField> of_nodes = {}, of_cells = {};
};

/// Writes fields on a grid of hexahedra as a VTU file for ParaView. The file appears whole or not at all. Throws
/// ConfigError for a field whose length is not the number of nodes or of cells, RunError where the file cannot be
/// written.
void write_grid_vtu(const HexahedronGrid &grid, const GridFields &fields, const std::filesystem::path &path);

} // namespace bergamo::dem
