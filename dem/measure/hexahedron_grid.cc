#include "dem/measure/hexahedron_grid.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{

void HexahedronGrid::validate() const
{
  constexpr double most_nodes = 1e8;
  double nodes = 1.;
  for (int d = 0; d < 3; ++d)
  {
    const double edge = box.edges()[d];
    require(edge > 0. && std::isfinite(edge), "edge of a grid's box", edge, "positive and finite [m]");
    require(n_cells[d] >= 1, "number of cells of a grid along an axis", n_cells[d], "at least 1");
    nodes *= n_cells[d] + 1.;
  }
  require(nodes <= most_nodes, "number of nodes of a grid", nodes, "at most 1e8: choose fewer cells");
}

std::size_t HexahedronGrid::n_nodes() const
{
  return (n_cells[0] + std::size_t(1)) * (n_cells[1] + std::size_t(1)) * (n_cells[2] + std::size_t(1));
}

std::size_t HexahedronGrid::size() const
{
  return std::size_t(1) * n_cells[0] * n_cells[1] * n_cells[2];
}

Vec3 HexahedronGrid::cell_edges() const
{
  return box.edges().cwiseQuotient(Vec3(n_cells[0], n_cells[1], n_cells[2]));
}

std::array<std::int32_t, 3> HexahedronGrid::node_along_axes(const std::int32_t node) const
{
  const std::int32_t row = node / (n_cells[0] + 1);
  return {node % (n_cells[0] + 1), row % (n_cells[1] + 1), row / (n_cells[1] + 1)};
}

Vec3 HexahedronGrid::node(const std::int32_t number) const
{
  const auto [i, j, k] = node_along_axes(number);
  return box.low + cell_edges().cwiseProduct(Vec3(i, j, k));
}

std::optional<GridShares> HexahedronGrid::shares_at(const Vec3 &point) const
{
  const Vec3 place = (point - box.low).cwiseQuotient(cell_edges()); // in cells
  std::array<std::int32_t, 3> cell;
  Vec3 upper; // share of the cell's far side
  for (int d = 0; d < 3; ++d)
  {
    if (!(place[d] >= 0. && place[d] <= n_cells[d]))
      return {};
    cell[d] = std::min(static_cast<std::int32_t>(place[d]), n_cells[d] - 1);
    upper[d] = place[d] - cell[d];
  }
  GridShares shares;
  for (int corner = 0; corner < 8; ++corner)
  {
    std::array<std::int32_t, 3> at = cell;
    double share = 1.;
    for (int d = 0; d < 3; ++d)
    {
      const int is_upper = corner >> d & 1;
      at[d] += is_upper;
      share *= is_upper ? upper[d] : 1. - upper[d];
    }
    shares.node[corner] = node_number(at);
    shares.share[corner] = share;
  }
  return shares;
}

double HexahedronGrid::node_volume(const std::int32_t node) const
{
  const std::array<std::int32_t, 3> at = node_along_axes(node);
  double volume = cell_edges().prod();
  for (int d = 0; d < 3; ++d)
    volume *= at[d] == 0 || at[d] == n_cells[d] ? 0.5 : 1.;
  return volume;
}

Vec3 value_at(const HexahedronGrid &grid, const std::span<const Vec3> values, const Vec3 &point)
{
  const std::optional<GridShares> shares = grid.shares_at(point);
  if (!shares)
    reject("the point (", point.x(), ", ", point.y(), ", ", point.z(),
           ") m, at which a field is asked for, lies outside its grid");
  Vec3 value = Vec3::Zero();
  for (int corner = 0; corner < 8; ++corner)
    value += shares->share[corner] * values[shares->node[corner]];
  return value;
}

} // namespace bergamo::dem
