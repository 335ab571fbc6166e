#pragma once

#include "fe_dealii/element/element_group.h"
#include "fe_dealii/material/initial_stress.h"
#include "fe_dealii/material/material.h"

#include <memory>
#include <optional>

namespace dealii
{
template <int dim, int spacedim>
class DoFHandler;
}

namespace bergamo::fe
{

/// What hexahedra of 8 nodes do with what their nodes move beyond a linear displacement.
enum class Hourglass
{
  at_points, ///< strains of the trilinear displacement at eight points, the dilatation at its mean: no bending
  bending    ///< a stiffness of its own, with which one element over a thickness bends: see bending_hexahedron.h
};

/// The elements of a solid body on its active cells, in their order.
/// @param dof_handler of an FESystem(FE_Q(degree), 3) of degree 1 or 2: hexahedra of 8 or 27 nodes
/// @param hourglass of elements of 8 nodes
/// @param initial_stress at the points; empty for a law of large strain
/// @param material_id of the cells to take; none: all
/// @throws ConfigError for a cell that is turned inside out somewhere (a Jacobian determinant that is not positive),
///         for an initial stress that is not finite or beyond the yield surface, and for one in a law of large strain
std::unique_ptr<ElementGroup> make_solid_elements(const dealii::DoFHandler<3, 3> &dof_handler, const Material &material,
                                                  const InitialStress &initial_stress,
                                                  Hourglass hourglass = Hourglass::at_points,
                                                  std::optional<unsigned int> material_id = {});

} // namespace bergamo::fe
