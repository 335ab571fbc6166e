#include "dem/geometry/merge_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace bergamo::dem
{
namespace
{

/// Places by cells, much larger than the tolerance: nearly every node has to look into one alone.
class Cells
{
public:
  explicit Cells(const double tolerance) : tolerance(tolerance) {}

  /// The first node put in that is near, or none.
  std::int32_t find(const std::vector<Vec3> &node, const Vec3 &place) const
  {
    const Vec3 reach = Vec3::Constant(tolerance);
    const Cell low = cell_of(place - reach), high = cell_of(place + reach);
    std::int32_t first = SurfaceTopology::none;
    for (std::int64_t i = low[0]; i <= high[0]; ++i)
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
        for (std::int64_t k = low[2]; k <= high[2]; ++k)
          if (const auto cell = nodes.find({i, j, k}); cell != nodes.end())
            for (const std::int32_t other : cell->second)
              if ((node[other] - place).norm() <= tolerance && (first == SurfaceTopology::none || other < first))
                first = other;
    return first;
  }

  void put(const Vec3 &place, const std::int32_t number) { nodes[cell_of(place)].push_back(number); }

private:
  using Cell = std::array<std::int64_t, 3>;

  Cell cell_of(const Vec3 &place) const
  {
    constexpr double tolerances = 100.; // of a cell
    Cell cell;
    for (int i = 0; i < 3; ++i)
      cell[i] = static_cast<std::int64_t>(std::floor(place[i] / (tolerances * tolerance)));
    return cell;
  }

  double tolerance;
  std::map<Cell, std::vector<std::int32_t>> nodes;
};

} // namespace

void merge_nodes(std::vector<Vec3> &node, std::vector<Triangle> &triangles, const double tolerance)
{
  std::vector<bool> is_used(node.size(), false);
  for (const Triangle &t : triangles)
    for (const std::int32_t n : t)
      is_used[n] = true;

  const Vec3 origin = node.empty() ? Vec3(Vec3::Zero()) : node.front(); // numbers of cells stay small
  Cells cells(tolerance);
  std::vector<Vec3> kept, from_origin;
  std::vector<std::int32_t> number(node.size(), SurfaceTopology::none);
  for (std::size_t n = 0; n < node.size(); ++n)
  {
    if (!is_used[n])
      continue;
    const Vec3 place = node[n] - origin;
    number[n] = cells.find(from_origin, place);
    if (number[n] != SurfaceTopology::none)
      continue;
    number[n] = static_cast<std::int32_t>(kept.size());
    kept.push_back(node[n]);
    from_origin.push_back(place);
    cells.put(place, number[n]);
  }
  node = std::move(kept);
  for (Triangle &t : triangles)
    for (std::int32_t &n : t)
      n = number[n];
}

} // namespace bergamo::dem
