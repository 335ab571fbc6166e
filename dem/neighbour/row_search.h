#pragma once

#include "dem/neighbour/sphere_rows.h"

#include <vector>

namespace bergamo::dem
{

/// Searches the surroundings of spheres one after another, in the order of rows. One for each thread.
class RowSearch
{
public:
  /// All are kept by reference.
  RowSearch(const SphereRows &rows, double verlet_distance, const PeriodicCell &cell);

  /// Goes to the spheres [begin, end) in the order of rows, all of one row of the class.
  void go_to(const SizeClass &size, std::int32_t begin, std::int32_t end);

  /// Finds the partners of the next one in its own class, of greater index, and in the classes of larger spheres: so
  /// every pair is found once. The work for a large sphere among small ones does not grow with its size.
  /// @return index of the sphere
  std::int32_t find_next();

  /// Indices of the partners of the last sphere, in no order that matters.
  std::vector<std::int32_t> found;
  std::size_t n_found = 0;

private:
  /// A row in reach of that gone to.
  struct NearRow
  {
    std::int32_t begin, end;
    std::int32_t next; ///< the first of its spheres that the next sphere may reach
    double reach;      ///< of the spheres of both rows [m]
    bool is_own_class;
  };

  /// Adds the partners among the spheres [begin, end) of a row up to a place.
  template <bool is_periodic>
  void look_into(const NearRow &row, std::int32_t begin, std::int32_t end, double last_place);

  /// Looks into a row and beyond the faces of the periodic cell.
  void look_around(const NearRow &row, double place);

  const SphereRows &rows;
  const double verlet_distance;
  const PeriodicCell &cell;
  std::vector<NearRow> near;
  std::int32_t next = 0;
};

} // namespace bergamo::dem
