#pragma once

#include "dem/core/types.h"

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace bergamo::dem
{

/// One array of a VTU file. Its parts all fill the same number of bytes, each by itself.
struct VtuArray
{
  std::string attributes;
  std::size_t n_parts;
  std::size_t bytes_per_part;
  std::function<void(std::size_t part, std::byte *bytes)> fill;
};

/// What a VTU file holds.
struct VtuGrid
{
  std::size_t n_points, n_cells;
  VtuArray points;
  std::vector<VtuArray> cells; ///< connectivity, offsets, types
  std::vector<VtuArray> point_data, cell_data;
};

/// Attributes of an array. @param type VTK's name of its numbers
std::string vtu_attributes(const std::string &type, const std::string &name, int n_components = 1);

/// Writes a file for ParaView, its numbers as raw bytes. Appears whole or not at all; throws RunError where it cannot
/// be written.
void write_vtu(const VtuGrid &grid, const std::filesystem::path &path);

/// Puts a number, as the type it has, and goes on behind it.
template <class Value>
void put_bytes(std::byte *&bytes, const Value value)
{
  std::memcpy(bytes, &value, sizeof value);
  bytes += sizeof value;
}

/// As three numbers of a type.
template <class Number = float>
void put_bytes(std::byte *&bytes, const Vec3 &vector)
{
  for (int i = 0; i < 3; ++i)
    put_bytes(bytes, static_cast<Number>(vector[i]));
}

} // namespace bergamo::dem
