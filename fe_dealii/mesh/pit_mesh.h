#pragma once

#include <array>
#include <vector>

namespace dealii
{
template <int dim, int spacedim>
class Triangulation;
}

namespace bergamo::fe
{

/// Bricks between planes across the global axes, less those in a hole, edges along the axes, that may reach beyond
/// them.
struct PitMeshParameters
{
  std::array<std::vector<double>, 3> planes; ///< places of the planes across x, y, z [m], at least two, ascending
  std::array<double, 3> hole_minimum{};      ///< corner [m]
  std::array<double, 3> hole_maximum{};      ///< opposite corner [m]; a hole of no size takes nothing

  /// Throws ConfigError.
  void validate() const;
};

/// Boundary id of the faces of the hole; the others are those of make_box().
inline constexpr unsigned int pit_faces = 6;

/// Fills the empty `triangulation` with the bricks whose centre is not in the hole. Boundary ids 0..5 are the faces on
/// the first and the last plane across x, y, z; all cells have the material id 0.
/// Throws ConfigError for bad parameters, a hole that leaves no brick or pieces that share no face, and a triangulation
/// that is not empty.
void make_pit(const PitMeshParameters &parameters, dealii::Triangulation<3, 3> &triangulation);

/// Places of planes from one place on, a first step and the same ratio from step to step, as many as fill a length: all
/// steps are shrunk alike to end on it. @param length >= 0 [m]; @param step > 0 [m]; @param ratio >= 1
/// @return from 0 to the length; 0 alone for no length
std::vector<double> graded_planes(double length, double step, double ratio);

} // namespace bergamo::fe
