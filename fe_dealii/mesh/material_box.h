#pragma once

#include <array>

namespace dealii
{
template <int dim, int spacedim>
class Triangulation;
}

namespace bergamo::fe
{

/// A box of another material, edges along the global axes; infinite where it has no end.
struct MaterialBox
{
  std::array<double, 3> minimum{0, 0, 0}; ///< corner [m]
  std::array<double, 3> maximum{1, 1, 1}; ///< opposite corner [m], greater in every component
  unsigned int material_id = 1;

  /// Throws ConfigError.
  void validate() const;
};

/// Gives the box's material id to all cells whose centre lies in it. Throws ConfigError for a bad box and for one
/// without any cell's centre.
void set_material(const MaterialBox &box, dealii::Triangulation<3, 3> &triangulation);

} // namespace bergamo::fe
