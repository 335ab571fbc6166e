#pragma once

#include "coupling/adapter/two_scale_model.h"
#include "dem/measure/hexahedron_grid.h"

#include <vector>

namespace bergamo::coupling
{

/// Mean stresses in a cell of both models with their weights: where they share the space, their sum is what the
/// material bears. Global frame, tension positive [Pa].
struct CellStress
{
  Mat3 grains = Mat3::Zero(); ///< of the contacts, each with its weight, by the part of its branch in the cell
  Mat3 continuum = Mat3::Zero();

  Mat3 total() const { return grains + continuum; }
};

/// Of the present step, once its forces are known, in the order of HexahedronGrid; see dem::CellSums for what the grid
/// cuts. Grains and elements lie where they are now. Of an element its mean stress counts, times its volume at the
/// start and the nodes' shares as they go through it, each of 4 x 4 x 4 parts of it by the box around that part.
/// @throws ConfigError as the grid's validate() does
std::vector<CellStress> cell_stresses(const TwoScaleModel &model, const dem::HexahedronGrid &grid);

/// Of grains alone, between walls or with a part of them taken out; otherwise as above.
std::vector<CellStress> cell_stresses(const dem::Simulation &grains, const dem::HexahedronGrid &grid);

} // namespace bergamo::coupling
