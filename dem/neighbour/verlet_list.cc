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

/// Calls found(j) for every j > i in range of i, cell by cell.
template <class Found>
void for_each_neighbour(const CellGrid &grid, const std::span<const Vec3> positions,
                        const std::span<const double> radii, const std::span<const double> masses,
                        const double verlet_distance, const std::int32_t i, Found &&found)
{
  const int cell = grid.cell_of[i];
  const int cx = cell % grid.n[0], cy = cell / grid.n[0] % grid.n[1], cz = cell / grid.n[0] / grid.n[1];
  for (int z = std::max(cz - 1, 0); z <= std::min(cz + 1, grid.n[2] - 1); ++z)
    for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, grid.n[1] - 1); ++y)
    {
      const int row = (z * grid.n[1] + y) * grid.n[0];
      const int from = grid.begin[row + std::max(cx - 1, 0)];
      const int to = grid.begin[row + std::min(cx + 1, grid.n[0] - 1) + 1];
      for (int k = from; k < to; ++k)
      {
        const std::int32_t j = grid.particles[k];
        const double range = radii[i] + radii[j] + verlet_distance;
        if (j > i && !(!masses.empty() && std::isinf(masses[i]) && std::isinf(masses[j])) &&
            (positions[j] - positions[i]).squaredNorm() < range * range)
          found(j);
      }
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
                             const double verlet_distance, const std::span<const double> masses)
{
  const std::size_t n = positions.size();
  const double largest = radii.empty() ? 1. : *std::max_element(radii.begin(), radii.end());
  const CellGrid grid(positions, 2. * largest + verlet_distance);

  VerletList list;
  list.row.assign(n + 1, 0);
  parallel_for(n,
               [&](const std::size_t i) {
                 for_each_neighbour(grid, positions, radii, masses, verlet_distance, i, [&](auto) { ++list.row[i]; });
               });
  exclusive_sum(list.row);

  list.first.resize(list.row[n]);
  list.second.resize(list.row[n]);
  parallel_for(n,
               [&](const std::size_t i)
               {
                 std::int32_t next = list.row[i];
                 for_each_neighbour(grid, positions, radii, masses, verlet_distance, i,
                                    [&](const std::int32_t j) { list.second[next++] = j; });
                 std::sort(list.second.begin() + list.row[i], list.second.begin() + list.row[i + 1]);
                 std::fill(list.first.begin() + list.row[i], list.first.begin() + list.row[i + 1],
                           static_cast<std::int32_t>(i));
               });
  return list;
}

} // namespace bergamo::dem
