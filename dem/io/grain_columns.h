#pragma once

#include "dem/core/types.h"
#include "dem/geometry/superquadric.h"
#include "dem/io/text_rows.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace bergamo::dem
{

/// Which columns of a file hold what of a superquadric, by the names of its header.
class GrainColumns
{
public:
  /// Of a table with commas: id, x_m, y_m, z_m; qx, qy, qz, qw; a_m, b_m, c_m or radius_m; exponent_1, exponent_2;
  /// material. Without quaternion unturned, without exponents ellipsoids, without material the first one. Throws
  /// ConfigError for names that are missing or stand there twice. @param rows at the line of the names
  static GrainColumns of_csv(const TextRows &rows);

  /// Of a dump of LAMMPS, LIGGGHTS or `python3 -m bergamo export`. LIGGGHTS: half-axes shapex .. shapez, blockiness1
  /// along z and blockiness2 across, which are two over our exponents, quaternion quat1 .. quat4 with the scalar first.
  /// LAMMPS, as quatw .. quatk tell: shapex .. shapez are diameters. Ours: OVITO's names of properties. Spheres have
  /// radius or diameter; type counts materials from 1. @param rows at the line "ITEM: ATOMS id type x ..."
  static GrainColumns of_dump(const TextRows &rows);

  /// @name Of the present line, in the unit of the file
  /// Throws ConfigError, with line and column, for words that are no such numbers.
  /// @{
  std::optional<std::int64_t> id(const TextRows &rows) const;
  Vec3 place(const TextRows &rows) const;
  Quaternion orientation(const TextRows &rows) const;          ///< unit
  Superquadric shape(const TextRows &rows, double unit) const; ///< half-axes times the unit
  std::int32_t material(const TextRows &rows, std::int32_t n_materials) const;
  /// @}

private:
  using Column = std::optional<std::size_t>;

  std::array<Column, 3> place_, half_axis_;
  std::array<Column, 4> quaternion_; // x, y, z, w
  std::array<Column, 2> exponent_;
  Column id_, material_;
  double axis_factor_ = 1.;           // half-axis over what the column holds
  bool exponents_are_blocks_ = false; // two over ours
  std::int32_t first_material_ = 0;
};

} // namespace bergamo::dem
