#pragma once

#include "dem/state/particles.h"

#include <array>
#include <utility>

namespace bergamo::dem
{

/// Copies of a periodic cell, side by side.
struct CellCopies
{
  std::array<int, 3> n_along{1, 1, 1}; ///< of which the first is the cell itself

  int n() const { return n_along[0] * n_along[1] * n_along[2]; }

  /// Where a copy is along the axes.
  std::array<int, 3> place_of(const int copy) const
  {
    return {copy % n_along[0], copy / n_along[0] % n_along[1], copy / n_along[0] / n_along[1]};
  }

  /// The copy in which the neighbour of a copy's grain lies that was the image of one in the cell, and which image it
  /// is there: another than the own one beyond the last copy alone.
  std::pair<int, Image> seen_from(int copy, Image image) const;

  /// Throws ConfigError for a number that is not positive, or above 1 where the cell does not repeat itself.
  void validate(const PeriodicCell &cell) const;
};

/// The particles of a periodic cell and of its copies, one copy after another, in a cell of as many edges; they move as
/// they do in the cell. Ids of copy c are those of the cell plus c times one more than the greatest of these. External
/// and transferred forces stay behind. Throws ConfigError as validate() does.
Particles repeated(const Particles &cell, const CellCopies &copies);

} // namespace bergamo::dem
