#pragma once

#include "dem/measure/hexahedron_grid.h"
#include "dem/state/particles.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace bergamo::dem
{

/// Coarse-grained field of grains on a grid of linear hexahedra: node values u that minimise
///
///   sum over the grains of V_a |u_a - sum_I N_I(x_a) u_I|^2,
///
/// V_a volumes, u_a the grains' values, N_I(x_a) shape functions at their centres: A u = N V u_a with A = N V N^T
/// (Wellmann 3.5 and 6.20). Grains outside the grid do not count. Several looks at a flow may be added up; the fit is
/// then that of all of them, its mean over time wherever grains are.
///
/// Where no grain is, A has nothing to say, and next to nothing where there are few. So the squares of the second
/// differences along the axes are added with a thousandth of a node's mean share: fields that are linear along each
/// axis stay exact, others where grains are change by about so much, and nodes without grains go on from those beside
/// them. The solid fraction tells where a value stands for grains.
///
/// Sums run in the order of the grains' arrays, so the bits do not depend on threads or restarts.
class GridFit
{
public:
  /// Throws ConfigError as the grid's validate() does.
  explicit GridFit(const HexahedronGrid &grid);

  /// One look: the velocities of all grains but fixed ones.
  void add_velocities(const Particles &grains);

  /// One look. @param place [m]; @param volume [m^3], > 0; @param value one of each a grain
  void add(std::span<const Vec3> place, std::span<const double> volume, std::span<const Vec3> value);

  const HexahedronGrid &grid() const { return grid_; }
  std::int64_t n_looks() const { return n_looks_; }

  /// Values of the nodes. @return nothing where the grains are too few or lie so that they do not determine a field
  std::optional<std::vector<Vec3>> solve() const;

  /// Mean over the looks of the solid fraction around each node, the grains' volumes dealt out by the shape functions.
  std::vector<double> solid_fraction() const;

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("n_looks", self.n_looks_);
    visit("matrix", self.matrix_);
    visit("right_side", self.right_side_);
    visit("volume", self.volume_);
  }

private:
  static constexpr int n_neighbours = 27; // of a node and itself, along x first

  void add_grain(const GridShares &shares, double volume, const Vec3 &value);

  HexahedronGrid grid_;
  std::int64_t n_looks_ = 0;
  std::vector<double> matrix_; // A, n_neighbours a row [m^3]
  std::vector<Vec3> right_side_;
  std::vector<double> volume_; // sum of N_I V, by node [m^3]
};

} // namespace bergamo::dem
