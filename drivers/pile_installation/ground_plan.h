#pragma once

#include "coupling/arlequin/weight.h"
#include "dem/core/types.h"
#include "fe_dealii/mesh/pit_mesh.h"

namespace bergamo::driver
{

/// Where grains and elements lie: a block of grains about the pile's axis x = 0, elements on both sides and below it,
/// the outermost strip of the block shared by both. The same along y. Heights z, upwards [m].
struct GroundPlan
{
  double half_width = 0.;       ///< of all ground, along x [m]
  double half_breadth = 0.;     ///< along y [m]
  double bottom = 0., top = 0.; ///< of the elements

  /// @name The block of grains: edges of the overlap, where the weights of the grains are 1 and where they are 0
  /// @{
  double inner_half_width = 0., outer_half_width = 0.; ///< [m]
  double inner_bottom = 0., outer_bottom = 0.;
  /// @}

  double deepest_bottom =
      0.; ///< to where the outer edge may go down, as the block grows: a layer of elements each time

  /// The block deeper by that much [m].
  GroundPlan deeper(double by) const;

  /// Whether a grain lies in the block or nearer to its sides or its bottom than a margin [m].
  bool is_near(const Vec3 &centre, double margin) const;

  bool holds_grain(const Vec3 &centre) const; ///< whether it lies in the block, with its overlap

  /// Weight of the grains: by the way from the outer to the inner edge of the overlap, at the side or at the bottom,
  /// whichever is the less, so that it is continuous in the corners. Exact at the edges.
  double weight_at(const Vec3 &place, coupling::WeightShape shape) const;
};

/// How fine the elements are.
struct GroundMesh
{
  double element_size = 3e-3;      ///< in the overlap [m]
  unsigned int overlap_layers = 2; ///< of elements
  unsigned int layers_across = 1;  ///< of elements, along y
  double growth = 1.25;            ///< from element to element outwards, >= 1
};

/// The elements of a plan: all ground outside of the inner edge of the overlap, even down to the deepest bottom.
fe::PitMeshParameters mesh_of(const GroundPlan &plan, const GroundMesh &mesh);

} // namespace bergamo::driver
