#pragma once

#include "dem/force/touching_contact.h"
#include "dem/measure/hexahedron_grid.h"
#include "dem/state/particles.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Stresses of the cells of a grid: a tensor times volume [N m] that belongs to a line or a box is shared out to the
/// cells by the part of it that lies in each. So cells that fill a box bear together what the box bears, however fine
/// they are. What lies outside of the grid is lost, but an axis with one cell is not cut at all: it takes everything
/// along it. Global frame, tension positive. Sums run in the order of the calls.
class CellSums
{
public:
  /// Throws ConfigError as the grid's validate() does.
  explicit CellSums(const HexahedronGrid &grid);

  /// Of something even along a straight line. One without length belongs to the cell of its place.
  void add_along(const Vec3 &from, const Vec3 &to, const Mat3 &stress_volume);

  /// Of something even in a box. One without volume is a line, a face or a place.
  void add_within(const Box &box, const Mat3 &stress_volume);

  /// Those of the images of a periodic cell that may reach into the grid along the axes that it cuts, itself included
  /// [m]: what lies anywhere belongs to the cells of all of them together, if the grid fills the periodic cell.
  std::vector<Vec3> shifts(const PeriodicCell &cell) const;

  const std::vector<Mat3> &sums() const { return sums_; } ///< [N m], a cell each, in the order of HexahedronGrid
  std::vector<Mat3> means() const;                        ///< over the volume of a cell: stresses [Pa]

private:
  struct Range
  {
    int first, last; ///< cells, none where the last is less
  };
  bool is_cut(const int axis) const { return grid_.n_cells[axis] > 1; }
  double in_cells(double place, int axis) const; ///< from the grid's lower end
  int cell_at(double place, int axis) const;     ///< outside: -1 or one too many
  Range cells_between(double low, double high, int axis) const;
  double part_of(double low, double high, int cell, int axis) const; ///< of a way, that lies in the cell
  void add_at(const Vec3 &place, const Mat3 &stress_volume);

  HexahedronGrid grid_;
  Vec3 edges_;
  std::vector<Mat3> sums_;
};

/// Adds contacts, each even along its branch with its weight: the mean stress of each cell is then that of Love (1927),
/// a contact that crosses a face counted in both cells by its parts, where mean_stress() of a cell gives all of it to
/// the cell of its point. In a periodic cell, which the grid has to fill, with their images.
void add_contacts(CellSums &cells, std::span<const TouchingContact> contacts, const Particles &particles);

} // namespace bergamo::dem
