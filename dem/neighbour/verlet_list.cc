#include "dem/neighbour/verlet_list.h"

#include "dem/core/parallel.h"
#include "dem/neighbour/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bergamo::dem
{
namespace
{

/// What pairs are looked for among.
struct Surroundings
{
  CellGrid grid;
  std::span<const Vec3> positions;
  std::span<const double> radii, masses;
  double verlet_distance;
  const PeriodicCell &cell;

  Image image(const std::int32_t i, const std::int32_t j) const
  {
    return cell.is_periodic() ? cell.nearest_image(positions[j] - positions[i]) : own_image;
  }

  bool are_near(const std::int32_t i, const std::int32_t j) const
  {
    if (!masses.empty() && std::isinf(masses[i]) && std::isinf(masses[j]))
      return false;
    const double range = radii[i] + radii[j] + verlet_distance;
    return (positions[j] - positions[i] + cell.place[image(i, j)]).squaredNorm() < range * range;
  }
};

/// Cells of one direction that are beside or equal to one of n, each once.
struct CellsBeside
{
  int n_cells = 0;
  int cells[3];

  CellsBeside(const int cell, const int n, const bool is_periodic)
  {
    for (int k = cell - 1; k <= cell + 1; ++k)
    {
      const int wrapped = is_periodic ? (k + n) % n : k;
      if (wrapped >= 0 && wrapped < n && std::find(cells, cells + n_cells, wrapped) == cells + n_cells)
        cells[n_cells++] = wrapped;
    }
  }
  const int *begin() const { return cells; }
  const int *end() const { return cells + n_cells; }
};

/// Calls found(j) for every j > i in range of i, cell by cell.
template <class Found>
void for_each_neighbour(const Surroundings &s, const std::int32_t i, Found &&found)
{
  const CellGrid &grid = s.grid;
  const bool is_periodic = s.cell.is_periodic();
  const int cell = grid.cell_of[i];
  const CellsBeside x_cells(cell % grid.n[0], grid.n[0], is_periodic),
      y_cells(cell / grid.n[0] % grid.n[1], grid.n[1], is_periodic),
      z_cells(cell / grid.n[0] / grid.n[1], grid.n[2], is_periodic);
  for (const int z : z_cells)
    for (const int y : y_cells)
      for (const int x : x_cells)
      {
        const int other = (z * grid.n[1] + y) * grid.n[0] + x;
        for (int k = grid.begin[other]; k < grid.begin[other + 1]; ++k)
          if (const std::int32_t j = grid.particles[k]; j > i && s.are_near(i, j))
            found(j);
      }
}

void exclusive_sum(std::vector<std::int32_t> &counts)
{
  std::int32_t sum = 0;
  for (std::int32_t &c : counts)
    c = std::exchange(sum, sum + c);
}

} // namespace

VerletList build_verlet_list(const std::span<const Vec3> positions, const std::span<const double> radii,
                             const double verlet_distance, const std::span<const double> masses,
                             const PeriodicCell &cell)
{
  const std::size_t n = positions.size();
  const double largest = radii.empty() ? 1. : *std::max_element(radii.begin(), radii.end());
  const Surroundings surroundings{
      CellGrid(positions, 2. * largest + verlet_distance, cell), positions, radii, masses, verlet_distance, cell};

  VerletList list;
  list.row.assign(n + 1, 0);
  parallel_for(n, [&](const std::size_t i)
               { for_each_neighbour(surroundings, static_cast<std::int32_t>(i), [&](auto) { ++list.row[i]; }); });
  exclusive_sum(list.row);

  list.first.resize(list.row[n]);
  list.second.resize(list.row[n]);
  list.image.resize(list.row[n]);
  parallel_for(n,
               [&](const std::size_t i)
               {
                 std::int32_t next = list.row[i];
                 for_each_neighbour(surroundings, static_cast<std::int32_t>(i),
                                    [&](const std::int32_t j) { list.second[next++] = j; });
                 std::sort(list.second.begin() + list.row[i], list.second.begin() + list.row[i + 1]);
                 std::fill(list.first.begin() + list.row[i], list.first.begin() + list.row[i + 1],
                           static_cast<std::int32_t>(i));
                 for (auto pair = list.row[i]; pair < list.row[i + 1]; ++pair)
                   list.image[pair] = surroundings.image(static_cast<std::int32_t>(i), list.second[pair]);
               });
  return list;
}

} // namespace bergamo::dem
