#pragma once

#include "dem/packing/space.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace bergamo::dem
{

/// Grains by cells no smaller than the range of their neighbours, around the faces of a periodic box.
class GrainGrid
{
public:
  /// @param range of the neighbours looked for, centre to centre [m]
  GrainGrid(const PackingSpace &space, const double range) : space(&space)
  {
    constexpr int most_per_edge = 400; // 64 million cells
    for (int d = 0; d < 3; ++d)
    {
      const double cells_fitting = space.bounds().edges()[d] / range;
      n[d] = std::max(1, static_cast<int>(std::min<double>(cells_fitting, most_per_edge)));
    }
    cells.resize(static_cast<std::size_t>(n[0]) * n[1] * n[2]);
  }

  void add(const std::int32_t grain, const Vec3 &position, const double radius)
  {
    const auto c = cell(position);
    const std::size_t at = index(c[0], c[1], c[2]);
    if (cells[at].empty())
      used.push_back(at);
    cells[at].push_back({position, radius, grain});
  }

  void clear()
  {
    for (const std::size_t at : used)
      cells[at].clear();
    used.clear();
  }

  /// Calls found(grain, centre line) for the grains nearer than `reach` and their own radius, from cell to cell and in
  /// each in the order of addition, until it says true. @return whether it did. A grain at the very place is among
  /// them.
  /// @param reach at most the range of the grid less the largest radius [m]
  template <class Found>
  bool any_near(const Vec3 &position, const double reach, Found &&found) const
  {
    const auto c = cell(position);
    std::array<std::array<int, 3>, 3> at; // cells to look into, each once
    std::array<int, 3> count{};
    for (int d = 0; d < 3; ++d)
      for (int k = c[d] - 1; k <= c[d] + 1; ++k)
      {
        const bool is_outside = k < 0 || k >= n[d];
        if (is_outside && (!space->is_periodic(d) || n[d] < 3))
          continue;
        at[d][count[d]++] = (k + n[d]) % n[d];
      }
    for (int z = 0; z < count[2]; ++z)
      for (int y = 0; y < count[1]; ++y)
        for (int x = 0; x < count[0]; ++x)
          for (const Entry &e : cells[index(at[0][x], at[1][y], at[2][z])])
          {
            const Vec3 centre_line = space->nearest_image(e.position - position);
            const double range = reach + e.radius;
            if (centre_line.squaredNorm() < range * range && found(e.grain, centre_line))
              return true;
          }
    return false;
  }

private:
  struct Entry
  {
    Vec3 position;
    double radius;
    std::int32_t grain;
  };

  std::array<int, 3> cell(const Vec3 &x) const
  {
    std::array<int, 3> c;
    for (int d = 0; d < 3; ++d)
      c[d] = std::clamp(static_cast<int>((x[d] - space->bounds().low[d]) / space->bounds().edges()[d] * n[d]), 0,
                        n[d] - 1);
    return c;
  }

  std::size_t index(const int x, const int y, const int z) const
  {
    return (static_cast<std::size_t>(z) * n[1] + y) * n[0] + x;
  }

  const PackingSpace *space;
  int n[3];
  std::vector<std::vector<Entry>> cells;
  std::vector<std::size_t> used; // cells that hold any: a round with few grains clears few
};

} // namespace bergamo::dem
