#pragma once

#include "dem/packing/space.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace bergamo::dem
{

/// Trilinear shape functions of one cell at a point: nodes and their shares, which add up to 1.
struct GridShares
{
  std::array<std::int32_t, 8> node;
  std::array<double, 8> share;
};

/// A box that is divided evenly into linear hexahedra. Nodes are counted along x first, then y, then z; cells likewise.
struct HexahedronGrid
{
  Box box;                                      ///< [m]
  std::array<std::int32_t, 3> n_cells{1, 1, 1}; ///< along each axis

  /// Throws ConfigError for an edge or a number of cells that is not positive, or more than 1e8 nodes.
  void validate() const;

  std::size_t n_nodes() const;
  std::size_t size() const; ///< number of cells
  Vec3 cell_edges() const;  ///< [m]

  std::int32_t node_number(const std::array<std::int32_t, 3> &along_axes) const
  {
    return along_axes[0] + (n_cells[0] + 1) * (along_axes[1] + (n_cells[1] + 1) * along_axes[2]);
  }
  std::array<std::int32_t, 3> node_along_axes(std::int32_t node) const;
  Vec3 node(std::int32_t number) const; ///< its place [m]

  /// The shape functions at a point; none outside, the faces belong to the box.
  std::optional<GridShares> shares_at(const Vec3 &point) const;

  /// Volume that a node stands for: the integral of its shape function [m^3].
  double node_volume(std::int32_t node) const;
};

/// A field at a point of the grid. @param values one a node; @param point inside, or ConfigError [m]
Vec3 value_at(const HexahedronGrid &grid, std::span<const Vec3> values, const Vec3 &point);

} // namespace bergamo::dem
