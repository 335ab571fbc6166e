#pragma once

#include "dem/measure/hexahedron_grid.h"

#include <filesystem>
#include <span>
#include <string>
#include <variant>

namespace bergamo::dem
{

/// One number or vector a node, shown under its name.
struct NodeField
{
  std::string name;
  std::variant<std::span<const double>, std::span<const Vec3>> values; ///< in the order of the nodes
};

/// Writes fields on a grid of hexahedra as a VTU file for ParaView. The file appears whole or not at all. Throws
/// ConfigError for a field whose length is not the number of nodes, RunError where the file cannot be written.
void write_grid_vtu(const HexahedronGrid &grid, std::span<const NodeField> fields, const std::filesystem::path &path);

} // namespace bergamo::dem
