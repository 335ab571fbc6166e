#pragma once

#include <array>

namespace dealii
{
template <int dim, int spacedim>
class Triangulation;
}

namespace bergamo::fe
{

/// A box of bricks, edges along the global axes.
struct BoxMeshParameters
{
  std::array<double, 3> minimum{0, 0, 0};            ///< corner [m]
  std::array<double, 3> maximum{1, 1, 1};            ///< opposite corner [m], greater in every component
  std::array<unsigned int, 3> subdivisions{1, 1, 1}; ///< bricks along x, y, z, at least 1
  std::array<double, 3> grading{1, 1, 1}; ///< edge of the last brick over that of the first, growing evenly; > 0

  /// Throws ConfigError.
  void validate() const;
};

/// Fills the empty `triangulation` with the box. Boundary ids 0..5 are the faces x−, x+, y−, y+, z−, z+; all
/// cells have the material id 0.
/// Throws ConfigError for bad parameters or a triangulation that is not empty.
void make_box(const BoxMeshParameters &parameters, dealii::Triangulation<3, 3> &triangulation);

} // namespace bergamo::fe
