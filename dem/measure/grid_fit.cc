#include "dem/measure/grid_fit.h"

#include "dem/core/error.h"

#include <Eigen/SparseCholesky>

namespace bergamo::dem
{
namespace
{

constexpr double smoothing = 1e-3; // weight of the second differences over a node's mean share

using Matrix = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

/// Adds weight times the square of the second difference around a node along an axis, if it has neighbours there.
void add_second_difference(const HexahedronGrid &grid, const std::int32_t node, const int axis, const double weight,
                           Entries &entries)
{
  std::array<std::int32_t, 3> at = grid.node_along_axes(node);
  if (at[axis] == 0 || at[axis] == grid.n_cells[axis])
    return;
  constexpr std::array<double, 3> difference{1., -2., 1.};
  std::array<std::int32_t, 3> nodes;
  --at[axis];
  for (std::int32_t &n : nodes)
  {
    n = grid.node_number(at);
    ++at[axis];
  }
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      entries.emplace_back(nodes[a], nodes[b], weight * difference[a] * difference[b]);
}

/// -1, 0 or 1 along each axis.
std::array<std::int32_t, 3> offset_of(const int neighbour)
{
  return {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1};
}

} // namespace

GridFit::GridFit(const HexahedronGrid &grid) : grid_(grid)
{
  grid_.validate();
  matrix_.assign(n_neighbours * grid_.n_nodes(), 0.);
  right_side_.assign(grid_.n_nodes(), Vec3::Zero());
  volume_.assign(grid_.n_nodes(), 0.);
}

void GridFit::add_velocities(const Particles &grains)
{
  for (std::size_t i = 0; i < grains.size(); ++i)
    if (!grains.is_fixed(i))
      if (const auto shares = grid_.shares_at(grains.position[i]))
        add_grain(*shares, grains.volume[i], grains.velocity[i]);
  ++n_looks_;
}

void GridFit::add(const std::span<const Vec3> place, const std::span<const double> volume,
                  const std::span<const Vec3> value)
{
  for (const std::size_t n : {volume.size(), value.size()})
    require(n == place.size(), "number of volumes or values of a fit", n,
            "that of the places, " + std::to_string(place.size()));
  for (std::size_t i = 0; i < place.size(); ++i)
    if (const auto shares = grid_.shares_at(place[i]))
      add_grain(*shares, volume[i], value[i]);
  ++n_looks_;
}

void GridFit::add_grain(const GridShares &shares, const double volume, const Vec3 &value)
{
  for (int a = 0; a < 8; ++a)
  {
    const double weight = volume * shares.share[a];
    const std::int32_t node = shares.node[a];
    volume_[node] += weight;
    right_side_[node] += weight * value;
    for (int b = 0; b < 8; ++b)
    {
      const int neighbour = 13 + (b & 1) - (a & 1) + 3 * ((b >> 1 & 1) - (a >> 1 & 1)) + 9 * ((b >> 2) - (a >> 2));
      matrix_[n_neighbours * node + neighbour] += weight * shares.share[b];
    }
  }
}

std::optional<std::vector<Vec3>> GridFit::solve() const
{
  const auto n = static_cast<std::int32_t>(grid_.n_nodes());
  Entries entries;
  double diagonal = 0.;
  for (std::int32_t node = 0; node < n; ++node)
  {
    const std::array<std::int32_t, 3> at = grid_.node_along_axes(node);
    diagonal += matrix_[n_neighbours * std::size_t(node) + 13];
    for (int k = 0; k < n_neighbours; ++k)
      if (const double value = matrix_[n_neighbours * std::size_t(node) + k]; value != 0.)
      {
        const auto [i, j, l] = offset_of(k);
        entries.emplace_back(node, grid_.node_number({at[0] + i, at[1] + j, at[2] + l}), value);
      }
  }
  for (std::int32_t node = 0; node < n; ++node)
    for (int axis = 0; axis < 3; ++axis)
      add_second_difference(grid_, node, axis, smoothing * diagonal / n, entries);
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());

  constexpr double singular = 1e-13; // of the largest pivot
  const Eigen::SimplicialLDLT<Matrix> factors(matrix);
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > singular * factors.vectorD().maxCoeff()))
    return {};
  Eigen::Matrix<double, Eigen::Dynamic, 3> right_side(n, 3);
  for (std::int32_t node = 0; node < n; ++node)
    right_side.row(node) = right_side_[node].transpose();
  const Eigen::Matrix<double, Eigen::Dynamic, 3> solution = factors.solve(right_side);
  std::vector<Vec3> values(n);
  for (std::int32_t node = 0; node < n; ++node)
    values[node] = solution.row(node).transpose();
  return values;
}

std::vector<double> GridFit::solid_fraction() const
{
  std::vector<double> fractions(volume_.size(), 0.);
  for (std::size_t node = 0; node < volume_.size() && n_looks_ > 0; ++node)
    fractions[node] =
        volume_[node] / (grid_.node_volume(static_cast<std::int32_t>(node)) * static_cast<double>(n_looks_));
  return fractions;
}

} // namespace bergamo::dem
