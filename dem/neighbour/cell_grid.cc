#include "dem/neighbour/cell_grid.h"

#include "dem/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bergamo::dem
{

CellGrid::CellGrid(const std::span<const Vec3> positions, double cell_size, const PeriodicCell &period)
{
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
  Collected<std::pair<Vec3, Vec3>> bounds;
  parallel_ranges(positions.size(), 1024,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    Vec3 least = low, most = high;
                    for (std::size_t i = begin; i < end; ++i)
                    {
                      least = least.cwiseMin(positions[i]);
                      most = most.cwiseMax(positions[i]);
                    }
                    bounds.of(part).emplace_back(least, most);
                  });
  bounds.for_each(
      [&](const std::pair<Vec3, Vec3> &b)
      {
        low = low.cwiseMin(b.first);
        high = high.cwiseMax(b.second);
      });
  Vec3 extent = positions.empty() ? Vec3::Zero() : Vec3(high - low);
  if (period.is_periodic())
  {
    low = Vec3::Zero();
    extent = period.edges;
  }
  const double most_cells = 8. * positions.size() + 64.;
  const auto cells = [&](const double size)
  { return (extent / size).array().floor().max(1.) + (period.is_periodic() ? 0. : 1.); };
  while (cells(cell_size).prod() > most_cells)
    cell_size *= 1.5;
  for (int d = 0; d < 3; ++d)
    n[d] = static_cast<int>(cells(cell_size)[d]);
  Vec3 edge = Vec3::Constant(cell_size);
  if (period.is_periodic())
    edge = extent.cwiseQuotient(Vec3(n[0], n[1], n[2]));

  cell_of.resize(positions.size());
  begin.assign(static_cast<std::size_t>(n[0]) * n[1] * n[2] + 1, 0);
  parallel_for(positions.size(),
               [&](const std::size_t i)
               {
                 int k[3];
                 for (int d = 0; d < 3; ++d)
                   k[d] = std::clamp(static_cast<int>((positions[i][d] - low[d]) / edge[d]), 0, n[d] - 1);
                 cell_of[i] = (k[2] * n[1] + k[1]) * n[0] + k[0];
               });
  for (const std::int32_t cell : cell_of)
    ++begin[cell + 1];
  for (std::size_t c = 1; c < begin.size(); ++c)
    begin[c] += begin[c - 1];
  particles.resize(positions.size());
  std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < positions.size(); ++i)
    particles[next[cell_of[i]]++] = static_cast<std::int32_t>(i);
}

} // namespace bergamo::dem
