#pragma once

#include "dem/neighbour/bounding_spheres.h"
#include "dem/state/periodic_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bergamo::dem
{

/// Spheres of like size: the range of each, its diameter and the Verlet distance, is more than half of the largest's.
struct SizeClass
{
  double range = 0.;                         ///< of its largest sphere [m]
  Vec3 width = Vec3::Zero();                 ///< of its rows in y and z [m], at least the range; x is not used
  Vec3 n_rows = Vec3::Zero();                ///< in a periodic cell; infinite elsewhere
  std::int32_t begin_rows = 0, end_rows = 0; ///< in SphereRows::rows
};

/// Row along x of the spheres of a class whose y and z lie in [number, number + 1) widths.
struct SphereRow
{
  double z, y;             ///< numbers of the row: whole, but doubles, for which no place is too far
  std::int32_t begin, end; ///< of its spheres in the order of rows
};

/// Spheres sorted by size and place: classes of size from the largest to the smallest, the rows of each by z and then
/// y, the spheres of a row by x. Nothing is kept for space without spheres, so that time and memory follow from the
/// number of spheres alone, wherever they lie and however much their sizes differ.
struct SphereRows
{
  /// @param verlet_distance [m], >= 0; @param cell if periodic, spheres outside are taken at their image in it
  SphereRows(const BoundingSpheres &spheres, double verlet_distance, const PeriodicCell &cell);

  std::vector<SizeClass> classes;
  std::vector<SphereRow> rows;

  // In the order of rows, and behind the last sphere as many numbers as fill a pack.
  std::vector<std::int32_t> sphere;    ///< index
  std::vector<double> place;           ///< x, in the cell if it is periodic [m]
  std::vector<double> x, y, z, radius; ///< as given [m]
};

/// The image of a place that lies in the cell; the place itself where nothing repeats itself [m].
Vec3 place_in(const PeriodicCell &cell, const Vec3 &x);

/// Along one direction [m].
struct Interval
{
  double low, high;
};

/// Numbers of the rows of a class that meet an interval or an image of it, each once.
struct RowNumbers
{
  /// @param direction 1 or 2
  RowNumbers(const SizeClass &size, int direction, const Interval &interval);

  int n_stretches = 1;
  Interval stretch[2]; ///< first and last number
};

/// Calls visit(row) for the rows of a class with numbers among those given, in their order.
template <class Visit>
void for_each_row(const SphereRows &rows, const SizeClass &size, const Interval &y, const Interval &z, Visit &&visit)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto end = rows.rows.begin() + size.end_rows;
  const auto first_from = [&](const auto from, const double row_z, const double row_y)
  {
    return std::lower_bound(from, end, row_z,
                            [&](const SphereRow &row, const double number)
                            { return row.z < number || (row.z == number && row.y < row_y); });
  };
  for (auto row = first_from(rows.rows.begin() + size.begin_rows, z.low, y.low); row != end && row->z <= z.high;)
    if (row->y < y.low)
      row = first_from(row, row->z, y.low);
    else if (row->y > y.high)
      row = first_from(row, std::nextafter(row->z, infinity), y.low);
    else
      visit(*row++);
}

} // namespace bergamo::dem
